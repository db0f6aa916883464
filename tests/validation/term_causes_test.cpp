// Terms and loops of machines of every kind: taken together they are the NOC's efforts, and each mistake changes these.

#include "parts/causes/tried_causes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <set>

#include "nocsolver/errors.h"
#include "parts/causes/fits.h"
#include "tests/validation/wrong_solvers.h"
#include "validation/limits/conditioning.h"

namespace ursula {
namespace {

class Terms : public testing::TestWithParam<const char*> {
 protected:
  const Scenario scenario_ = readScenario(std::string(URSULA_SOURCE) + "/apps/starting/" + GetParam() + ".toml");
  const Manipulator& machine_ = *scenario_.manipulator;

  /// A motion with every term in it: the scenario's own pose, other velocities.
  Motion<double> motion() const {
    Motion<double> out = scenario_.trajectory->at(0.4 * scenario_.trajectory->duration());
    out.omega = Vector3d(0.7, -0.4, 0.5);
    out.p_dot = Vector3d(-0.3, 0.6, 0.2);
    out.omega_dot = Vector3d(1.1, 0.9, -2);
    out.p_ddot = Vector3d(2, -1, 3);
    return out;
  }
  Vector6d expected(const Manipulator& machine) const { return nocSubject(machine, nullptr).torques(motion()); }
};

TEST_P(Terms, makeTheEfforts) {
  const MachineTerms terms = machineTerms(machine_, nullptr, motion());
  const Vector6d efforts = terms.T_P.transpose() * terms.forceAtP();
  ASSERT_GT(efforts.cwiseAbs().maxCoeff(), 1);
  const double rounding = ConditioningProbe(machine_, nullptr).at(motion()).torqueRounding();
  EXPECT_LE((efforts - expected(machine_)).cwiseAbs().maxCoeff(), rounding);
  ManipulatorParameters heavier = machine_.parameters();
  heavier.legs[2].distal.mass *= 1 + 1e-6;
  EXPECT_GT((efforts - expected(Manipulator(heavier))).cwiseAbs().maxCoeff(), rounding) << "what is wrong is seen";
}

TEST_P(Terms, areEachSeen) {
  std::set<std::string> kinds;
  const Vector6d right = expected(machine_);
  std::size_t seen = 0;
  for (const auto& group : {addTermCauses, addJacobianCauses, addLoopCauses}) {
    const std::vector<Cause> causes = causesOf(scenario_, group);
    ASSERT_FALSE(causes.empty());
    for (const Cause& cause : causes) {
      const Vector6d wrong = cause.torques(0, {motion()}).at(0);
      ASSERT_TRUE(wrong.allFinite()) << cause.words(0, 0);
      if (!((wrong - right).norm() > 1e-9 * right.norm())) continue;
      ++seen;
      const NamedCause named = cause.named(0, 0).value();
      kinds.insert(std::string(name(named.kind)) + " " + named.term);
    }
  }
  EXPECT_GT(seen, 40u);
  for (const char* each : {"missing_term gravity", "missing_term gyroscopic", "missing_term angular_acceleration",
                           "missing_term centripetal", "missing_term coriolis", "missing_term inertia",
                           "missing_term spin", "frame inertia", "reference_point inertia", "jacobian ", "closure open",
                           "closure least_squares", "closure bias"})
    EXPECT_THAT(kinds, testing::Contains(each));
}

INSTANTIATE_TEST_SUITE_P(Kinds, Terms, testing::Values("URS", "UPS", "RUS", "PUS"));

/// The loops are left open but for forces in proportion to J̇ u, with a number of its own for each leg.
TEST_P(Terms, softLoopsAreNamedAndNothingAlike) {
  const auto residual = [this](double sign, double viscous) {
    TorqueResidual out;
    const Subject noc = nocSubject(machine_, nullptr);
    for (int k = 0; k < 8; ++k) {
      Motion<double> at = motion();
      at.omega *= 1 + 0.1 * k;
      at.p_dot.x() -= 0.1 * k;
      const MachineTerms terms = machineTerms(machine_, nullptr, at);
      Vector6d found;
      for (int m = 0; m < motor_count; ++m) {
        const Motor& motor = machine_.motors()[static_cast<std::size_t>(m)];
        const OpenLeg& leg = terms.legs[static_cast<std::size_t>(motor.leg)];
        const Vector3d off = sign * (leg.bias - leg.platform_bias) + viscous * at.p_dot;
        found(m) = leg.efforts(motor.joint) - (100 + 10 * m) * (leg.J.transpose() * off)(motor.joint);
      }
      out.add(at, noc.torques(at), found, Vector6d::Constant(1e-7));
    }
    out.commanded = out.exact.size();
    return out;
  };
  const std::optional<Hypothesis> soft = softLoops(scenario_, residual(1, 0));
  ASSERT_TRUE(soft.has_value());
  EXPECT_LE(soft->unexplained, 1e-9);
  EXPECT_LE(soft->beyond, 1);
  EXPECT_EQ(soft->named->term, "soft");
  EXPECT_THAT(soft->text, testing::HasSubstr("100 to 150 kg"));
  EXPECT_FALSE(softLoops(scenario_, residual(-1, 0)).has_value()) << "no closure pushes its gap open";
  const std::optional<Hypothesis> viscous = softLoops(scenario_, residual(1, 3));
  if (viscous) {
    EXPECT_GT(viscous->unexplained, 1e-3) << "forces of another kind are not soft closures";
  }
  EXPECT_FALSE(softLoops(scenario_, residual(0, 0)).value_or(Hypothesis()).beyond <= 1) << "nor are open loops";
}

/// A telescopic machine with rotors, Coulomb friction and a load, on a motion that turns about every axis.
Trial withRotors() {
  Scenario scenario = changed(tumblingOf("/apps/starting/UPS.toml"), [](Machine& machine) {
    machine.platform.inertia << 50, 4, -3, 4, 60, 5, -3, 5, 95;
    machine.platform.center_of_mass = {0.05, -0.03, 0.2};
    for (Leg& leg : machine.legs) {
      leg.rotor_inertia.d = 30;
      leg.coulomb.phi = leg.coulomb.psi = leg.coulomb.d = 5;
      leg.coulomb.smoothing_speed = leg.coulomb.sliding_speed = 0.02;
    }
  });
  Load load;
  load.force = {40, -30, 20};
  load.point = {0.2, 0.1, -0.3};
  scenario.load = std::make_shared<Load>(load);
  return {scenario, 31};
}

std::vector<Cause> causesLike(const Scenario& scenario, const std::string& words) {
  std::vector<Cause> out;
  for (const auto& group : {addTermCauses, addJointCauses, addJacobianCauses, addLoopCauses, addSlidingCauses,
                            addMotionCauses, addMachineCauses})
    for (const Cause& cause : causesOf(scenario, group))
      if (cause.words(0, 0).find(words) != std::string::npos) out.push_back(cause);
  return out;
}

class Mistake : public testing::TestWithParam<const char*> {};

TEST_P(Mistake, isNamedAsItself) {
  const Trial trial = withRotors();
  const std::vector<Cause> causes = causesLike(trial.scenario, GetParam());
  ASSERT_EQ(causes.size(), 1u);
  const double x = causes.front().fitted ? std::log(7.0) : 0;
  const NamedCause expected = causes.front().named(x, 0).value();
  const NamedCause found = named(trial.said(causes.front().torques(x, trial.motions())), expected.kind);
  EXPECT_EQ(found.term, expected.term);
  EXPECT_EQ(found.parameter, expected.parameter);
}

INSTANTIATE_TEST_SUITE_P(
    Telescopic, Mistake,
    testing::Values(
        "inertia of the platform turned on one side only",
        "the moment of inertia of the platform left in its own frame",
        "the gyroscopic moment of the platform left in its own frame", "moment about P of gravity",
        "moment about P of the force of inertia", "spin of the links about their own lines left out of omega",
        "cylinders measured back from the platform's joints", "rods measured from the base's joints",
        "Coriolis acceleration halved in the joints' accelerations and the rods'",
        "forces of the legs across their lines", "each leg carries the same part of the platform",
        "that carry the platform, and those of the legs", "the legs' forces about the platform's mass centre",
        "the legs' forces about the base's origin", "the Jacobian about the base's origin",
        "the platform's forces about the base's origin", "the point where the load acts not turned",
        "the point where the load acts turned the wrong way", "the rotors' inertia with the wrong sign",
        "Coriolis acceleration doubled in the joints' accelerations and the rods'",
        "the Coriolis acceleration of the distal links doubled", "the gyroscopic moment of the links doubled",
        "the smoothing speed of Coulomb friction, on angles and on d",
        "joint accelerations without the rate of the Jacobian of legs and platform",
        "second rates of roll, pitch and yaw without the rate", "roll, pitch and yaw turned in the other order",
        "x, y, z turned in the other order", "the position of the platform's mass centre taken for that of P",
        "m |rho|^2 added to every moment", "the load's point with the wrong sign", "half of omega and its rate",
        "the arm of the platform's weight not turned", "weights of the distal links put at their first joints",
        "that comes from turning left out", "inertia of the platform read in the order xx, yy, zz, xy, yz, xz",
        "Coulomb friction of the rates' sizes",
        "the rotors' accelerations without the rate of the Jacobian of the legs"),
    [](const auto& each) { return "n" + std::to_string(each.index); });

/// A solver that reads the motion wrongly, and whose legs have no end of stroke.
TEST(ReadingCause, isNamedBeyondTheStrokeAndOfBothRates) {
  const Trial trial = withRotors();
  const auto said = [&](const std::function<void(Motion<double>&)>& misread) {
    return trial.said(trial.answers([&](Motion<double> motion) {
      misread(motion);
      return trial.solver()(motion);
    }));
  };
  const auto x_first = [](Motion<double>& motion) {
    const Eigen::Quaterniond q(motion.Q);
    motion.Q = Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y()).toRotationMatrix();
  };
  Motion<double> turned = trial.motions().front();
  x_first(turned);
  EXPECT_THROW(nocSubject(*trial.scenario.manipulator, trial.scenario.load).torques(turned), PoseError)
      << "it is not beyond the stroke";
  EXPECT_EQ(named(said(x_first), CauseKind::frame).term, "orientation");
  const auto in_degrees = [](Motion<double>& motion) {
    motion.omega *= 180 / M_PI;
    motion.omega_dot *= 180 / M_PI;
  };
  EXPECT_EQ(named(said(in_degrees), CauseKind::units).term, "angular_velocity");
  EXPECT_EQ(named(said([](auto& motion) { motion.omega /= 2; }), CauseKind::scale).term, "angular_velocity");
  EXPECT_TRUE(said([](auto&) {}).summary.empty()) << "of right efforts nothing is said";
}

/// Torques of a solver that knows nothing of the scenario's rotors, and the other way round.
TEST(RotorCause, isNamedEitherWayAndNeverNegative) {
  const Trial without{readScenario(std::string(URSULA_SOURCE) + "/apps/starting/UPS.toml"), 61};
  const MachineChange add = ofEachLeg([](Leg& leg) { leg.rotor_inertia.d = 30; });
  const Trial with{changed(without.scenario, add), 61};
  EXPECT_EQ(named(with.said(without.right()), CauseKind::missing_term).term, "rotor_inertia");
  const NamedCause added = named(without.said(add), CauseKind::missing_term);
  EXPECT_EQ(added.term, "rotor_inertia");
  EXPECT_NEAR(added.found.value(), 30, 1e-6);
  EXPECT_EQ(added.unit, "kg");
  EXPECT_TRUE(with.said(with.right()).summary.empty()) << "of right efforts nothing is said";
}

}  // namespace
}  // namespace ursula
