#include "validation/outside/given_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "base/csv_digits.h"
#include "model/columns.h"
#include "model/instants.h"
#include "model/quaternions.h"
#include "model/trajectories/trajectories.h"

namespace ursula {
namespace {

/// Windows in a motion, and the fewest rows in one.
constexpr int windows = 20, rows_in_window = 8, most_centres = 301;
/// What is left open by rows is known for the scenario's motion; another one has up to as many times of it.
constexpr double other_motion = 4;

using EffortList = std::vector<Eigen::VectorXd>;
using EffortsAt = std::function<Eigen::VectorXd(double t)>;

/// Means over windows with the weight (1 − x²)³. It falls to zero smoothly, so that integrated by parts an acceleration
/// becomes a position.
class WindowMeans {
 public:
  WindowMeans(std::vector<double> t, double half) : t_(std::move(t)), half_(half) {}

  Eigen::VectorXd at(double centre, const EffortList& values) const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(values.front().size());
    double weights = 0;
    const auto from = std::lower_bound(t_.begin(), t_.end(), centre - half_) - t_.begin();
    for (std::size_t k = from; k < t_.size() && t_[k] < centre + half_; ++k) {
      const double x = (t_[k] - centre) / half_, falling = 1 - x * x;
      const double between = (t_[std::min(k + 1, t_.size() - 1)] - t_[k > 0 ? k - 1 : 0]) / 2;
      const double weight = falling * falling * falling * between;
      sum += weight * values[k];
      weights += weight;
    }
    return sum / weights;
  }

  /// Centres whose windows are within the motion, away from its ends, where a spline is less exact.
  std::vector<double> centres() const {
    const double first = t_.front() + 1.5 * half_, last = t_.back() - 1.5 * half_;
    std::vector<double> out = equallySpaced(last - first, std::min<int>(most_centres, static_cast<int>(t_.size())));
    for (double& t : out) t += first;
    return out;
  }

 private:
  std::vector<double> t_;
  double half_;
};

/// The efforts that are judged in place of a motion.
struct MotionAsEfforts {
  std::vector<double> t;
  EffortList efforts, precision;
  double window = 0;
};

/// `t` are the rows where efforts are compared; `needed` are those of the file's motion, `right` those of the
/// scenario's, `sampled` those of a spline through the scenario's motion at the file's instants and digits. `given` are
/// compared with those needed.
MotionAsEfforts compared(const std::vector<double>& t, const EffortList& given, const EffortsAt& needed,
                         const EffortsAt& right, const EffortsAt& sampled) {
  const double duration = t.back() - t.front();
  const double half = std::max(duration / windows, rows_in_window * duration / static_cast<double>(t.size() - 1)) / 2;
  if (!(6 * half < duration))
    throw CsvError(fmt::format("{} rows show no accelerations, expected at least {}", t.size(), 4 * rows_in_window));
  const WindowMeans means(t, half);
  EffortList off, open;
  for (std::size_t k = 0; k < t.size(); ++k) {
    off.emplace_back(given[k] - needed(t[k]));
    open.emplace_back(sampled(t[k]) - right(t[k]));
  }
  MotionAsEfforts out;
  out.t = means.centres();
  out.window = 2 * half;
  EffortList left_open;
  for (const double centre : out.t) {
    out.efforts.emplace_back(needed(centre) + means.at(centre, off));
    left_open.emplace_back(means.at(centre, open).cwiseAbs());
  }
  const std::size_t reach = 1 + out.t.size() / windows;
  for (std::size_t k = 0; k < out.t.size(); ++k) {
    Eigen::VectorXd most = left_open[k];
    for (std::size_t j = k > reach ? k - reach : 0; j <= std::min(k + reach, out.t.size() - 1); ++j)
      most = most.cwiseMax(left_open[j]).eval();
    out.precision.emplace_back(other_motion * most);
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

/// The scenario's motion at the file's instants and digits, and a spline through them.
std::shared_ptr<const Trajectory> likewise(const Trajectory& motion, const CsvTable& table) {
  std::vector<TimedPose> poses;
  std::vector<double> halves;
  for (const char* name : {"p_x_m", "p_y_m", "p_z_m", "q_w", "q_x", "q_y", "q_z"})
    halves.push_back(halfDigit(table, name));
  for (const double t : table.at("t_s")) {
    const Motion<double> at = motion.at(std::min(t, motion.duration()));
    const Eigen::Vector4d q = quaternions({at}).front();
    poses.emplace_back();
    poses.back().time = t;
    for (int k = 0; k < 3; ++k) poses.back().position(k) = toDigits(at.p(k), halves[k]);
    for (int k = 0; k < 4; ++k) poses.back().orientation(k) = toDigits(q(k), halves[k + 3]);
  }
  return makeSamples(poses);
}

}  // namespace

ValidationResult validateMotion(const Scenario& scenario, const std::filesystem::path& motion,
                                const TorqueFile* torques, const ExternalOptions& options) {
  const CsvTable table = readByMeaning(motion, false);
  Scenario along = scenario;
  along.trajectory = std::shared_ptr<const Trajectory>(makeSamples(table));
  const double duration = along.trajectory->duration();
  requireWithin(table.at("t_s"), scenario.trajectory->duration(), motion);
  const auto similar = likewise(*scenario.trajectory, table);
  const Subject noc = nocSubject(*scenario.manipulator, scenario.load);
  const auto of = [&noc](std::shared_ptr<const Trajectory> path) -> EffortsAt {
    return [&noc, path](double t) { return Eigen::VectorXd(noc.torques(path->at(std::min(t, path->duration())))); };
  };
  const EffortsAt right = of(scenario.trajectory);
  std::vector<double> t;
  EffortList given;
  if (torques == nullptr) {
    t = table.at("t_s");
    for (const double each : t) given.push_back(right(each));
  } else {
    for (std::size_t k = 0; k < torques->rows(); ++k)
      if (torques->t[k] <= duration) t.push_back(torques->t[k]), given.emplace_back(torques->torques[k]);
    if (t.size() < 2) throw CsvError(torques->file.string() + ": error: no instants within the motion of the file");
  }
  const MotionAsEfforts made = compared(t, given, of(along.trajectory), right, of(similar));
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
  MechanismScenario along = scenario, similar = scenario;
  along.trajectory = read.trajectory;
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(read.t.size()),
                       static_cast<Eigen::Index>(scenario.mechanism->motorCount()));
  for (Eigen::Index k = 0; k < rows.rows(); ++k) {
    const double t = std::min(read.t[k], scenario.trajectory->duration());
    const Eigen::VectorXd q = scenario.trajectory->at(t).q;
    for (Eigen::Index i = 0; i < rows.cols(); ++i) rows(k, i) = toDigits(q(i), read.quantum);
  }
  similar.trajectory = std::shared_ptr<const MotorTrajectory>(makeMotorSamples(read.t, rows));
  const MechanismAlong of_file(along), of_scenario(scenario), of_similar(similar);
  const auto of = [](const MechanismAlong& path) -> EffortsAt {
    return [&path](double t) {
      LoopWork work;
      return path.motion().inverseDynamics(std::min(t, path.motion().trajectory().duration()), work);
    };
  };
  const EffortsAt right = of(of_scenario);
  std::vector<double> t;
  EffortList given;
  const double duration = read.trajectory->duration();
  if (efforts == nullptr) {
    t = read.t;
    for (const double each : t) given.push_back(right(each));
  } else {
    for (std::size_t k = 0; k < efforts->t.size(); ++k)
      if (efforts->t[k] <= duration) t.push_back(efforts->t[k]), given.push_back(efforts->efforts[k]);
    if (t.size() < 2) throw CsvError(efforts->name + ": error: no instants within the motion of the file");
  }
  const MotionAsEfforts made = compared(t, given, of(of_file), right, of(of_similar));
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
