#include "validation/outside/given_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "base/csv.h"
#include "base/csv_digits.h"
#include "base/errors.h"
#include "model/columns.h"
#include "model/quaternions.h"
#include "model/trajectories/trajectories.h"
#include "validation/outside/window_means.h"

namespace ursula {
namespace {

/// Windows in a motion, and the fewest rows in one.
constexpr int windows = 20, rows_in_window = 8;
/// What is left open by rows is known for the scenario's motion; another one has up to as many times of it.
constexpr double other_motion = 4;

using EffortsAt = std::function<Eigen::VectorXd(double t)>;

/// The efforts that are judged in place of a motion.
struct MotionAsEfforts {
  std::vector<double> t;
  EffortList efforts, precision;
  double window = 0;
};

/// Rows where efforts are compared, and the given ones.
struct GivenRows {
  std::vector<double> t;
  EffortList efforts;
};

/// Returns each `step`-th value and the last.
template <class T>
std::vector<T> eachOf(const std::vector<T>& all, std::size_t step) {
  std::vector<T> out;
  for (std::size_t k = 0; k + 1 < all.size(); k += step) out.push_back(all[k]);
  out.push_back(all.back());
  return out;
}

/// Means of the given efforts less those needed, by each `step`-th row.
EffortList meansOff(const GivenRows& rows, std::size_t step, const EffortsAt& needed, double half,
                    const std::vector<double>& centres) {
  const std::vector<double> t = eachOf(rows.t, step);
  EffortList off = eachOf(rows.efforts, step), out;
  for (std::size_t k = 0; k < t.size(); ++k) off[k] -= needed(t[k]);
  const WindowMeans means(t, half);
  for (const double centre : centres) out.emplace_back(means.at(centre, off));
  return out;
}

/// The largest values around each.
EffortList mostAround(const EffortList& values) {
  const std::size_t reach = 1 + values.size() / windows;
  EffortList out;
  for (std::size_t k = 0; k < values.size(); ++k) {
    Eigen::VectorXd most = values[k].cwiseAbs();
    for (std::size_t j = k > reach ? k - reach : 0; j <= std::min(k + reach, values.size() - 1); ++j)
      most = most.cwiseMax(values[j].cwiseAbs()).eval();
    out.push_back(std::move(most));
  }
  return out;
}

/// Largest differences around each; those to zero where a window of `b` has no row.
EffortList differences(const EffortList& a, const EffortList& b) {
  EffortList out;
  for (std::size_t k = 0; k < a.size(); ++k) out.push_back(b[k].allFinite() ? Eigen::VectorXd(a[k] - b[k]) : a[k]);
  return mostAround(out);
}

/// The efforts that the file's motion needs, by each `step`-th of its rows.
using NeededBy = std::function<EffortsAt(std::size_t step)>;

/// The error that the rows' distance leaves in the means `of_all`. Every second row changes them by d₂, every fourth by
/// d₄ more: d₂²/d₄ is left if it shrinks as a smooth motion does, else the larger. All of the efforts if the
/// loops cannot follow every second row.
EffortList leftBetween(const GivenRows& rows, const NeededBy& needed, double half, const std::vector<double>& centres,
                       const EffortList& of_all) {
  const auto coarser = [&](std::size_t step) -> EffortList {
    try {
      return meansOff(rows, step, needed(step), half, centres);
    } catch (const LoopError&) {
    } catch (const InvalidParameter&) {  // too few rows
    }
    return {};
  };
  const EffortList second = coarser(2), fourth = coarser(4);
  if (second.empty()) {
    Eigen::VectorXd most = rows.efforts.front().cwiseAbs();
    for (const Eigen::VectorXd& each : rows.efforts) most = most.cwiseMax(each.cwiseAbs()).eval();
    return EffortList(centres.size(), most);
  }
  EffortList out = differences(of_all, second);
  if (fourth.empty()) return out;
  constexpr double smooth = 16;  // twice the distance of rows, to the fourth power
  const EffortList before = differences(second, fourth);
  for (std::size_t k = 0; k < out.size(); ++k)
    for (Eigen::Index i = 0; i < out[k].size(); ++i)
      out[k](i) =
          smooth * out[k](i) < before[k](i) ? out[k](i) * out[k](i) / before[k](i) : std::max(out[k](i), before[k](i));
  return out;
}

/// `right` are the efforts of the scenario's motion, `sampled` those of a spline through that motion at the file's
/// instants and digits. The given ones are compared with those needed.
MotionAsEfforts compared(const GivenRows& rows, const NeededBy& neededBy, const EffortsAt& right,
                         const EffortsAt& sampled) {
  const std::vector<double>& t = rows.t;
  const double duration = t.back() - t.front();
  const double half = std::max(duration / windows, rows_in_window * duration / static_cast<double>(t.size() - 1)) / 2;
  if (!(6 * half < duration))
    throw CsvError(fmt::format("{} rows show no accelerations, expected at least {}", t.size(), 4 * rows_in_window));
  MotionAsEfforts out;
  out.t = WindowMeans(t, half).centres();
  out.window = 2 * half;
  GivenRows spline{t, {}};
  for (const double each : t) spline.efforts.push_back(sampled(each));
  const EffortsAt needed = neededBy(1);
  const EffortList off = meansOff(rows, 1, needed, half, out.t);
  const EffortList open = mostAround(meansOff(spline, 1, right, half, out.t));
  const EffortList between = leftBetween(rows, neededBy, half, out.t, off);
  for (std::size_t k = 0; k < out.t.size(); ++k) {
    out.efforts.emplace_back(needed(out.t[k]) + off[k]);
    out.precision.emplace_back(other_motion * (open[k] + between[k]));
  }
  return out;
}

double toDigits(double value, double half) { return half > 0 ? 2 * half * std::round(value / (2 * half)) : value; }

constexpr const char* of_rows = "what the motion's rows and digits leave open";

void requireWithin(const std::vector<double>& t, double duration, const std::filesystem::path& file) {
  if (t.back() <= duration * (1 + 1e-9)) return;
  throw CsvError(fmt::format("{}: error: its motion lasts {:.6g} s, expected at most that of the scenario, {:.6g} s",
                             file.string(), t.back(), duration));
}

Finding windowsOf(const MotionAsEfforts& made, const std::string& torques) {
  return {"motion file", fmt::format("its efforts are means over windows of {:.3g} s, from t = {:.6g} to {:.6g} s, "
                                     "against {}: an error that is shorter is not seen in full",
                                     made.window, made.t.front(), made.t.back(),
                                     torques.empty() ? "the right ones of the scenario's motion" : torques)};
}

/// A spline through a motion at instants, in digits of p and q.
std::shared_ptr<const Trajectory> splineOf(const Trajectory& motion, const std::vector<double>& instants,
                                           const std::vector<double>& halves = std::vector<double>(7)) {
  std::vector<TimedPose> poses;
  for (const double t : instants) {
    const Motion<double> at = motion.at(std::min(t, motion.duration()));
    const Eigen::Vector4d q = quaternions({at}).front();
    poses.emplace_back();
    poses.back().time = t;
    for (int k = 0; k < 3; ++k) poses.back().position(k) = toDigits(at.p(k), halves[k]);
    for (int k = 0; k < 4; ++k) poses.back().orientation(k) = toDigits(q(k), halves[k + 3]);
  }
  return makeSamples(poses);
}

/// The same of motors; `given` keeps rates and accelerations.
std::shared_ptr<const MotorTrajectory> splineOf(const MotorTrajectory& motion, const std::vector<double>& instants,
                                                bool given, double half) {
  const auto count = static_cast<Eigen::Index>(instants.size()), n = motion.at(0).q.size();
  Eigen::MatrixXd q(count, n), rates, accelerations;
  if (given) rates.resize(count, n), accelerations.resize(count, n);
  for (Eigen::Index k = 0; k < count; ++k) {
    const MotorMotion at = motion.at(std::min(instants[k], motion.duration()));
    for (Eigen::Index i = 0; i < n; ++i) q(k, i) = toDigits(at.q(i), half);
    if (given) rates.row(k) = at.qdot, accelerations.row(k) = at.qddot;
  }
  return makeMotorSamples(instants, q, rates, accelerations);
}

/// The efforts that a motion of the machine needs. Throws LoopError.
EffortsAt effortsAlong(MechanismScenario scenario, std::shared_ptr<const MotorTrajectory> motion) {
  scenario.trajectory = std::move(motion);
  const auto kept = std::make_shared<const MechanismScenario>(std::move(scenario));
  const auto along = std::make_shared<const MechanismAlong>(*kept);
  return [kept, along](double t) {
    LoopWork work;
    return along->motion().inverseDynamics(std::min(t, kept->trajectory->duration()), work);
  };
}

/// The given efforts within the file's motion, or the right ones at its instants if there are none.
GivenRows rowsWithin(const std::vector<double>& instants, const std::vector<double>* t, const EffortList& efforts,
                     const std::string& name, const EffortsAt& right) {
  GivenRows out;
  if (t == nullptr) {
    out.t = instants;
    for (const double each : instants) out.efforts.push_back(right(each));
    return out;
  }
  for (std::size_t k = 0; k < t->size(); ++k)
    if ((*t)[k] <= instants.back()) out.t.push_back((*t)[k]), out.efforts.push_back(efforts[k]);
  if (out.t.size() < 2) throw CsvError(name + ": error: no instants within the motion of the file");
  return out;
}

}  // namespace

ValidationResult validateMotion(const Scenario& scenario, const std::filesystem::path& motion,
                                const TorqueFile* torques, const ExternalOptions& options) {
  const CsvTable table = readByMeaning(motion, false);
  Scenario along = scenario;
  along.trajectory = std::shared_ptr<const Trajectory>(makeSamples(table));
  const std::vector<double>& instants = table.at("t_s");
  requireWithin(instants, scenario.trajectory->duration(), motion);
  std::vector<double> halves;
  for (const char* name : {"p_x_m", "p_y_m", "p_z_m", "q_w", "q_x", "q_y", "q_z"})
    halves.push_back(halfDigit(table, name));
  const Subject noc = nocSubject(*scenario.manipulator, scenario.load);
  const auto of = [&noc](std::shared_ptr<const Trajectory> path) -> EffortsAt {
    return [&noc, path](double t) { return Eigen::VectorXd(noc.torques(path->at(std::min(t, path->duration())))); };
  };
  const EffortsAt right = of(scenario.trajectory);
  EffortList efforts;
  if (torques != nullptr)
    for (const auto& each : torques->torques) efforts.emplace_back(each);
  const GivenRows rows =
      rowsWithin(instants, torques ? &torques->t : nullptr, efforts, torques ? torques->file.string() : "", right);
  const NeededBy needed = [&](std::size_t step) {
    return of(step == 1 ? along.trajectory : splineOf(*along.trajectory, eachOf(instants, step)));
  };
  const MotionAsEfforts made = compared(rows, needed, right, of(splineOf(*scenario.trajectory, instants, halves)));
  GivenTorques judged{motion.filename().string(), made.t, {}};
  for (const Eigen::VectorXd& each : made.efforts) judged.torques.emplace_back(each);
  TorqueFile file = torqueFileOf(judged, scenario.manipulator->motors());
  for (std::size_t k = 0; k < file.rows(); ++k) file.torque_precision[k] += made.precision[k];
  file.derived_from = of_rows;
  ExternalOptions as = options;
  as.about = JudgedSubject{motion.string(), Formulation::external, CalledBy::trajectory, torques ? torques->map : "",
                           torques ? torques->file.string() : ""};
  ValidationResult result = validateExternal(along, file, as);
  result.findings.push_back(windowsOf(made, as.about->torques));
  return result;
}

ValidationResult validateMotion(const MechanismScenario& scenario, const std::filesystem::path& motion,
                                const GivenEfforts* efforts, const MechanismOptions& options,
                                const std::vector<std::string>& map) {
  const MotorSamples read = readMotorSamples(motion, *scenario.mechanism, map);
  requireWithin(read.t, scenario.trajectory->duration(), motion);
  MechanismScenario along = scenario;
  along.trajectory = read.trajectory;
  const EffortsAt right = effortsAlong(scenario, scenario.trajectory);
  const GivenRows rows = rowsWithin(read.t, efforts ? &efforts->t : nullptr, efforts ? efforts->efforts : EffortList(),
                                    efforts ? efforts->name : "", right);
  const NeededBy needed = [&](std::size_t step) {
    return effortsAlong(scenario, step == 1
                                      ? read.trajectory
                                      : splineOf(*read.trajectory, eachOf(read.t, step), read.has_derivatives, 0));
  };
  const EffortsAt sampled = effortsAlong(scenario, splineOf(*scenario.trajectory, read.t, false, read.quantum));
  const MotionAsEfforts made = compared(rows, needed, right, sampled);
  auto judged = std::make_shared<GivenEfforts>();
  judged->name = motion.filename().string();
  judged->t = made.t;
  judged->efforts = made.efforts;
  judged->precision = made.precision;
  judged->derived_from = of_rows;
  MechanismSubject subject;
  subject.given = judged;
  subject.about = {motion.string(), Formulation::external, CalledBy::trajectory, "", efforts ? efforts->name : ""};
  ValidationResult result = validateMechanism(along, subject, options);
  result.findings.push_back(windowsOf(made, subject.about.torques));
  return result;
}

}  // namespace ursula
