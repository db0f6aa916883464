// Motions of mechanisms that another program made: unstable, with friction, of few rows; right ones and wrong ones.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "base/errors.h"
#include "model/instants.h"
#include "tests/base/temporary_folder.h"
#include "tests/loops/loop_scenario.h"
#include "validation/outside/given_motion.h"

namespace ursula {
namespace {

using testing::HasSubstr;

constexpr int rows_in_all = 2001;

/// A five-bar whose motors rub.
MechanismScenario rubbing(double friction) {
  const std::filesystem::path file = URSULA_LOOPS "../../../scenarios/mechanisms/fivebar.toml";
  return changedScenario(readMechanism(file, partModelReader()), [friction](MechanismParameters& machine) {
    for (MechanismJoint& joint : machine.joints)
      if (joint.friction > 0) joint.friction = friction;
  });
}

/// The right efforts of the scenario's motion, and a little more, so that the motion soon is another one.
MotorEfforts given(const MechanismAlong& along, double t) {
  LoopWork work;
  MotorEfforts out = along.motion().inverseDynamics(std::min(t, along.motion().trajectory().duration()), work);
  out(0) += 0.02 * std::sin(5 * t);
  out(1) += 0.03 - 0.03 * std::cos(7 * t);
  return out;
}

/// The motion of a machine under these efforts, until the loops leave their reach.
class Simulated {
 public:
  Simulated(const MechanismScenario& scenario, const MechanismScenario& machine) : scenario_(scenario) {
    using State = std::vector<double>;
    namespace odeint = boost::numeric::odeint;
    const MechanismAlong right(scenario), made(machine);
    const MotorMotion start = scenario.trajectory->at(0);
    const Eigen::Index n = start.q.size();
    State x(start.q.begin(), start.q.end());
    x.insert(x.end(), start.qdot.begin(), start.qdot.end());
    loops::LoopPose near = made.motion().near(0);
    LoopWork work;
    const auto motionOf = [n](const State& at, double t) {
      const Eigen::Map<const Eigen::VectorXd> all(at.data(), 2 * n);
      return MotorMotion{t, all.head(n), all.tail(n), Eigen::VectorXd::Zero(n)};
    };
    const auto rate = [&](const State& at, State& out, double t) {
      const MotorMotion motion = motionOf(at, t);
      const Eigen::VectorXd found = made.solver().directDynamics(motion, given(right, t), near, work);
      out.assign(motion.qdot.begin(), motion.qdot.end());
      out.insert(out.end(), found.begin(), found.end());
    };
    const std::vector<double> times = equallySpaced(scenario.trajectory->duration(), rows_in_all);
    const auto stepper = odeint::make_controlled(1e-11, 1e-11, odeint::runge_kutta_dopri5<State>());
    for (const double t : times) try {
        if (t > 0) odeint::integrate_adaptive(stepper, rate, x, t_.back(), t, 1e-4);
        const MotorMotion now = motionOf(x, t);
        made.solver().moveTo(now.q, near);
        t_.push_back(t);
        q_.push_back(now.q);
        efforts_.push_back(given(right, t));
      } catch (const LoopError&) {
        break;
      }
    t_.resize(t_.size() * 9 / 10);  // away from where they end
  }

  /// Each `step`-th row, coordinates alone.
  std::filesystem::path written(const TemporaryFolder& folder, std::size_t step) const {
    std::string text = "t_s,q_1_rad,q_2_rad\n";
    for (std::size_t i = 0; i < t_.size(); i += step)
      text += fmt::format("{:.17g},{:.17g},{:.17g}\n", t_[i], q_[i](0), q_[i](1));
    return folder.write("motion.csv", text);
  }
  GivenEfforts efforts() const {
    GivenEfforts out;
    out.name = "mine.csv";
    out.t = t_;
    out.efforts.assign(efforts_.begin(), efforts_.begin() + static_cast<std::ptrdiff_t>(t_.size()));
    out.precision.assign(t_.size(), MotorEfforts::Zero(2));
    return out;
  }
  ValidationResult judged(const TemporaryFolder& folder, std::size_t step, double tolerance) const {
    MechanismScenario scenario = scenario_;
    if (tolerance > 0) scenario.tolerance = EffortTolerance{tolerance, 0};
    const GivenEfforts under = efforts();
    return validateMotion(scenario, written(folder, step), &under);
  }
  double duration() const { return t_.back(); }

 private:
  MechanismScenario scenario_;
  std::vector<double> t_;
  std::vector<Eigen::VectorXd> q_;
  std::vector<MotorEfforts> efforts_;
};

class RubbingMotion : public testing::TestWithParam<double> {};

/// Strong friction is left out: a motion that sticks is called wrong still.
TEST(LittleFriction, IsNeverWrongHoweverFarApartItsRowsAre) {
  const TemporaryFolder folder;
  const MechanismScenario scenario = rubbing(0.05);
  const Simulated right(scenario, scenario);
  EXPECT_GT(right.duration(), 0.5);
  for (const double tolerance : {0.0, 1e-3})
    for (const std::size_t step : {1, 10, 30}) {
      const ValidationResult result = right.judged(folder, step, tolerance);
      EXPECT_NE(result.verdict, Verdict::fail) << step << ' ' << tolerance;
      if (step == 1) {
        EXPECT_EQ(result.verdict, Verdict::pass) << tolerance;
      }
    }
}

TEST_P(RubbingMotion, OfAWrongMachineFailsByRowsThatAreCloseEnoughAndNeverPasses) {
  const TemporaryFolder folder;
  const MechanismScenario scenario = rubbing(GetParam());
  const Simulated heavier(scenario, changedScenario(scenario, [](MechanismParameters& machine) {
                            for (MechanismBody& body : machine.bodies) body.mass *= 1.01;
                          }));
  const Simulated smooth(scenario, rubbing(0));
  for (const Simulated* wrong : {&heavier, &smooth})
    for (const std::size_t step : {3, 10})
      for (const double tolerance : {0.0, 1e-3}) {
        const Verdict verdict = wrong->judged(folder, step, tolerance).verdict;
        EXPECT_NE(verdict, Verdict::pass) << step << ' ' << tolerance << (wrong == &smooth ? " smooth" : " heavier");
        if (step <= 3) {
          EXPECT_EQ(verdict, Verdict::fail) << step << ' ' << tolerance << (wrong == &smooth ? " smooth" : " heavier");
        }
      }
}

INSTANTIATE_TEST_SUITE_P(Friction, RubbingMotion, testing::Values(0.05, 0.3));

/// Rows as far apart as the verdict asks for decide.
TEST(MotionOfFewRows, SaysHowManyWouldDo) {
  const TemporaryFolder folder;
  const MechanismScenario scenario = rubbing(0.05);
  const Simulated right(scenario, scenario);
  const ValidationResult coarse = right.judged(folder, 10, 1e-3);
  EXPECT_EQ(coarse.verdict, Verdict::inconclusive);
  const std::string why = findCheck(coarse.checks, "torque.between")->why, before = "rows some ";
  ASSERT_THAT(why, HasSubstr("s apart would do"));
  const double enough = std::stod(why.substr(why.find(before) + before.size()));
  const double row = scenario.trajectory->duration() / (rows_in_all - 1);
  EXPECT_LT(enough, 10 * row);
  ASSERT_GE(enough, row);
  EXPECT_EQ(right.judged(folder, static_cast<std::size_t>(enough / row), 1e-3).verdict, Verdict::pass) << why;
}

}  // namespace
}  // namespace ursula
