// Mistakes about the legs of a telescopic machine whose points are rounded, each beside one that has no name.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/validation/wrong_solvers.h"

namespace ursula {
namespace {

const Trial& hexapod() {
  static const Trial trial{changed(tumblingOf("/apps/starting/UPS.toml"), [](Machine& machine) {
    machine.platform.center_of_mass = {0.05, -0.03, 0.2};
    for (Leg& leg : machine.legs) {
      leg.friction.phi = 2, leg.friction.psi = 3, leg.friction.d = 120;
      leg.proximal.center_of_mass = 0.4;
    }
  })};
  return trial;
}

Matrix3d turnAbout(double degrees) {
  return Eigen::AngleAxisd(degrees * M_PI / 180, Vector3d::UnitZ()).toRotationMatrix();
}

/// The mass centre is a number of the dynamics, and off more often than the length.
TEST(LegCause, aRodsLengthAndMassCentreAreOneNumberAndBothSaid) {
  for (const MachineChange& change :
       {ofEachLeg([](Leg& leg) { leg.distal.center_of_mass += 0.1; }), ofEachLeg([](Leg& leg) {
          leg.distal.length -= 0.1;
          leg.proximal.length += 1;
        })}) {
    const Diagnosis tied = hexapod().said(change);
    EXPECT_EQ(named(tied, CauseKind::parameter).parameter, "manipulator.leg_defaults.distal.center_of_mass");
    EXPECT_THAT(tied.cause, testing::HasSubstr("mass centre of the distal links 0.6 "));
    EXPECT_THAT(tied.cause, testing::HasSubstr("length of the distal links 0.9 "));
    ASSERT_EQ(tied.others.size(), 1u) << tied.cause;
    EXPECT_EQ(tied.others[0].parameter, "manipulator.leg_defaults.distal.length");
  }
  const Diagnosis alone = hexapod().said(ofEachLeg([](Leg& leg) { leg.proximal.center_of_mass += 0.1; }));
  EXPECT_EQ(named(alone, CauseKind::parameter).parameter, "manipulator.leg_defaults.proximal.center_of_mass");
}

TEST(LegCause, pointsThatMoveTogetherAreOneShift) {
  for (const double z : {-0.003, -0.06}) {
    const NamedCause lower =
        named(hexapod().said(ofEachLeg([z](Leg& leg) { leg.platform_point.z() += z; })), CauseKind::parameter);
    EXPECT_EQ(lower.parameter, "manipulator.leg_defaults.platform_point.2");
    EXPECT_LT(lower.uncertainty.value(), 1e-9);
    EXPECT_NEAR(lower.found.value(), z, lower.uncertainty.value() + 1e-14);
  }
  const Diagnosis aside = hexapod().said(ofEachLeg([](Leg& leg) { leg.base_point.x() += 0.02; }));
  EXPECT_EQ(named(aside, CauseKind::parameter).parameter, "manipulator.leg_defaults.base_point.0");
  EXPECT_THAT(aside.cause, testing::HasSubstr("base point x of every leg off by 0.02 "));
  const Diagnosis unequal = hexapod().said([](Machine& machine) {
    for (Leg& leg : machine.legs) leg.platform_point.z() -= 0.03;
    machine.legs[2].platform_point.z() -= 0.002;
  });
  ASSERT_EQ(unequal.together.size(), 2U) << unequal.cause;
  EXPECT_EQ(unequal.together[0].parameter, "manipulator.leg_defaults.platform_point.2");
  EXPECT_NEAR(unequal.together[0].found.value(), -0.03, 1e-12);
  EXPECT_EQ(unequal.together[1].parameter, "manipulator.leg.3.platform_point.2");
  EXPECT_NEAR(unequal.together[1].found.value(), -0.002, 2e-6);
}

TEST(LegCause, ofTwoErrorsTheSmallOneIsFoundToo) {
  const Diagnosis two = hexapod().said([](Machine& machine) {
    for (Leg& leg : machine.legs) leg.platform_point.z() -= 0.03;
    machine.legs[2].platform_point.z() -= 0.0002;
  });
  ASSERT_EQ(two.together.size(), 2U) << two.cause;
  EXPECT_NEAR(two.together[0].found.value(), -0.03, 1e-12);
  EXPECT_EQ(two.together[1].parameter, "manipulator.leg.3.platform_point.2");
  EXPECT_NEAR(two.together[1].found.value(), -0.0002, 2e-7);
}

struct LegFault {
  std::string words;
  MachineChange change;
  std::string parameter;
};

TEST(LegCause, pointsAndAxesOfAllLegsAreNamed) {
  const std::string base = "manipulator.leg_defaults.base_point", platform = "manipulator.leg_defaults.platform_point",
                    axis = "manipulator.leg_defaults.base_axis";
  const auto shifted = [](int by) {
    return [by](Machine& machine) {
      const auto before = machine.legs;
      for (std::size_t i = 0; i < 6; ++i) machine.legs[i].platform_point = before[(i + 6 + by) % 6].platform_point;
    };
  };
  const std::vector<LegFault> faults = {
      {"base points of every leg scaled by 0.98 ", ofEachLeg([](Leg& leg) { leg.base_point *= 0.98; }), base},
      {"platform points of every leg scaled by 1.25 ", ofEachLeg([](Leg& leg) { leg.platform_point *= 1.25; }),
       platform},
      {"turned about z by 60 ", ofEachLeg([](Leg& leg) { leg.platform_point = turnAbout(60) * leg.platform_point; }),
       platform},
      {"turned about z by -8 ", ofEachLeg([](Leg& leg) { leg.base_point = turnAbout(-8) * leg.base_point; }), base},
      {"leg 1 has that of leg 6", shifted(-1), platform},
      {"leg 1 has that of leg 2", shifted(1), platform},
      {"with their lengths", ofEachLeg([](Leg& leg) { std::swap(leg.proximal, leg.distal); }),
       "manipulator.leg_defaults"},
      {"platform point y of leg 4 ", [](Machine& machine) { machine.legs[3].platform_point.y() *= -1; },
       "manipulator.leg.4.platform_point.1"},
      {"base axes along x", ofEachLeg([](Leg& leg) { leg.base_axis = Vector3d::UnitX(); }), axis},
      {"base axes along z", ofEachLeg([](Leg& leg) { leg.base_axis = Vector3d::UnitZ(); }), axis},
      {"base axes along the radii", ofEachLeg([](Leg& leg) { leg.base_axis = leg.base_point; }), axis}};
  for (const LegFault& fault : faults) {
    const Diagnosis found = hexapod().said(fault.change);
    EXPECT_EQ(named(found, CauseKind::parameter).parameter, fault.parameter);
    EXPECT_THAT(found.cause, testing::HasSubstr(fault.words));
  }
  const Diagnosis both =
      hexapod().said(ofEachLeg([](Leg& leg) { leg.platform_point = 1.1 * (turnAbout(60) * leg.platform_point); }));
  EXPECT_FALSE(both.named) << both.cause;
}

TEST(LegCause, frictionOfTheDrivenJointsIsToldFromTheOthers) {
  const auto with = [](double passive, double driven) {
    const Answering without = hexapod().solver(ofEachLeg([=](Leg& leg) {
      leg.friction.d = 0;
      if (passive == 0) leg.friction = {};
    }));
    return [=](const Motion<double>& motion) {
      const Vector6d rates = nocSubject(*hexapod().scenario.manipulator, nullptr)
                                 .kinematics(motion)
                                 .joints.q_dot.driven(hexapod().scenario.manipulator->motors());
      return Vector6d(without(motion) + driven * 120 * rates);
    };
  };
  const auto said = [&](double passive, double driven) {
    return hexapod().said(hexapod().answers(with(passive, driven)));
  };
  EXPECT_EQ(named(said(1, 0), CauseKind::missing_term).parameter, "manipulator.leg_defaults.friction.d");
  const NamedCause opposite = named(said(1, -1), CauseKind::sign);
  EXPECT_EQ(opposite.term, "friction");
  EXPECT_EQ(opposite.parameter, "manipulator.leg_defaults.friction.d");
  EXPECT_EQ(named(said(0, 0), CauseKind::missing_term).parameter, "") << "friction of all joints";
}

TEST(LegCause, aWrongJacobianIsNamedBeforeTheMotorsFriction) {
  const Answering without = hexapod().solver(ofEachLeg([](Leg& leg) { leg.friction.d = 0; }));
  const Scenario bare = changed(hexapod().scenario, ofEachLeg([](Leg& leg) { leg.friction.d = 0; }));
  const auto added = [&](const std::function<Vector6d(const MachineTerms&)>& wrong) {
    const Subject right = nocSubject(*hexapod().scenario.manipulator, nullptr);
    return hexapod().said(hexapod().answers([&](const Motion<double>& motion) {
      return Vector6d(wrong(machineTerms(*bare.manipulator, nullptr, motion)) + right.torques(motion) -
                      without(motion));
    }));
  };
  Matrix6d exchanged = Matrix6d::Zero();
  exchanged.topRightCorner<3, 3>() = exchanged.bottomLeftCorner<3, 3>() = Matrix3d::Identity();
  for (const Diagnosis& found :
       {added([](const MachineTerms& machine) { return Vector6d(machine.T_P * machine.forceAtP()); }),
        added([&](const MachineTerms& machine) {
          return Vector6d(machine.T_P.transpose() * exchanged * machine.forceAtP());
        })}) {
    named(found, CauseKind::jacobian);
    EXPECT_THAT(found.cause, testing::HasSubstr("before the motors' own friction"));
  }
  const Diagnosis half = added([](const MachineTerms& machine) {
    return Vector6d(0.5 * (machine.T_P + machine.T_P.transpose()) * machine.forceAtP());
  });
  EXPECT_FALSE(half.named) << half.cause;
}

TEST(LegCause, rodsThatDoNotSlideAreNamed) {
  const auto rods = [](const std::function<double(double along)>& left_out) {
    return hexapod().said(hexapod().answers([=](const Motion<double>& motion) {
      const Subject noc = nocSubject(*hexapod().scenario.manipulator, nullptr);
      const Vector6d along = noc.kinematics(motion).joints.q_ddot.driven(hexapod().scenario.manipulator->motors());
      return Vector6d(noc.torques(motion) - along.unaryExpr(left_out));
    }));
  };
  const Diagnosis along = rods([](double each) { return 12 * each; });
  EXPECT_EQ(named(along, CauseKind::missing_term).body, "distal");
  EXPECT_FALSE(rods([](double each) { return 7 * each; }).named) << "no body has this mass";
  const std::vector<Motion<double>> motions = hexapod().motions();
  std::size_t seen = 0;
  for (const Cause& cause : causesOf(hexapod().scenario, addSlidingCauses)) {
    if (!cause.fitted) continue;
    ++seen;
    const Diagnosis fixed = hexapod().said(cause.torques(0.9, motions));
    named(fixed, CauseKind::reference_point);
    EXPECT_THAT(fixed.cause, testing::HasSubstr("fixed at 0.9 "));
  }
  EXPECT_EQ(seen, 2u);
}

/// NumPy's gradient with its usual ends, of velocities.
Rows withGradients(bool velocities, const std::vector<Motion<double>>& motions) {
  const auto gradient = [&](const auto& of) {
    std::vector<Vector3d> out;
    const double h = motions[1].t - motions[0].t;
    const std::size_t last = motions.size() - 1;
    for (std::size_t k = 0; k <= last; ++k) {
      const std::size_t a = k == 0 ? 0 : k - 1, b = k == last ? last : k + 1;
      out.push_back((of(b) - of(a)) / (static_cast<double>(b - a) * h));
    }
    return out;
  };
  std::vector<Vector3d> v = gradient([&](std::size_t k) -> Vector3d { return motions[k].p; });
  if (!velocities)
    for (std::size_t k = 0; k < v.size(); ++k) v[k] = motions[k].p_dot;
  const std::vector<Vector3d> a = gradient([&](std::size_t k) -> Vector3d { return v[k]; }),
                              alpha = gradient([&](std::size_t k) -> Vector3d { return motions[k].omega; });
  Rows out;
  for (std::size_t k = 0; k < motions.size(); ++k) {
    Motion<double> motion = motions[k];
    motion.p_dot = v[k], motion.p_ddot = a[k], motion.omega_dot = alpha[k];
    out.push_back(nocSubject(*hexapod().scenario.manipulator, nullptr).torques(motion));
  }
  return out;
}

TEST(LegCause, differencesOfTheGivenInstantsAreNotNoise) {
  const std::vector<Motion<double>> motions = hexapod().motions();
  for (const bool velocities : {false, true}) {
    const Rows efforts = withGradients(velocities, motions);
    const Diagnosis found = hexapod().said(efforts);
    EXPECT_THAT(found.cause, testing::HasSubstr("differences of"));
    EXPECT_THAT(found.cause, testing::HasSubstr("one-sided at the ends, which explains more than 99.9999 %"));
    EXPECT_FALSE(found.named) << "the contract has no name for it";
    Rows worse = efforts;  // of another rule that is as wrong at the ends
    const Rows right = hexapod().right();
    for (std::size_t k = 0; k < worse.size(); ++k) worse[k] += 0.4 * (worse[k] - right[k]);
    EXPECT_EQ(hexapod().said(worse).cause.find("no pattern"), std::string::npos) << hexapod().said(worse).cause;
  }
}

/// Errors that a number for each motor explains in part.
TEST(LegCause, asManyNumbersAsMotorsAreNotTheBest) {
  const Rows right = hexapod().right();
  const auto off = [&](double noise) {
    SeededDraws dice(4);
    Rows out = right;
    for (Vector6d& row : out)
      for (int i = 0; i < motor_count; ++i) row(i) += 30 * (i + 1) + noise * dice.between(-1, 1);
    return hexapod().said(out);
  };
  EXPECT_EQ(off(50).cause.find("offset"), std::string::npos) << off(50).cause;
  named(off(0), CauseKind::offset);
}

/// Little is left of the deviation, but much of the little that was answered.
TEST(LegCause, whatExplainsNearlyAllIsNotOnly) {
  const Answering weightless = hexapod().solver([](Machine& machine) { machine.gravity.setZero(); });
  const auto off = [&](double noise) {
    SeededDraws dice(4);
    return hexapod().said(hexapod().answers([&](const Motion<double>& motion) {
      return Vector6d(weightless(motion) + noise * Vector6d::NullaryExpr([&] { return dice.between(-1, 1); }));
    }));
  };
  const Diagnosis little = off(4), much = off(300);
  EXPECT_THAT(little.cause,
              testing::StartsWith("no simple explanation. The best: gravity left out, which explains 99."));
  EXPECT_THAT(little.cause, testing::HasSubstr("% of the deviation. It leaves "));
  EXPECT_THAT(little.cause, testing::HasSubstr("% of what was answered. Next: "));
  EXPECT_EQ(much.cause.find("It leaves"), std::string::npos) << much.cause;
}

}  // namespace
}  // namespace ursula
