// Motions that another program made: under the right efforts, by a wrong machine, of few digits.

#include "validation/outside/given_motion.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <boost/numeric/odeint.hpp>
#include <vector>

#include "model/instants.h"
#include "model/quaternions.h"
#include "tests/base/temporary_folder.h"
#include "tests/support/changed.h"
#include "tests/support/matchers.h"
#include "tests/support/vectors.h"
#include "tests/validation/checks.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

/// p, q, v, w.
using State = std::vector<double>;

Motion<double> motionOf(const State& x, double t) {
  Motion<double> out;
  out.t = t;
  out.p = Eigen::Map<const Vector3d>(x.data());
  out.Q = Eigen::Quaterniond(x[3], x[4], x[5], x[6]).normalized().toRotationMatrix();
  out.p_dot = Eigen::Map<const Vector3d>(x.data() + 7);
  out.omega = Eigen::Map<const Vector3d>(x.data() + 10);
  return out;
}

/// The motion of a machine under efforts, from the commanded state, by an integrator with that tolerance.
class Simulated {
 public:
  Simulated(const Scenario& scenario, const Scenario& machine, double rtol) : scenario_(scenario) {
    const Subject right = nocSubject(*scenario.manipulator, scenario.load);
    const Subject made = nocSubject(*machine.manipulator, machine.load);
    const auto rate = [&](const State& x, State& out, double t) {
      const Motion<double> at = motionOf(x, t);
      const Vector6d found = made.accelerations(at, right.torques(scenario.trajectory->at(t)));
      const Eigen::Quaterniond q(x[3], x[4], x[5], x[6]);
      const Eigen::Quaterniond turn = Eigen::Quaterniond(0, at.omega(0), at.omega(1), at.omega(2)) * q;
      out = {at.p_dot(0), at.p_dot(1), at.p_dot(2), 0.5 * turn.w(), 0.5 * turn.x(), 0.5 * turn.y(), 0.5 * turn.z(),
             found(3),    found(4),    found(5),    found(0),       found(1),       found(2)};
    };
    const Motion<double> start = scenario.trajectory->at(0);
    const Eigen::Vector4d q = quaternions({start}).front();
    State x = {start.p(0),     start.p(1),     start.p(2),     q(0),           q(1),           q(2),          q(3),
               start.p_dot(0), start.p_dot(1), start.p_dot(2), start.omega(0), start.omega(1), start.omega(2)};
    namespace odeint = boost::numeric::odeint;
    times_ = equallySpaced(1.0, 201);  // the motion is unstable: a wrong one soon leaves the machine's reach
    odeint::integrate_times(odeint::make_controlled(rtol, rtol, odeint::runge_kutta_dopri5<State>()), rate, x,
                            times_.begin(), times_.end(), 1e-3,
                            [&](const State& at, double) { states_.push_back(at); });
  }

  std::filesystem::path written(const TemporaryFolder& folder, const char* form) const {
    std::string text = "t_s,p_x_m,p_y_m,p_z_m,q_w,q_x,q_y,q_z\n";
    for (std::size_t k = 0; k < states_.size(); ++k) {
      text += fmt::format("{:.17g}", times_[k]);
      for (int i = 0; i < 7; ++i)
        text += "," + fmt::format(fmt::runtime(form), states_[k][static_cast<std::size_t>(i)]);
      text += "\n";
    }
    return folder.write("motion.csv", text);
  }

 private:
  Scenario scenario_;
  std::vector<double> times_;
  std::vector<State> states_;
};

class GivenMotions : public testing::Test {
 protected:
  GivenMotions() : scenario_(vectorScenario("paper-helix")) {}

  ValidationResult judged(const Scenario& machine, double rtol, const char* form, double tolerance = 0) {
    Scenario scenario = scenario_;
    if (tolerance > 0) scenario.tolerance = EffortTolerance{tolerance, 0};
    return validateMotion(scenario, Simulated(scenario_, machine, rtol).written(folder_, form), nullptr);
  }
  Scenario heavier(double by) const {
    return changed(scenario_, [by](ManipulatorParameters& machine) { machine.platform.mass *= 1 + by; });
  }

  TemporaryFolder folder_;
  Scenario scenario_;
};

TEST_F(GivenMotions, theScenariosOwnPasses) {
  const ValidationResult result = judged(scenario_, 1e-13, "{:.17g}");
  EXPECT_NE(result.verdict, Verdict::fail);
  EXPECT_EQ(findCheck(result.checks, "replay.position")->verdict, Verdict::not_applicable);
  EXPECT_LT(result.deviation->relative(), 1e-6);
}

TEST_F(GivenMotions, ofAnIntegratorsToleranceAndFewDigitsPassUnderATolerance) {
  EXPECT_EQ(judged(scenario_, 1e-8, "{:.17g}", 1e-4).verdict, Verdict::pass);
  EXPECT_EQ(judged(scenario_, 1e-8, "{:.7f}", 1e-2).verdict, Verdict::pass);
}

TEST_F(GivenMotions, ofAWrongMassFailsAndNoOtherCauseIsNamed) {
  const ValidationResult result = judged(heavier(0.01), 1e-10, "{:.17g}", 1e-3);
  EXPECT_EQ(result.verdict, Verdict::fail);
  if (result.cause) {
    EXPECT_EQ(result.cause->parameter, "manipulator.platform.mass");
  }
  EXPECT_EQ(judged(heavier(1e-4), 1e-12, "{:.17g}").verdict, Verdict::fail);
}

TEST_F(GivenMotions, aRightOneUnderOtherEffortsFails) {
  const auto file = Simulated(scenario_, scenario_, 1e-12).written(folder_, "{:.17g}");
  const Subject right = nocSubject(*scenario_.manipulator, scenario_.load);
  GivenTorques given{"mine", equallySpaced(scenario_.trajectory->duration(), 301), {}};
  for (const double t : given.t) given.torques.push_back(right.torques(scenario_.trajectory->at(t)));
  const TorqueFile same = torqueFileOf(given);
  EXPECT_NE(validateMotion(scenario_, file, &same).verdict, Verdict::fail);
  for (Vector6d& each : given.torques) each(2) *= 1.001;
  const TorqueFile other = torqueFileOf(given);
  EXPECT_EQ(validateMotion(scenario_, file, &other).verdict, Verdict::fail);
}

TEST_F(GivenMotions, refusalsNameTheFile) {
  const auto refused = [&](const std::string& text, const std::string& words) {
    const auto file = folder_.write("bad.csv", text);
    EXPECT_THAT([&] { validateMotion(scenario_, file, nullptr); }, testing::ThrowsMessage<CsvError>(HasSubstr(words)));
  };
  refused("t_s,p_x_m\n0,1\n", "bad.csv");
  std::string few = "t_s,p_x_m,p_y_m,p_z_m,q_w,q_x,q_y,q_z\n", late = few;
  for (int k = 0; k < 10; ++k) {
    few += fmt::format("{},0,0,{},1,0,0,0\n", 0.1 * k, 2 + 0.01 * k);
    late += fmt::format("{},0,0,{},1,0,0,0\n", k, 2 + 0.01 * k);
  }
  refused(few, "10 rows show no accelerations, expected at least 32");
  refused(late, "its motion lasts 9 s, expected at most that of the scenario, 3 s");
}

}  // namespace
}  // namespace ursula
