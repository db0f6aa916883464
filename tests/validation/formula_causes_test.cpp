// Mistakes of a solver's own formulas on machines of several kinds, each beside one that is no such mistake.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>

#include "tests/validation/wrong_solvers.h"

namespace ursula {
namespace {

/// The right efforts and a share of the mistake with these words.
Rows mistaken(const Trial& trial, const std::string& words, double share) {
  Rows out = trial.right();
  std::size_t found = 0;
  for (const auto& group : {addTermCauses, addJointCauses, addMachineCauses})
    for (const Cause& cause : causesOf(trial.scenario, group)) {
      if (cause.words(0, 0) != words) continue;
      ++found;
      const Rows wrong = cause.torques(0, trial.motions());
      for (std::size_t k = 0; k < out.size(); ++k) out[k] += share * (wrong[k] - out[k]);
    }
  EXPECT_EQ(found, 1u) << words;
  return out;
}

struct Words {
  const char *kind, *text;
  CauseKind named;
  const char *term, *body;
};

class FormulaCause : public testing::TestWithParam<Words> {};

TEST_P(FormulaCause, isNamedAndTheHalfOfItIsNot) {
  const auto& [kind, text, expected, term, body] = GetParam();
  const Trial trial{tumblingOf(std::string("/apps/starting/") + kind + ".toml")};
  const NamedCause whole = named(trial.said(mistaken(trial, text, 1)), expected);
  EXPECT_EQ(whole.term, term);
  EXPECT_EQ(whole.body, body);
  const Diagnosis half = trial.said(mistaken(trial, text, 0.5));
  EXPECT_FALSE(half.summary.empty());
  EXPECT_FALSE(half.named && half.named->kind == expected && half.named->term == term) << half.cause;
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, FormulaCause,
    testing::Values(
        Words{"URS", "angular velocity and acceleration of the distal links relative to the proximal ones",
              CauseKind::frame, "angular_velocity", "distal"},
        Words{"RUS",
              "angular velocity and acceleration of the distal links relative to the proximal ones, without the "
              "turning of the joints' axes",
              CauseKind::frame, "angular_velocity", "distal"},
        Words{"RUS", "angular acceleration of the distal links relative to the proximal ones, in the moments alone",
              CauseKind::frame, "angular_acceleration", "distal"},
        Words{"RUS", "the Jacobian of each leg where its inverse transposed belongs", CauseKind::jacobian, "", "legs"},
        Words{"URS", "weights of the distal links put at their first joints", CauseKind::reference_point, "gravity",
              "distal"},
        Words{"PUS", "weights of the distal links put at their first joints", CauseKind::reference_point, "gravity",
              "distal"},
        Words{"UPS", "gravity of the proximal links left out", CauseKind::missing_term, "gravity", "proximal"},
        Words{"PUS", "m |rho|^2 added to every moment of inertia of the platform, without the outer product",
              CauseKind::reference_point, "inertia", "platform"},
        Words{"UPS", "the arm of the platform's weight turned the wrong way", CauseKind::frame, "gravity", "platform"}),
    [](const auto& each) { return "n" + std::to_string(each.index); });

TEST(MachineCause, ofOneLegIsNamed) {
  const Trial trial{changed(tumblingOf("/apps/starting/URS.toml"),
                            ofEachLeg([](Leg& leg) { leg.proximal.mass = 14, leg.proximal.inertia *= 2; }))};
  const auto exchange = [](Leg& leg) {
    std::swap(leg.proximal.mass, leg.distal.mass);
    std::swap(leg.proximal.center_of_mass, leg.distal.center_of_mass);
    std::swap(leg.proximal.inertia, leg.distal.inertia);
  };
  const NamedCause second =
      named(trial.said([&](Machine& machine) { exchange(machine.legs[1]); }), CauseKind::parameter);
  EXPECT_EQ(second.parameter, "manipulator.leg.2");
  EXPECT_EQ(second.leg, 2);
  const Diagnosis two = trial.said([&](Machine& machine) { exchange(machine.legs[1]), exchange(machine.legs[4]); });
  ASSERT_EQ(two.together.size(), 2U) << two.cause;
  EXPECT_EQ(two.together[0].leg + two.together[1].leg, 7);
  const NamedCause sign =
      named(trial.said([](Machine& machine) { machine.legs[3].base_axis.z() *= -1; }), CauseKind::parameter);
  EXPECT_EQ(sign.parameter, "manipulator.leg.4.base_axis.2");
  EXPECT_EQ(sign.found.value(), -sign.expected.value());
  EXPECT_FALSE(trial
                   .said([](Machine& machine) {
                     for (const std::size_t i : {1, 3}) machine.legs[i].base_axis.z() *= -1;
                   })
                   .named);
}

TEST(MachineCause, ofAllLegsIsNamed) {
  const Trial hexapod{tumblingOf("/apps/starting/UPS.toml")};
  const auto along = [&](const Vector3d& axis) {
    return hexapod.said(ofEachLeg([axis](Leg& leg) { leg.base_axis = axis; }));
  };
  const NamedCause axis = named(along(Vector3d::UnitX()), CauseKind::parameter);
  EXPECT_EQ(axis.parameter, "manipulator.leg_defaults.base_axis");
  EXPECT_EQ(axis.leg, 0);
  EXPECT_FALSE(along({1, 0.3, 0.2}).named);
  const auto round = [](double about_line, bool spins) {
    return ofEachLeg([=](Leg& leg) {
      leg.proximal.inertia(2, 2) = leg.distal.inertia(2, 2) = about_line;
      leg.spins = spins;
    });
  };
  const Trial free{changed(hexapod.scenario, round(0.3, true))};
  EXPECT_EQ(named(free.said(round(0.3, false)), CauseKind::missing_term).term, "spin");
  const Diagnosis other = free.said(round(0.2, false));
  EXPECT_FALSE(other.named && other.named->term == "spin") << other.cause;
}

TEST(MachineCause, massCentresPutOnTheLineAreNamed) {
  const Trial trial{changed(tumblingOf("/apps/starting/UPS.toml"), ofEachLeg([](Leg& leg) {
                              leg.proximal.off_line = {0.06, -0.03, 0};
                            }))};
  const auto said = [&](double share) {
    return trial.said(ofEachLeg([share](Leg& leg) { leg.proximal.off_line *= share; }));
  };
  EXPECT_EQ(named(said(0), CauseKind::reference_point).body, "proximal");
  const Diagnosis nearer = said(0.4);
  EXPECT_FALSE(nearer.named && nearer.named->kind == CauseKind::reference_point) << nearer.cause;
}

/// The inertia of one kind's links about their first joints: Cause::legs are those of the kind.
TEST(MixedCause, ofOneKindHasItsLegs) {
  const Trial trial{tumblingOf("/scenarios/mixture.toml")};
  const auto aboutJoint = [](Leg& leg) {
    for (Link* link : {&leg.proximal, &leg.distal})
      for (int k : {0, 1}) link->inertia(k, k) += link->mass * link->center_of_mass * link->center_of_mass;
  };
  std::vector<int> legs;
  const Diagnosis said = trial.said([&](Machine& machine) {
    for (std::size_t i = 0; i < machine.legs.size(); ++i) {
      if (machine.legs[i].kind != LegKind::URS) continue;
      aboutJoint(machine.legs[i]);
      legs.push_back(static_cast<int>(i) + 1);
    }
  });
  ASSERT_EQ(legs.size(), 2u);
  EXPECT_EQ(named(said, CauseKind::reference_point).legs, legs);
  const Diagnosis other = trial.said([&](Machine& machine) {
    for (const std::size_t i : {0, 1}) aboutJoint(machine.legs[i]);
  });
  EXPECT_FALSE(other.named) << other.cause;
}

/// Moments in N·mm beside forces in N, in a machine of both.
TEST(ColumnCause, unitsOfMomentsAloneAreNamedWithTheirMotors) {
  const Trial trial{tumblingOf("/scenarios/mixture.toml")};
  std::vector<int> turning;
  for (int k = 0; k < motor_count; ++k)
    if (!trial.scenario.manipulator->motors()[static_cast<std::size_t>(k)].slides()) turning.push_back(k + 1);
  ASSERT_GT(turning.size(), 1u);
  ASSERT_LT(turning.size(), 6u);
  const auto times = [&](double factor, double of_first) {
    Rows out = trial.right();
    for (Vector6d& row : out) {
      for (const int motor : turning) row(motor - 1) *= factor;
      row(turning.front() - 1) *= of_first;
    }
    return trial.said(out);
  };
  const NamedCause units = named(times(1000, 1), CauseKind::units);
  EXPECT_EQ(units.legs, turning);
  EXPECT_NEAR(units.found.value(), 1000, 1e-6);
  const Diagnosis uneven = times(1000, 1.1);
  EXPECT_FALSE(uneven.named && uneven.named->kind == CauseKind::units) << uneven.cause;
  const Rows flipped = trial.rightBut([](std::size_t, Vector6d& row) { row(1) *= -1, row(4) *= -1; });
  EXPECT_THAT(named(trial.said(flipped), CauseKind::sign).legs, testing::ElementsAre(2, 5));
}

TEST(WindowCause, effortsCutOffAreNamed) {
  const Trial trial{tumblingOf("/apps/starting/PUS.toml")};
  const auto cut = [&](const Vector6d& factor) {
    constexpr std::size_t entries = 12;
    Rows out = trial.right();
    std::vector<double> sizes;
    for (const Vector6d& row : out)
      for (int i = 0; i < motor_count; ++i) sizes.push_back(std::abs(row(i)));
    std::sort(sizes.rbegin(), sizes.rend());
    const double limit = sizes[entries];
    for (Vector6d& row : out) row = row.cwiseProduct(factor).cwiseMin(limit).cwiseMax(-limit);
    return trial.said(out);
  };
  const Diagnosis said = cut(Vector6d::Ones());
  const NamedCause window = named(said, CauseKind::window);
  EXPECT_THAT(said.cause, testing::HasSubstr("cut off"));
  EXPECT_LT(window.from_s.value(), window.to_s.value());
  const Diagnosis scaled = cut(1.01 * Vector6d::Unit(2) + (Vector6d::Ones() - Vector6d::Unit(2)));
  EXPECT_FALSE(scaled.named && scaled.named->kind == CauseKind::window) << scaled.cause;
}

/// A solver that takes the acceleration from the velocity of the last question.
TEST(StateCause, isNamedIfOneInstantAskedAgainIsAnsweredOtherwise) {
  const Trial trial{tumblingOf("/apps/starting/PUS.toml")};
  const std::vector<Motion<double>> motions = trial.motions();
  const auto said = [&](bool remembers) {
    Subject solver = nocSubject(*trial.scenario.manipulator, trial.scenario.load);
    const auto last = std::make_shared<Motion<double>>();
    const double step = motions[1].t - motions[0].t;
    solver.torques = [right = solver.torques, last, step, remembers](Motion<double> motion) -> Vector6d {
      const double dt = motion.t - last->t;
      const Vector3d difference = (motion.p_dot - last->p_dot) / dt;
      *last = motion;
      if (remembers ? dt > 0 && dt < 1.5 * step : motion.t > 0)
        motion.p_ddot = remembers ? difference : Vector3d::Zero();
      return right(motion);
    };
    Rows efforts;
    for (const Motion<double>& motion : motions) efforts.push_back(solver.torques(motion));
    ValidationResult result;
    addDiagnosis(trial.said(efforts, askedApart(solver, trial.scenario, motions)), result);
    return result;
  };
  const ValidationResult remembering = said(true), blind = said(false);
  ASSERT_TRUE(remembering.cause) << remembering.cause_words.cause;
  EXPECT_EQ(remembering.cause->kind, CauseKind::state) << remembering.cause_words.cause;
  EXPECT_FALSE(blind.cause_words.cause.empty());
  EXPECT_FALSE(blind.cause && blind.cause->kind == CauseKind::state) << blind.cause_words.cause;
}

TEST(JacobianCause, isNamedIfItsInverseIsDamped) {
  const Trial trial{tumblingOf("/apps/starting/UPS.toml")};
  const auto damped = [&](double by) {
    Rows out = trial.right();
    const std::vector<Motion<double>> motions = trial.motions();
    for (std::size_t k = 0; k < out.size(); ++k) {
      const Matrix6d W =
          machineTerms(*trial.scenario.manipulator, trial.scenario.load, motions[k]).T_P.transpose().inverse();
      const Matrix6d WtW = W.transpose() * W;
      out[k] = Matrix6d(WtW + by * Matrix6d::Identity()).lu().solve(Vector6d(WtW * out[k]));
    }
    return trial.said(out);
  };
  for (const double by : {1e-3, 0.03}) {
    const Diagnosis said = damped(by);
    named(said, CauseKind::jacobian);
    EXPECT_THAT(said.cause, testing::HasSubstr("damped"));
  }
  EXPECT_FALSE(damped(-1e-3).named) << "nothing is damped by less than nothing";
}

}  // namespace
}  // namespace ursula
