// Compares the growth of deviations by the variational equations with nonlinear simulations of deviated motions.

#include "validation/limits/amplification.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <iostream>
#include <limits>

#include "model/trajectories/trajectories.h"
#include "parts/fast/solver.h"
#include "tests/support/vectors.h"

namespace ursula {
namespace {

/// The platform's open-loop motion under the commanded torques, by the solver's direct dynamics and Runge–Kutta.
class Simulation {
 public:
  using State = Eigen::Matrix<double, 13, 1>;  ///< p, quaternion [x, y, z, w], ṗ, ω

  explicit Simulation(const Scenario& scenario) : scenario_(scenario), solver_(*scenario.manipulator) {}

  static State stateOf(const Motion<double>& motion) {
    State out;
    out << motion.p, Eigen::Quaterniond(motion.Q).coeffs(), motion.p_dot, motion.omega;
    return out;
  }

  void advance(State& x, double from, double to, int steps, const Vector6d& extra = Vector6d::Zero()) {
    const double h = (to - from) / steps;
    for (int k = 0; k < steps; ++k) {
      const double t = from + k * h;
      const State k1 = rate(t, x, extra), k2 = rate(t + h / 2, x + h / 2 * k1, extra);
      const State k3 = rate(t + h / 2, x + h / 2 * k2, extra), k4 = rate(t + h, x + h * k3, extra);
      x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
  }

  /// [p; L · rotation vector] from b to a.
  Vector6d difference(const State& a, const State& b) const {
    const Eigen::Quaterniond turn = orientation(a) * orientation(b).conjugate();
    Vector6d out;
    out << a.head<3>() - b.head<3>(), 2 * length() * turn.vec() * (turn.w() < 0 ? -1 : 1);
    return out;
  }

  double length() const { return solver_.length(); }
  const Solver<double>& solver() const { return solver_; }

 private:
  static Eigen::Quaterniond orientation(const State& x) {
    Eigen::Quaterniond q;
    q.coeffs() = x.segment<4>(3);
    return q.normalized();
  }

  State rate(double t, const State& x, const Vector6d& extra) {
    const Motion<double> commanded = scenario_.trajectory->at(t);
    const Vector6d torques = solver_.inverseDynamics(commanded, work_) + extra;
    Motion<double> motion;
    motion.t = t;
    motion.p = x.head<3>();
    motion.Q = orientation(x).toRotationMatrix();
    motion.p_dot = x.segment<3>(7);
    motion.omega = x.tail<3>();
    const Vector6d found = solver_.directDynamics(motion, torques, work_);
    const Eigen::Quaterniond spin(0, motion.omega.x(), motion.omega.y(), motion.omega.z());
    State out;
    out << motion.p_dot, 0.5 * (spin * orientation(x)).coeffs(), found.tail<3>(), found.head<3>();
    return out;
  }

  const Scenario& scenario_;
  Solver<double> solver_;
  Workspace<double> work_;
};

const auto none = [](double) { return 0.0; };
constexpr double any = std::numeric_limits<double>::max();

class Growth : public testing::TestWithParam<std::string> {
 protected:
  Scenario scenario_ = vectorScenario(GetParam());
  Amplification amplification_{scenario_, 300};
};

/// Compares ∂position/∂velocity over the window with pairs of deviated nonlinear motions, column by column.
TEST_P(Growth, isThatOfDeviatedMotions) {
  Simulation simulation(scenario_);
  const std::size_t first = 60, last = 240;
  const GrowthWindow window = amplification_.window(first, none, 0, any);
  const double start = amplification_.instants()[first], end = amplification_.instants()[last];
  const double deviation = 1e-6, L = simulation.length();  // it grows some thousandfold and stays small
  Matrix6d measured;
  for (int j = 0; j < 6; ++j) {
    std::array<Simulation::State, 2> states;
    for (int side = 0; side < 2; ++side) {
      Simulation::State& x = states[static_cast<std::size_t>(side)];
      x = Simulation::stateOf(scenario_.trajectory->at(start));
      x(7 + j) += (side == 0 ? 1 : -1) * deviation / (j < 3 ? 1 : L);
      simulation.advance(x, start, end, 400);
    }
    measured.col(j) = simulation.difference(states[0], states[1]) / (2 * deviation);
  }
  const double predicted = window.growth[last - first];
  std::cout << "growth: predicted " << predicted << ", measured " << measured.norm() << " m/(m/s)\n";
  EXPECT_NEAR(predicted / measured.norm(), 1, 1e-3);
  EXPECT_GT(predicted, 2 * (end - start)) << "nothing grows here beyond what free flight does";
}

/// An error of the torques, as an error of the acceleration, never moves the platform beyond the bound.
TEST_P(Growth, boundsWhatWrongTorquesDo) {
  Simulation simulation(scenario_);
  const double end = amplification_.instants()[150], L = simulation.length();
  const Vector6d extra = 1e-4 * Vector6d(1, -2, 3, 1, 2, -1);
  Workspace<double> work;
  const auto acceleration = [&](double t) {
    const Motion<double> motion = scenario_.trajectory->at(t);
    simulation.solver().inverseKinematics(motion, work);
    simulation.solver().jacobians(motion, work);
    const Matrix6d M_P = simulation.solver().massMatrixAtP(motion, work);
    Vector6d change = M_P.inverse() * simulation.solver().T(work).transpose().inverse() * extra;
    change.head<3>() *= L;
    return change.norm();
  };
  const GrowthWindow window = amplification_.window(0, acceleration, 0, any);
  Simulation::State right = Simulation::stateOf(scenario_.trajectory->at(0)), wrong = right;
  simulation.advance(right, 0, end, 400);
  simulation.advance(wrong, 0, end, 400, extra);
  const double moved = simulation.difference(wrong, right).norm();
  std::cout << "moved " << moved << " m of at most " << window.from_acceleration[150] << " m\n";
  EXPECT_LE(moved, window.from_acceleration[150]);
  EXPECT_GT(moved, 1e-3 * window.from_acceleration[150]) << "the bound says nothing";
}

TEST_P(Growth, windowsFollowEachOtherToTheEnd) {
  const double useful = 1e-6;
  const auto acceleration = [](double) { return 1e-6; };
  std::size_t first = 0, windows = 0;
  for (; first + 1 < amplification_.instants().size(); ++windows) {
    const GrowthWindow window = amplification_.window(first, acceleration, 0, useful);
    ASSERT_GT(window.last, first);
    EXPECT_EQ(window.start(), amplification_.instants()[first]);
    EXPECT_EQ(window.end(), amplification_.instants()[window.last]);
    EXPECT_LE(window.bound(window.end(), 0, 0), useful);
    first = window.last;
  }
  EXPECT_GT(windows, 1u);
  EXPECT_EQ(amplification_.window(0, acceleration, 0, any).last, amplification_.instants().size() - 1);
  EXPECT_EQ(amplification_.window(0, acceleration, 0, 0).last, 1u) << "one interval at least";
}

TEST_P(Growth, boundIsThatOfTheWorseNeighbour) {
  const GrowthWindow window = amplification_.window(
      0, [](double) { return 1.0; }, 0, any);
  const double between = 0.5 * (window.t[100] + window.t[101]);
  const auto at = [&](std::size_t k) {
    return window.from_acceleration[k] + 2 * window.from_unit_rate[k] + 3 * window.from_start[k];
  };
  EXPECT_EQ(window.bound(between, 2, 3), std::max(at(100), at(101)));
}

INSTANTIATE_TEST_SUITE_P(Machines, Growth, testing::Values("paper-helix", "random-2", "random-5"),
                         [](const auto& name) { return "of_" + std::string(1, name.param.back()); });

/// Rates of all 18 joints and the platform's twist for unit rates of the actuated ones.
Eigen::Matrix<double, 24, 6> ratesPerActuated(const Solver<double>& solver, Motion<double> motion) {
  Workspace<double> work;
  solver.inverseKinematics(motion, work);
  solver.jacobians(motion, work);
  const Matrix6d T = solver.T(work);
  Eigen::Matrix<double, 24, 6> out;
  for (int j = 0; j < leg_count; ++j) {
    motion.omega = T.col(j).head<3>();
    motion.p_dot = T.col(j).tail<3>();
    solver.inverseKinematics(motion, work);
    const JointVariables<double> rates = solver.rates(work);
    out.col(j) << rates.phi, rates.psi, rates.theta, T.col(j);
  }
  return out;
}

/// It is known of the helix in Simbody that 1e-8 rad/s in φ̇₁ at the start moves P by 6e-10 m at 0.5 s and by 2.6e-6 m
/// at 3 s. Simbody projects such a state onto the constraints by least squares, so that less than 1e-8 remains in φ̇₁.
TEST(PaperHelixGrowth, isAsKnown) {
  const Scenario scenario = vectorScenario("paper-helix");
  Simulation simulation(scenario);
  const Motion<double> start = scenario.trajectory->at(0);
  const Eigen::Matrix<double, 24, 6> N = ratesPerActuated(simulation.solver(), start);
  const Vector6d actuated = (N.transpose() * N).ldlt().solve(Vector6d(1e-8 * Vector6d::Unit(0)));
  const Vector6d twist = N.bottomRows<6>() * actuated;
  std::array<Simulation::State, 2> states;
  for (int side = 0; side < 2; ++side) {
    Simulation::State& x = states[static_cast<std::size_t>(side)];
    x = Simulation::stateOf(start);
    x.tail<3>() += (side == 0 ? 0.5 : -0.5) * twist.head<3>();
    x.segment<3>(7) += (side == 0 ? 0.5 : -0.5) * twist.tail<3>();
    simulation.advance(x, 0, 0.5, 100);
  }
  const double early = (states[0] - states[1]).head<3>().norm();
  for (Simulation::State& x : states) simulation.advance(x, 0.5, 3, 500);
  const double late = (states[0] - states[1]).head<3>().norm();
  std::cout << early << " m at 0.5 s, " << late << " m at 3 s\n";
  EXPECT_NEAR(early, 6e-10, 0.5e-10);  // half a unit of the last known digit
  EXPECT_NEAR(late, 2.6e-6, 0.05e-6);
}

/// A held pose that does not look held, because its last bit alternates.
class Trembling : public Trajectory {
 public:
  explicit Trembling(std::shared_ptr<const Trajectory> held) : held_(std::move(held)) {}
  std::string kind() const override { return "trembling"; }
  double duration() const override { return held_->duration(); }
  Motion<double> at(double t) const override {
    Motion<double> motion = held_->at(t);
    if (std::fmod(t, 0.1) > 0.05) motion.p.z() = std::nextafter(motion.p.z(), 2.0);
    return motion;
  }

 private:
  std::shared_ptr<const Trajectory> held_;
};

/// While a pose is held, one propagator serves all instants and gives the same growth as one for each.
TEST(AmplificationOfAHeldPose, isThatOfAnyOtherMotion) {
  Scenario scenario = vectorScenario("paper-helix");
  const Eigen::Quaterniond q(scenario.trajectory->at(1).Q);
  scenario.trajectory = makeHold(scenario.trajectory->at(1).p, {q.w(), q.x(), q.y(), q.z()}, 2);
  Scenario trembling = scenario;
  trembling.trajectory = std::make_shared<Trembling>(scenario.trajectory);
  const Amplification held(scenario, 100), other(trembling, 100);
  const auto acceleration = [](double t) { return 1e-12 * (1 + t); };
  for (double useful : {1e-10, 1e-8, 1.0}) {
    const GrowthWindow a = held.window(3, acceleration, 1e-13, useful),
                       b = other.window(3, acceleration, 1e-13, useful);
    ASSERT_EQ(a.t, b.t);
    ASSERT_GT(a.t.size(), 2U);
    for (std::size_t k = 0; k < a.t.size(); ++k) {
      EXPECT_NEAR(a.from_acceleration[k], b.from_acceleration[k], 1e-7 * b.from_acceleration[k]);
      EXPECT_NEAR(a.from_unit_rate[k], b.from_unit_rate[k], 1e-7 * b.from_unit_rate[k]);
      EXPECT_NEAR(a.from_start[k], b.from_start[k], 1e-7 * b.from_start[k]);
      EXPECT_NEAR(a.growth[k], b.growth[k], 1e-7 * b.growth[k]);
    }
    EXPECT_GT(a.from_start.back(), 1.001 * a.from_start.front());  // it does grow
  }
  EXPECT_NEAR(held.growthRate(1), other.growthRate(1), 1e-6 * other.growthRate(1));
  EXPECT_NEAR(held.carriedBound(0, 2, acceleration), other.carriedBound(0, 2, acceleration),
              1e-7 * other.carriedBound(0, 2, acceleration));
}

}  // namespace
}  // namespace ursula
