#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/validation/loop_machine.h"

namespace ursula {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::HasSubstr;

const char* const machine_names[] = {"fourbar", "planar3rrr", "ankle", "delta"};

template <class Of>
std::vector<MotorEfforts> fromTree(const Machine& machine, const OpenMachine& open, bool with_bias, const Of& of) {
  std::vector<MotorEfforts> out;
  for (const double t : machine.instants()) {
    MatrixXd N;
    const VectorXd forces = open.forces(t, with_bias, N);
    out.push_back(of(forces, N));
  }
  return out;
}

std::size_t lastBody(const Mechanism& mechanism) {
  std::size_t out = 0;
  for (std::size_t b = 0; b < mechanism.bodies().size(); ++b)
    if (!mechanism.bodies()[b].fixed && mechanism.bodies()[b].mass > 0) out = b;
  return out;
}

class MechanismCause : public testing::TestWithParam<const char*> {
 protected:
  MechanismCause() : machine(GetParam()) {}
  const Machine machine;
};

/// A body's mass and what is done to the efforts afterwards; the mass alone is one mistake.
TEST_P(MechanismCause, NamesTwoMistakesTogether) {
  MechanismParameters heavier = machine.parameters();
  const std::size_t body = lastBody(machine.mechanism());
  heavier.bodies[body].mass *= 1.03;
  std::vector<MotorEfforts> efforts = machine.efforts(heavier);
  EXPECT_TRUE(machine.judge(efforts).causes_together.empty());
  for (MotorEfforts& each : efforts) each(0) += 0.1;
  const ValidationResult result = machine.judge(efforts);
  ASSERT_EQ(result.causes_together.size(), 2U) << result.cause_words.cause;
  const bool mass_first = result.causes_together[0].kind == CauseKind::parameter;
  const NamedCause &mass = result.causes_together[mass_first ? 0 : 1],
                   &offset = result.causes_together[mass_first ? 1 : 0];
  EXPECT_EQ(mass.parameter, "body." + heavier.bodies[body].name + ".mass") << result.cause_words.cause;
  EXPECT_NEAR(mass.found.value_or(0), heavier.bodies[body].mass, 1e-8);
  EXPECT_EQ(offset.kind, CauseKind::offset);
  EXPECT_NEAR(offset.found.value_or(0), 0.1, 1e-8);
  EXPECT_EQ(result.cause.value().kind, result.causes_together[0].kind);
  EXPECT_GE(result.causes_together[0].explained, result.causes_together[1].explained);
  EXPECT_THAT(result.cause_words.cause, HasSubstr("two mistakes together: "));
}

TEST_P(MechanismCause, NamesFactorSignAndOffset) {
  const NamedCause scaled = named(judgeEfforts(machine, [](std::size_t, auto& tau) { tau *= 1.01; }), CauseKind::scale);
  EXPECT_NEAR(scaled.found.value_or(0), 1.01, 1e-9);
  named(judgeEfforts(machine, [](std::size_t, auto& tau) { tau *= 1000; }), CauseKind::units);
  named(judgeEfforts(machine, [](std::size_t, auto& tau) { tau(0) *= -1; }), CauseKind::sign);
  const NamedCause shifted =
      named(judgeEfforts(machine, [](std::size_t, auto& tau) { tau(0) += 0.1; }), CauseKind::offset);
  EXPECT_NEAR(shifted.found.value_or(0), 0.1, 1e-9);
}

TEST_P(MechanismCause, NamesOrderDelayDigitsAndWindow) {
  if (machine.mechanism().motorCount() > 1) {
    const NamedCause swapped =
        named(judgeEfforts(machine, [](std::size_t, auto& tau) { std::swap(tau(0), tau(1)); }), CauseKind::order);
    EXPECT_TRUE(swapped.signs.empty());
    const ValidationResult turned = judgeEfforts(machine, [](std::size_t, auto& tau) {
      std::swap(tau(0), tau(1));
      tau(1) = -tau(1);
    });
    ASSERT_TRUE(turned.cause) << turned.cause_words.cause;
    ASSERT_EQ(turned.cause->signs.size(), machine.mechanism().motorCount());
    EXPECT_EQ(turned.cause->signs[0], 1);
    EXPECT_EQ(turned.cause->signs[1], -1);
    EXPECT_THAT(turned.cause_words.cause, HasSubstr("column 2 has the wrong sign"));
  }
  const NamedCause late = named(machine.judge(machine.efforts(machine.parameters(), 0.004)), CauseKind::delay);
  EXPECT_NEAR(late.found.value_or(0), 0.004, 1e-8);
  named(judgeEfforts(machine,
                     [](std::size_t, auto& tau) { tau = tau.template cast<float>().template cast<double>().eval(); }),
        CauseKind::digits);
  named(judgeEfforts(machine,
                     [](std::size_t i, auto& tau) {
                       if (i > 20 && i < 30) tau(0) += 0.1 * static_cast<double>(i % 4 + 1);
                     }),
        CauseKind::window);
}

TEST_P(MechanismCause, NamesNumbersOfTheMachine) {
  const std::size_t body = lastBody(machine.mechanism());
  const std::string name = machine.mechanism().bodies()[body].name;
  const ValidationResult heavy = judgeChanged(machine, [&](auto& p) { p.bodies[body].mass *= 1.1; });
  ASSERT_TRUE(heavy.cause) << heavy.cause_words.cause;
  EXPECT_EQ(heavy.cause->parameter, "body." + name + ".mass");
  EXPECT_EQ(heavy.cause->body, name);
  EXPECT_NEAR(heavy.cause->found.value_or(0), 1.1 * machine.mechanism().bodies()[body].mass, 1e-9);
  EXPECT_THAT(heavy.cause_words.cause, HasSubstr("the mass of '" + name + "' is "));
  const ValidationResult weak = judgeChanged(machine, [](auto& p) { p.gravity *= 0.999; });
  ASSERT_TRUE(weak.cause) << weak.cause_words.cause;
  EXPECT_EQ(weak.cause->term, "gravity");
  const std::size_t motor = machine.mechanism().motors().front();
  const ValidationResult damped = judgeChanged(machine, [&](auto& p) { p.joints[motor].damping += 0.05; });
  ASSERT_TRUE(damped.cause) << damped.cause_words.cause;
  EXPECT_EQ(damped.cause->joint, machine.mechanism().motor(0).name);
}

TEST_P(MechanismCause, NamesMissingTerms) {
  named(judgeChanged(machine, [](auto& p) { p.gravity.setZero(); }), CauseKind::missing_term, "gravity");
  const std::size_t body = lastBody(machine.mechanism());
  const NamedCause without = named(judgeChanged(machine,
                                                [&](auto& p) {
                                                  p.bodies[body].mass = 0;
                                                  p.bodies[body].inertia.setZero();
                                                }),
                                   CauseKind::missing_term, "inertia");
  EXPECT_EQ(without.body, machine.mechanism().bodies()[body].name);
}

/// The right efforts, and for each body what `of` puts in place of its moment, from the tensor of the file's pose.
template <class Of>
std::vector<MotorEfforts> withMoments(const Machine& machine, const Of& of) {
  const LoopSolver solver(machine.mechanism());
  const LoopMotion motion(solver, *machine.scenario().trajectory);
  std::vector<MotorEfforts> out;
  LoopWork work;
  for (const double t : machine.instants()) {
    out.push_back(motion.inverseDynamics(t, work));
    for (std::size_t b = 0; b < work.bodies.size(); ++b) {
      const Matrix3d R = work.bodies[b].displacement.linear(), I_0 = machine.mechanism().bodies()[b].inertia;
      const Vector3d omega = work.bodies[b].twist.head<3>(), alpha = work.bodies[b].twist_rate.head<3>();
      const Matrix3d I = R * I_0 * R.transpose();
      const Vector3d right = I * alpha + omega.cross(I * omega);
      out.back() += work.T[b].topRows<3>().transpose() * (of(I_0, I, omega, alpha) - right);
    }
  }
  return out;
}

TEST_P(MechanismCause, NamesFrameAndGyroscopicMoment) {
  if (std::string(GetParam()) != "ankle") return;  // the ankle's bodies turn about several axes
  named(machine.judge(withMoments(
            machine, [](const Matrix3d& I_0, const Matrix3d&, const Vector3d& omega,
                        const Vector3d& alpha) { return Vector3d(I_0 * alpha + omega.cross(I_0 * omega)); })),
        CauseKind::frame, "orientation");
  named(machine.judge(withMoments(machine, [](const Matrix3d&, const Matrix3d& I, const Vector3d&,
                                              const Vector3d& alpha) { return Vector3d(I * alpha); })),
        CauseKind::missing_term, "gyroscopic");
}

TEST_P(MechanismCause, NamesFrictionOfPassiveJoints) {
  const auto& joints = machine.mechanism().joints();
  const auto& motors = machine.mechanism().motors();
  const auto isPassive = [&](std::size_t j) { return std::find(motors.begin(), motors.end(), j) == motors.end(); };
  bool any = false;
  for (std::size_t j = 0; j < joints.size(); ++j)
    any = any || (isPassive(j) && (joints[j].damping != 0 || joints[j].friction != 0));
  if (!any) return;  // nothing rubs at its passive joints
  named(judgeChanged(machine,
                     [&](auto& p) {
                       for (std::size_t j = 0; j < joints.size(); ++j)
                         if (isPassive(j)) p.joints[j].damping = p.joints[j].friction = 0;
                     }),
        CauseKind::missing_term, "friction");
}

/// One of them, or two, would be a wrong name.
TEST_P(MechanismCause, NamesThreeMistakesTogetherOrNone) {
  const std::size_t body = lastBody(machine.mechanism());
  const ValidationResult result = judgeChanged(machine, [&](auto& p) {
    p.bodies[body].mass *= 1.1;
    p.joints[machine.mechanism().motors().front()].damping += 0.1;
    p.gravity *= 1.01;
  });
  EXPECT_EQ(result.cause.has_value(), !result.causes_together.empty()) << result.cause_words.cause;
  if (result.cause) {
    EXPECT_EQ(result.causes_together.size(), 3U) << result.cause_words.cause;
  }
}

TEST_P(MechanismCause, NamesNoneOfRandomErrors) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 0.05);
  const ValidationResult result = judgeEfforts(machine, [&](std::size_t, auto& tau) {
    for (Eigen::Index k = 0; k < tau.size(); ++k) tau(k) += noise(random);
  });
  EXPECT_EQ(result.verdict, Verdict::fail);
  EXPECT_FALSE(result.cause) << result.cause_words.cause;
}

TEST_P(MechanismCause, NamesOpenLoopsAndClosuresBias) {
  const OpenMachine open(machine);
  if (!open.isPossible()) return;  // its tree has other joints than hinges
  const Eigen::Index n = machine.efforts().front().size();
  const auto expect = [&](const std::vector<MotorEfforts>& efforts, const char* term) {
    named(machine.judge(efforts), CauseKind::closure, term);
  };
  expect(fromTree(machine, open, true, [&](const auto& forces, const auto&) { return forces.head(n).eval(); }), "open");
  expect(
      fromTree(machine, open, false, [](const auto& forces, const auto& N) { return (N.transpose() * forces).eval(); }),
      "bias");
  expect(fromTree(machine, open, true,
                  [&](const auto& forces, const auto& N) {
                    return (N * (N.transpose() * N).inverse() * N.transpose() * forces).head(n).eval();
                  }),
         "least_squares");
}

INSTANTIATE_TEST_SUITE_P(Loops, MechanismCause, testing::ValuesIn(machine_names),
                         [](const auto& of) { return std::string(of.param); });

}  // namespace
}  // namespace ursula
