// Defects in the commanded motion and the load. All formulations share these, so none can see them.

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "model/exact_trajectory.h"
#include "parts/prove/defects.h"

namespace ursula {
namespace {

/// Marks `wrong` as read from a file if `right` is.
Scenario asRead(const Scenario& right, Scenario wrong) {
  if (right.isAsRead()) wrong.markAsRead();
  return wrong;
}

using ChangeAt = std::function<void(Motion<double>& motion, const Trajectory& right)>;

/// A motion that is wrong in doubles; its 50-digit pose stays right.
class FaultyTrajectory final : public ExactTrajectory {
 public:
  FaultyTrajectory(std::shared_ptr<const Trajectory> right, ChangeAt change)
      : right_(std::move(right)), change_(std::move(change)) {}
  std::string kind() const override { return right_->kind(); }
  double duration() const override { return right_->duration(); }
  Motion<double> at(double t) const override {
    Motion<double> motion = right_->at(t);
    change_(motion, *right_);
    return motion;
  }
  Motion<Real50> at(const Real50& t) const override { return right_->at(t); }
  std::unique_ptr<Trajectory> relativeTo(const Vector3d& origin) const override {
    std::shared_ptr<const Trajectory> moved = right_->relativeTo(origin);
    return moved ? std::make_unique<FaultyTrajectory>(std::move(moved), change_) : nullptr;
  }
  const std::vector<double>& knots() const override { return right_->knots(); }
  HiddenTerms hiddenTerms() const override { return right_->exact() ? right_->exact()->hiddenTerms() : HiddenTerms(); }

 private:
  std::shared_ptr<const Trajectory> right_;
  ChangeAt change_;
};

Defect shared(const std::string& name, const std::string& group, const InjectedFault::ScenarioChange& scenario) {
  Defect out{name, group};
  out.scenario = scenario;
  out.formulations_wanted = 1;
  return out;
}

Defect sharedMotion(const char* name, const ChangeAt& change) {
  return shared(name, "shared motion", [change](const Scenario& s) {
    Scenario wrong = s;
    wrong.trajectory = std::make_shared<const FaultyTrajectory>(s.trajectory, change);
    return asRead(s, wrong);
  });
}

/// Leads the load through the right rows, but limits its slopes for other components; `map` converts those to the right
/// ones. A constant load is unchanged.
Defect slopesOf(const char* components, const Matrix6d& map) {
  const std::string name = fmt::format("load's slopes limited for {}", components);
  return shared(name, "shared load", [map](const Scenario& s) {
    if (!s.load || !s.load->history) return s;
    const Matrix6d back = map.inverse();
    std::vector<TimedWrench> rows = s.load->history->rows();
    for (TimedWrench& row : rows) {
      const Vector6d other = back * (Vector6d() << row.wrench.force, row.wrench.moment).finished();
      row.wrench = {other.head<3>(), other.tail<3>()};
    }
    const auto load = std::make_shared<Load>(*s.load);
    load->history = std::make_shared<const LoadHistory>(LoadHistory(rows), map, 1);
    Scenario wrong = s;
    wrong.load = load;
    return asRead(s, wrong);
  });
}

/// Recovers component i of [f; m] from its sum with `share` of component j.
Matrix6d outOfSum(int i, int j, double share) {
  Matrix6d map = Matrix6d::Identity();
  map(i, j) = -share;
  return map;
}

Matrix6d inAnotherOrder() {
  Matrix6d map = Matrix6d::Zero();
  for (int i = 0; i < 6; ++i) map(i, (i + 2) % 6) = 1;
  return map;
}

}  // namespace

std::vector<Defect> sharedMotionDefects(const Manipulator&) {
  using M = Motion<double>;
  using T = Trajectory;
  return {sharedMotion("commanded P off by 1e-12 m", [](M& m, const T&) { m.p.x() += 1e-12; }),
          sharedMotion("commanded orientation off by 1e-12",
                       [](M& m, const T&) { m.Q = (Eigen::AngleAxisd(1e-12, Vector3d::UnitY()) * m.Q).eval(); }),
          sharedMotion("commanded orientation longer than 1 by 1e-12", [](M& m, const T&) { m.Q *= 1 + 1e-12; }),
          sharedMotion("v off by 1e-9 of itself", [](M& m, const T&) { m.p_dot *= 1 + 1e-9; }),
          sharedMotion("omega off by 1e-9 of itself", [](M& m, const T&) { m.omega *= 1 + 1e-9; }),
          sharedMotion("v late by 1e-9 s", [](M& m, const T& right) { m.p_dot = right.at(m.t - 1e-9).p_dot; }),
          sharedMotion("a off by 1e-9 of itself", [](M& m, const T&) { m.p_ddot *= 1 + 1e-9; }),
          sharedMotion("alpha off by 1e-9 of itself", [](M& m, const T&) { m.omega_dot *= 1 + 1e-9; }),
          sharedMotion("omega in the platform's axes",
                       [](M& m, const T&) { m.omega = (m.Q.transpose() * m.omega).eval(); }),
          sharedMotion("alpha in the platform's axes",
                       [](M& m, const T&) { m.omega_dot = (m.Q.transpose() * m.omega_dot).eval(); }),
          sharedMotion("alpha without 1e-8 of what is along omega",
                       [](M& m, const T&) { m.omega_dot -= 1e-8 * m.omega_dot.dot(m.omega) * m.omega; }),
          sharedMotion("a with 1e-9 of omega x v", [](M& m, const T&) { m.p_ddot += 1e-9 * m.omega.cross(m.p_dot); })};
}

std::vector<Defect> sharedLoadDefects(const Manipulator&) {
  return {slopesOf("f_x + f_y / 2, not for f_x", outOfSum(0, 1, 0.5)),
          slopesOf("f_y + 1e-6 f_z, not for f_y", outOfSum(1, 2, 0x1p-20)),
          slopesOf("f_z + m_x / 4, not for f_z", outOfSum(2, 3, 0.25)),
          slopesOf("m_x + f_y / 4, not for m_x", outOfSum(3, 1, 0.25)),
          slopesOf("m_z + m_y / 2, not for m_z", outOfSum(5, 4, 0.5)),
          control(slopesOf("the components in another order: no fault", inAnotherOrder()))};
}

Subject disturbedSubject(const Scenario& scenario, const Parameter& parameter, double relative) {
  const auto rebuilt = [&parameter, relative](const Manipulator& manipulator) {
    ManipulatorParameters machine = manipulator.parameters();
    parameter.disturb(machine, relative);
    return Manipulator(machine);
  };
  Subject subject = nocSubject(rebuilt(*scenario.manipulator), scenario.load);
  subject.name = fmt::format("noc with {} off by {:g}", parameter.path, relative);
  return subject;
}

}  // namespace ursula
