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
#include "validation/outside/motion_windows.h"

namespace ursula {
namespace {

double toDigits(double value, double half) { return half > 0 ? 2 * half * std::round(value / (2 * half)) : value; }

constexpr const char* of_rows = "what the motion's rows and digits leave open";

void requireWithin(const std::vector<double>& t, double duration, const std::filesystem::path& file) {
  if (t.back() <= duration * (1 + 1e-9)) return;
  throw CsvError(fmt::format("{}: error: its motion lasts {:.6g} s, expected at most that of the scenario, {:.6g} s",
                             file.string(), t.back(), duration));
}

/// Says which windows were judged. If the rows decide less than half of them, no verdict of pass remains.
void addWindows(const MotionWindows& made, const std::string& torques, ValidationResult& result) {
  result.findings.push_back(
      {"motion file", fmt::format("its efforts are means over windows of {:.3g} s, from t = {:.6g} to {:.6g} s, "
                                  "against {}: an error that is shorter is not seen in full",
                                  made.window, made.t.front(), made.t.back(),
                                  torques.empty() ? "the right ones of the scenario's motion" : torques)});
  if (made.undecided == 0) return;
  const std::string open = fmt::format(
      "{} of {} windows are undecided: what the motion's rows, {:.3g} s apart, leave open of the efforts is "
      "more than {}",
      made.undecided, made.t.size(), made.distance, made.wanted);
  result.findings.push_back({"windows of the motion", open});
  if (made.isDecided()) return;
  const auto between = std::find_if(result.checks.begin(), result.checks.end(),
                                    [](const Check& check) { return check.name == "torque.between"; });
  *between = notJudgeable(Reason::not_covered, between->name, std::nan(""), std::nan(""), between->unit, "",
                          fmt::format("{}; rows some {:.1g} s apart would do", open, made.enough));
  result.verdict = overall(result.checks);
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

/// The given efforts within the file's motion, or the right ones if there are none. These are known between its rows
/// as well, where friction may change.
EffortRows rowsWithin(const std::vector<double>& instants, const std::vector<double>* t, const EffortList& efforts,
                      const std::string& name, const EffortsAt& right) {
  constexpr std::size_t fine = 2000;
  EffortRows out;
  if (t == nullptr) {
    out.at_any_instant = true;
    const std::size_t parts = 1 + fine / instants.size();
    for (std::size_t k = 0; k + 1 < instants.size(); ++k)
      for (std::size_t j = 0; j < parts; ++j)
        out.t.push_back(instants[k] +
                        (instants[k + 1] - instants[k]) * static_cast<double>(j) / static_cast<double>(parts));
    out.t.push_back(instants.back());
    for (const double each : out.t) out.efforts.push_back(right(each));
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
  const EffortRows rows =
      rowsWithin(instants, torques ? &torques->t : nullptr, efforts, torques ? torques->file.string() : "", right);
  const NeededBy needed = [&](const SomeRows& some) {
    return of(some.all() ? along.trajectory : splineOf(*along.trajectory, some.of(instants)));
  };
  const MotionWindows made =
      inWindows({instants, rows, needed, right, of(splineOf(*scenario.trajectory, instants, halves)),
                 Eigen::VectorXd::Ones(6), scenario.tolerance});
  GivenTorques judged{motion.filename().string(), made.t, {}};
  for (const Eigen::VectorXd& each : made.efforts) judged.torques.emplace_back(each);
  TorqueFile file = torqueFileOf(judged, scenario.manipulator->motors());
  for (std::size_t k = 0; k < file.rows(); ++k) file.torque_precision[k] += made.precision[k];
  file.derived_from = of_rows;
  ExternalOptions as = options;
  as.about = JudgedSubject{motion.string(), Formulation::external, CalledBy::trajectory, torques ? torques->map : "",
                           torques ? torques->file.string() : ""};
  ValidationResult result = validateExternal(along, file, as);
  addWindows(made, as.about->torques, result);
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
  const EffortRows rows = rowsWithin(read.t, efforts ? &efforts->t : nullptr, efforts ? efforts->efforts : EffortList(),
                                     efforts ? efforts->name : "", right);
  const NeededBy needed = [&](const SomeRows& some) {
    return effortsAlong(
        scenario, some.all() ? read.trajectory : splineOf(*read.trajectory, some.of(read.t), read.has_derivatives, 0));
  };
  const EffortsAt sampled = effortsAlong(scenario, splineOf(*scenario.trajectory, read.t, false, read.quantum));
  const MotionWindows made =
      inWindows({read.t, rows, needed, right, sampled, effortsInOneUnit(*scenario.mechanism), scenario.tolerance});
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
  addWindows(made, subject.about.torques, result);
  return result;
}

}  // namespace ursula
