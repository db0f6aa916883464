// Mistakes of a solver's own formulas on machines of several kinds, each beside one that is no such mistake.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "model/instants.h"
#include "model/scenario.h"
#include "tests/support/motions.h"
#include "validation/causes/asked_apart.h"
#include "validation/causes/diagnosis.h"
#include "validation/causes/explanation.h"
#include "validation/mistakes/tried_causes.h"
#include "validation/subject/torque_file.h"

namespace ursula {
namespace {

using Machine = ManipulatorParameters;
using Rows = std::vector<Vector6d>;

Scenario tumblingOf(const std::string& path) {
  Scenario out = readScenario(std::string(URSULA_SOURCE) + path);
  out.trajectory = std::shared_ptr<const Trajectory>(tumbling(out, 3));
  return out;
}

std::vector<Motion<double>> motionsOf(const Scenario& scenario) {
  std::vector<Motion<double>> out;
  for (const double t : equallySpaced(scenario.trajectory->duration(), 41)) out.push_back(scenario.trajectory->at(t));
  return out;
}

Rows rightOf(const Scenario& scenario) {
  Rows out;
  const Subject noc = nocSubject(*scenario.manipulator, scenario.load);
  for (const Motion<double>& motion : motionsOf(scenario)) out.push_back(noc.torques(motion));
  return out;
}

Diagnosis saidOf(const Scenario& scenario, const Rows& efforts, const AskedApart& asked = {}) {
  const GivenTorques given{"solver", equallySpaced(scenario.trajectory->duration(), 41), efforts};
  return diagnose(scenario, runExternal(scenario, torqueFileOf(given, scenario.manipulator->motors())), asked);
}

Diagnosis saidOf(const Scenario& scenario, const std::function<void(Machine&)>& change) {
  Scenario other = scenario;
  Machine machine = scenario.manipulator->given();
  change(machine);
  other.manipulator = std::make_shared<Manipulator>(machine);
  return saidOf(scenario, rightOf(other));
}

/// The scenario's right efforts and a share of the mistake with these words.
Rows mistaken(const Scenario& scenario, const std::string& words, double share) {
  Rows out = rightOf(scenario);
  std::size_t found = 0;
  for (const auto& group : {addTermCauses, addJointCauses, addMachineCauses})
    for (const Cause& cause : causesOf(scenario, group)) {
      if (cause.words(0, 0) != words) continue;
      ++found;
      const Rows wrong = cause.torques(0, motionsOf(scenario));
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
  const auto& [kind, text, named, term, body] = GetParam();
  const Scenario scenario = tumblingOf(std::string("/apps/starting/") + kind + ".toml");
  const Diagnosis whole = saidOf(scenario, mistaken(scenario, text, 1));
  ASSERT_TRUE(whole.named) << whole.cause;
  EXPECT_EQ(whole.named->kind, named) << whole.cause;
  EXPECT_EQ(whole.named->term, term) << whole.cause;
  EXPECT_EQ(whole.named->body, body) << whole.cause;
  const Diagnosis half = saidOf(scenario, mistaken(scenario, text, 0.5));
  EXPECT_FALSE(half.summary.empty());
  EXPECT_FALSE(half.named && half.named->kind == named && half.named->term == term) << half.cause;
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, FormulaCause,
    testing::Values(
        Words{"URS", "angular velocity and acceleration of the distal links relative to the proximal ones",
              CauseKind::frame, "angular_velocity", "distal"},
        Words{
            "RUS",
            "angular velocity and acceleration of the distal links relative to the proximal ones, without the turning "
            "of the joints' axes",
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

void expectParameter(const Diagnosis& said, const std::string& path, int leg) {
  ASSERT_TRUE(said.named) << said.cause;
  EXPECT_EQ(said.named->kind, CauseKind::parameter) << said.cause;
  EXPECT_EQ(said.named->parameter, path) << said.cause;
  EXPECT_EQ(said.named->leg, leg) << said.cause;
}

TEST(MachineCause, ofOneLegIsNamed) {
  Scenario scenario = tumblingOf("/apps/starting/URS.toml");
  Machine heavier = scenario.manipulator->given();
  for (Leg& leg : heavier.legs) leg.proximal.mass = 14, leg.proximal.inertia *= 2;
  scenario.manipulator = std::make_shared<Manipulator>(heavier);
  const auto exchange = [](Leg& leg) {
    std::swap(leg.proximal.mass, leg.distal.mass);
    std::swap(leg.proximal.center_of_mass, leg.distal.center_of_mass);
    std::swap(leg.proximal.inertia, leg.distal.inertia);
  };
  ASSERT_NE(scenario.manipulator->leg(1).proximal.mass, scenario.manipulator->leg(1).distal.mass);
  expectParameter(saidOf(scenario, [&](Machine& machine) { exchange(machine.legs[1]); }), "manipulator.leg.2", 2);
  EXPECT_FALSE(saidOf(scenario, [&](Machine& machine) {
                 exchange(machine.legs[1]);
                 exchange(machine.legs[4]);
               }).named);
  const Diagnosis sign = saidOf(scenario, [](Machine& machine) { machine.legs[3].base_axis.z() *= -1; });
  expectParameter(sign, "manipulator.leg.4.base_axis.2", 4);
  EXPECT_EQ(sign.named->found.value(), -sign.named->expected.value());
  EXPECT_FALSE(saidOf(scenario, [](Machine& machine) {
                 for (const std::size_t i : {1, 3}) machine.legs[i].base_axis.z() *= -1;
               }).named);
}

TEST(MachineCause, ofAllLegsIsNamed) {
  const Scenario hexapod = tumblingOf("/apps/starting/UPS.toml");
  expectParameter(saidOf(hexapod,
                         [](Machine& machine) {
                           for (Leg& leg : machine.legs) leg.base_axis = Vector3d::UnitX();
                         }),
                  "manipulator.leg_defaults.base_axis", 0);
  EXPECT_FALSE(saidOf(hexapod, [](Machine& machine) {
                 for (Leg& leg : machine.legs) leg.base_axis = {1, 0.3, 0.2};
               }).named);
  const auto round = [](double about_line) {
    return [about_line](Machine& machine) {
      for (Leg& leg : machine.legs) leg.proximal.inertia(2, 2) = leg.distal.inertia(2, 2) = about_line;
    };
  };
  Scenario free = hexapod;
  Machine machine = hexapod.manipulator->given();
  round(0.3)(machine);
  for (Leg& leg : machine.legs) leg.spins = true;
  free.manipulator = std::make_shared<Manipulator>(machine);
  const auto held = [&](double about_line) {
    return saidOf(free, [&](Machine& changed) {
      round(about_line)(changed);
      for (Leg& leg : changed.legs) leg.spins = false;
    });
  };
  const Diagnosis said = held(0.3);
  ASSERT_TRUE(said.named) << said.cause;
  EXPECT_EQ(said.named->kind, CauseKind::missing_term) << said.cause;
  EXPECT_EQ(said.named->term, "spin") << said.cause;
  const Diagnosis other = held(0.2);
  EXPECT_FALSE(other.named && other.named->term == "spin") << other.cause;
}

TEST(MachineCause, massCentresPutOnTheLineAreNamed) {
  Scenario scenario = tumblingOf("/apps/starting/UPS.toml");
  Machine machine = scenario.manipulator->given();
  for (Leg& leg : machine.legs) leg.proximal.off_line = {0.06, -0.03, 0};
  scenario.manipulator = std::make_shared<Manipulator>(machine);
  const auto said = [&](double share) {
    return saidOf(scenario, [share](Machine& changed) {
      for (Leg& leg : changed.legs) leg.proximal.off_line *= share;
    });
  };
  const Diagnosis on_line = said(0);
  ASSERT_TRUE(on_line.named) << on_line.cause;
  EXPECT_EQ(on_line.named->kind, CauseKind::reference_point) << on_line.cause;
  EXPECT_EQ(on_line.named->body, "proximal") << on_line.cause;
  const Diagnosis nearer = said(0.4);
  EXPECT_FALSE(nearer.named && nearer.named->kind == CauseKind::reference_point) << nearer.cause;
}

/// The inertia of one kind's links about their first joints: Cause::legs are those of the kind.
TEST(MixedCause, ofOneKindHasItsLegs) {
  const Scenario scenario = tumblingOf("/scenarios/mixture.toml");
  const auto aboutJoint = [](Leg& leg) {
    for (Link* link : {&leg.proximal, &leg.distal})
      for (int k : {0, 1}) link->inertia(k, k) += link->mass * link->center_of_mass * link->center_of_mass;
  };
  std::vector<int> legs;
  const Diagnosis said = saidOf(scenario, [&](Machine& machine) {
    for (std::size_t i = 0; i < machine.legs.size(); ++i) {
      if (machine.legs[i].kind != LegKind::URS) continue;
      aboutJoint(machine.legs[i]);
      legs.push_back(static_cast<int>(i) + 1);
    }
  });
  ASSERT_EQ(legs.size(), 2u);
  ASSERT_TRUE(said.named) << said.cause;
  EXPECT_EQ(said.named->kind, CauseKind::reference_point) << said.cause;
  EXPECT_EQ(said.named->legs, legs) << said.cause;
  const Diagnosis other = saidOf(scenario, [&](Machine& machine) {
    for (const std::size_t i : {0, 1}) aboutJoint(machine.legs[i]);
  });
  EXPECT_FALSE(other.named) << other.cause;
}

/// Moments in N·mm beside forces in N, in a machine of both.
TEST(ColumnCause, unitsOfMomentsAloneAreNamedWithTheirMotors) {
  const Scenario scenario = tumblingOf("/scenarios/mixture.toml");
  std::vector<int> turning;
  for (int k = 0; k < motor_count; ++k)
    if (!scenario.manipulator->motors()[static_cast<std::size_t>(k)].slides()) turning.push_back(k + 1);
  ASSERT_GT(turning.size(), 1u);
  ASSERT_LT(turning.size(), 6u);
  const auto times = [&](double factor, double of_first) {
    Rows out = rightOf(scenario);
    for (Vector6d& row : out) {
      for (const int motor : turning) row(motor - 1) *= factor;
      row(turning.front() - 1) *= of_first;
    }
    return saidOf(scenario, out);
  };
  const Diagnosis units = times(1000, 1);
  ASSERT_TRUE(units.named) << units.cause;
  EXPECT_EQ(units.named->kind, CauseKind::units) << units.cause;
  EXPECT_EQ(units.named->legs, turning) << units.cause;
  EXPECT_NEAR(units.named->found.value(), 1000, 1e-6);
  const Diagnosis uneven = times(1000, 1.1);
  EXPECT_FALSE(uneven.named && uneven.named->kind == CauseKind::units) << uneven.cause;
  Rows flipped = rightOf(scenario);
  for (Vector6d& row : flipped) row(1) *= -1, row(4) *= -1;
  const Diagnosis sign = saidOf(scenario, flipped);
  ASSERT_TRUE(sign.named) << sign.cause;
  EXPECT_THAT(sign.named->legs, testing::ElementsAre(2, 5)) << sign.cause;
}

TEST(WindowCause, effortsCutOffAreNamed) {
  const Scenario scenario = tumblingOf("/apps/starting/PUS.toml");
  const auto cut = [&](const Vector6d& factor) {
    constexpr std::size_t entries = 12;
    Rows out = rightOf(scenario);
    std::vector<double> sizes;
    for (const Vector6d& row : out)
      for (int i = 0; i < motor_count; ++i) sizes.push_back(std::abs(row(i)));
    std::sort(sizes.rbegin(), sizes.rend());
    const double limit = sizes[entries];
    for (Vector6d& row : out) row = row.cwiseProduct(factor).cwiseMin(limit).cwiseMax(-limit);
    return saidOf(scenario, out);
  };
  const Diagnosis named = cut(Vector6d::Ones());
  ASSERT_TRUE(named.named) << named.cause;
  EXPECT_EQ(named.named->kind, CauseKind::window) << named.cause;
  EXPECT_THAT(named.cause, testing::HasSubstr("cut off"));
  EXPECT_LT(named.named->from_s.value(), named.named->to_s.value());
  const Diagnosis scaled = cut(1.01 * Vector6d::Unit(2) + (Vector6d::Ones() - Vector6d::Unit(2)));
  EXPECT_FALSE(scaled.named && scaled.named->kind == CauseKind::window) << scaled.cause;
}

/// A solver that takes the acceleration from the velocity of the last question.
TEST(StateCause, isNamedIfOneInstantAskedAgainIsAnsweredOtherwise) {
  const Scenario scenario = tumblingOf("/apps/starting/PUS.toml");
  const std::vector<Motion<double>> motions = motionsOf(scenario);
  const auto said = [&](bool remembers) {
    Subject solver = nocSubject(*scenario.manipulator, scenario.load);
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
    addDiagnosis(saidOf(scenario, efforts, askedApart(solver, scenario, motions)), result);
    return result;
  };
  const ValidationResult remembering = said(true), blind = said(false);
  ASSERT_TRUE(remembering.cause) << remembering.cause_words.cause;
  EXPECT_EQ(remembering.cause->kind, CauseKind::state) << remembering.cause_words.cause;
  EXPECT_FALSE(blind.cause_words.cause.empty());
  EXPECT_FALSE(blind.cause && blind.cause->kind == CauseKind::state) << blind.cause_words.cause;
}

TEST(JacobianCause, isNamedIfItsInverseIsDamped) {
  const Scenario scenario = tumblingOf("/apps/starting/UPS.toml");
  const auto damped = [&](double by) {
    Rows out = rightOf(scenario);
    const std::vector<Motion<double>> motions = motionsOf(scenario);
    for (std::size_t k = 0; k < out.size(); ++k) {
      const Matrix6d W = machineTerms(*scenario.manipulator, scenario.load, motions[k]).T_P.transpose().inverse();
      const Matrix6d WtW = W.transpose() * W;
      out[k] = Matrix6d(WtW + by * Matrix6d::Identity()).lu().solve(Vector6d(WtW * out[k]));
    }
    return saidOf(scenario, out);
  };
  for (const double by : {1e-3, 0.03}) {
    const Diagnosis said = damped(by);
    ASSERT_TRUE(said.named) << said.cause;
    EXPECT_EQ(said.named->kind, CauseKind::jacobian) << said.cause;
    EXPECT_THAT(said.cause, testing::HasSubstr("damped"));
  }
  EXPECT_FALSE(damped(-1e-3).named) << "nothing is damped by less than nothing";
}

Hypothesis hypothesisOf(const NamedCause& cause, const char* text) {
  Hypothesis out{text, 0, 0};
  out.named = cause;
  return out;
}

TEST(Explanation, saysNothingTwiceAndPrefersWhatIsLikelierAndNarrower) {
  TorqueResidual data;
  data.motions = motionsOf(tumblingOf("/apps/starting/PUS.toml"));
  data.commanded = data.motions.size();
  const NamedCause missing{CauseKind::missing_term, "gravity", "proximal"},
      frame{CauseKind::frame, "gravity", "proximal"};
  const NamedCause other{CauseKind::frame, "gravity", "distal"};
  const Explanation weight = named(
      {hypothesisOf(missing, ""), hypothesisOf(frame, "own axes"), hypothesisOf(frame, "the wrong way")}, data, "");
  ASSERT_TRUE(weight.named);
  EXPECT_EQ(weight.named->kind, CauseKind::missing_term);
  EXPECT_EQ(weight.others.size(), 1u);
  EXPECT_FALSE(named({hypothesisOf(missing, ""), hypothesisOf(other, "")}, data, "").named) << "another body's";
  std::vector<Hypothesis> best = {hypothesisOf({CauseKind::reference_point, "", "legs"}, "all links"),
                                  hypothesisOf({CauseKind::reference_point, "", "distal"}, "the distal links")};
  putNarrowerFirst(best);
  EXPECT_EQ(best.front().text, "the distal links");
  best = {hypothesisOf({CauseKind::reference_point, "", "legs"}, "all links"),
          hypothesisOf({CauseKind::reference_point, "inertia", "distal"}, "another mistake")};
  putNarrowerFirst(best);
  EXPECT_EQ(best.front().text, "all links");
}

}  // namespace
}  // namespace ursula
