// What is said of torques that are wrong: each fault is put into exact ones of the helix, and must be named in words
// and by the contract's terms.

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <tuple>

#include "parts/wrong_formulas/wrong_noc.h"
#include "tests/support/matchers.h"
#include "tests/support/motions.h"
#include "tests/validation/external_torques.h"
#include "tests/validation/scenario_files.h"
#include "tests/validation/wrong_solvers.h"

namespace ursula {
namespace {

Rows ofMachine(const MachineChange& change) { return onHelix().answers(onHelix().solver(change)); }

Rows ofMotion(const std::function<void(Motion<double>&)>& change) {
  return onHelix().answers([&](Motion<double> motion) {
    change(motion);
    return onHelix().solver()(motion);
  });
}

Rows ofFormula(FormulaError error) {
  return onHelix().answers(wrongNocSubject(*onHelix().scenario.manipulator, nullptr, WithFormulaErrors(error)).torques);
}

Rows ofColumns(const std::function<void(Vector6d&)>& change) {
  return onHelix().rightBut([&](std::size_t, Vector6d& tau) { change(tau); });
}

Rows shifted(double by) {
  return ofMotion(
      [by](auto& motion) { motion = onHelix().scenario.trajectory->at(std::min(std::max(motion.t + by, 0.0), 3.0)); });
}

TEST(Diagnosis, saysNothingOfExactTorques) {
  const Diagnosis diagnosis = onHelix().said(onHelix().right());
  EXPECT_EQ(diagnosis.summary, "");
  EXPECT_EQ(diagnosis.deviation, "");
  EXPECT_EQ(diagnosis.cause, "");
}

TEST(Diagnosis, saysWhichLegsWhenAndHowMuch) {
  const Diagnosis diagnosis = onHelix().said(onHelix().rightBut([](std::size_t k, Vector6d& tau) {
    if (k >= 20 && k <= 40) tau(1) += k == 30 ? 50 : 5;
  }));
  EXPECT_THAT(
      diagnosis.summary,
      StartsWith("leg 2 by up to 50 N m (0.199 % of the largest torque), from t = 1 to 2 s, 21 of 61 instants"));
  EXPECT_THAT(diagnosis.deviation, HasSubstr("leg 2 by up to 50 N m (0.199 % of the largest torque) at t = 1.5 s"));
  EXPECT_THAT(diagnosis.deviation, HasSubstr("within their limits: 1, 3, 4, 5, 6; off in 21 of 61 samples, 34.4 %"));
}

/// Motors that are off at different instants are off at all of these together.
TEST(Diagnosis, countsTheInstantsOfAllMotors) {
  const Diagnosis diagnosis = onHelix().said(onHelix().rightBut([](std::size_t k, Vector6d& tau) {
    if (k >= 10 && k < 20) tau(0) += 50;
    if (k >= 30 && k < 45) tau(3) += 50;
  }));
  EXPECT_THAT(diagnosis.summary, HasSubstr("25 of 61 instants"));
  EXPECT_THAT(diagnosis.deviation, HasSubstr("off in 25 of 61 samples"));
}

struct SaidFault {
  std::string words;
  Rows torques;
  std::optional<CauseKind> kind;
  std::string term, body;
};

std::vector<SaidFault> faults() {
  const auto gravity = [](double by) { return ofMachine([by](auto& machine) { machine.gravity *= by; }); };
  return {
      {"gravity left out, which explains more than 99.9999 %", gravity(0), CauseKind::missing_term, "gravity", "all"},
      {"gravity with the wrong sign", gravity(-1), CauseKind::sign, "gravity", "all"},
      {"gravity scaled by 1.001,", gravity(1.001), CauseKind::parameter, "gravity", "all"},
      {"gravity scaled by 1 - 0.0003415 (9.80665 m/s^2, standard gravity), which", gravity(9.80665 / 9.81),
       CauseKind::parameter, "gravity", "all"},
      {"", ofFormula(FormulaError::drop_gravity_platform), CauseKind::missing_term, "gravity", "platform"},
      {"", ofFormula(FormulaError::drop_coriolis), CauseKind::missing_term, "coriolis", "legs"},
      {"(43b) as printed, its last terms doubled", ofFormula(FormulaError::eq43b_doubled), {}, "", ""},
      {"", ofMotion([](auto& motion) { motion.Q.transposeInPlace(); }), CauseKind::frame, "orientation", "all"},
      {"", ofMotion([](auto& motion) { motion.omega_dot.setZero(); }), CauseKind::missing_term, "angular_acceleration",
       "all"},
      {"the torques of acceleration (inertia) left out",
       ofMotion([](auto& motion) { motion.omega_dot.setZero(), motion.p_ddot.setZero(); }),
       {},
       "",
       ""},
      {"", ofMachine([](auto& machine) { machine.platform.center_of_mass *= -1; }), CauseKind::reference_point, "",
       "platform"},
      {"platform mass 510 +- ", ofMachine([](auto& machine) { machine.platform.mass *= 1.02; }), CauseKind::parameter,
       "", "platform"},
      {"platform inertia tensor scaled by 0.9 +- ", ofMachine([](auto& machine) { machine.platform.inertia *= 0.9; }),
       CauseKind::scale, "inertia", "platform"},
      {"legs 2 and 5 swapped, which explains more than 99.9999 %",
       ofColumns([](auto& tau) { std::swap(tau(1), tau(4)); }), CauseKind::order, "", ""},
      {"the sign of leg 3 flipped, which explains", ofColumns([](auto& tau) { tau(2) *= -1; }), CauseKind::sign, "",
       ""},
      {"the sign of every leg flipped", ofColumns([](auto& tau) { tau *= -1; }), CauseKind::sign, "", "all"},
      {"a constant offset: +5 N m on leg 4, which explains", ofColumns([](auto& tau) { tau(3) += 5; }),
       CauseKind::offset, "", ""},
      {"every torque scaled by 0.001 (kN m for N m)", ofColumns([](auto& tau) { tau *= 1e-3; }), CauseKind::units, "",
       "all"},
      {"a factor of 1.02 on leg 4", ofColumns([](auto& tau) { tau(3) *= 1.02; }), CauseKind::scale, "", ""},
      {"every torque scaled by 1 + 1e-08", ofColumns([](auto& tau) { tau *= 1 + 1e-8; }), CauseKind::scale, "", "all"},
      {"a factor of 1 - 1e-10 on leg 3, which", ofColumns([](auto& tau) { tau(2) *= 1 - 1e-10; }), CauseKind::scale, "",
       ""},
      {"a time shift: the torques of 10 ms before (late)", shifted(-0.01), {}, "", ""},
      {"a time shift: the torques of 10 ms after (early)", shifted(0.01), {}, "", ""},
      {"a time shift: the torques of 200 ms after", shifted(0.2), {}, "", ""},
      {"single precision",
       ofColumns([](auto& tau) { tau = tau.template cast<float>().template cast<double>().eval(); }),
       {},
       "",
       ""},
  };
}

TEST(Diagnosis, namesEachFault) {
  for (const SaidFault& fault : faults()) {
    const Diagnosis said = onHelix().said(fault.torques);
    EXPECT_THAT(said.cause, StartsWith(fault.words));
    if (!fault.kind) continue;
    const NamedCause found = named(said, *fault.kind);
    EXPECT_EQ(found.term, fault.term) << said.cause;
    EXPECT_EQ(found.body, fault.body) << said.cause;
  }
}

TEST(Diagnosis, namesFriction) {
  const Trial rough{changed(onHelix().scenario, ofEachLeg([](Leg& leg) { leg.friction = {30, 20, 10}; })), 61};
  EXPECT_THAT(rough.said(onHelix().right()).cause, StartsWith("friction left out"));
}

TEST(Diagnosis, givesAParameterAsManyDigitsAsTheFileHas) {
  const Rows heavier = ofMachine([](auto& machine) { machine.platform.mass = 499.31; });
  const TorqueFile file = TorqueTable{onHelix().t(), heavier}.printed("{:.1f}");
  const std::string cause = diagnose(onHelix().scenario, runExternal(onHelix().scenario, file)).cause;
  EXPECT_THAT(cause, AllOf(HasSubstr("platform mass 499.3"), HasSubstr(" kg instead of 500")));
}

/// Two causes: the larger one is a part, and the rest is far beyond the file's precision.
TEST(Diagnosis, namesAPartAsAPart) {
  Rows torques = ofMachine([](auto& machine) { machine.platform.mass *= 1.05; });
  SeededDraws dice(3);
  for (Vector6d& tau : torques) tau(1) += dice.between(-1, 1);
  EXPECT_THAT(onHelix().said(torques).cause, AllOf(StartsWith("a likely part: platform mass 52"),
                                                   HasSubstr("times the limit of rounding and digits")));
}

/// The same mistake in other words is no alternative, and a telescopic leg has none of the paper's equations.
TEST(Diagnosis, namesAMistakeOnceAndWithoutEquations) {
  const Trial telescopic{scenarioOf("flight-simulator"), 61};
  for (const auto& [error, words, again] :
       {std::tuple(FormulaError::drop_gyroscopic_platform, "the gyroscopic moment of the platform left out",
                   "the platform's gyroscopic moment"),
        std::tuple(FormulaError::drop_gyroscopic_legs, "the gyroscopic moment of the links left out",
                   "the links' gyroscopic moments")}) {
    const Subject wrong =
        wrongNocSubject(*telescopic.scenario.manipulator, telescopic.scenario.load, WithFormulaErrors(error));
    const std::string cause = telescopic.said(telescopic.answers(wrong.torques)).cause;
    EXPECT_THAT(cause, StartsWith(words));
    EXPECT_THAT(cause, AllOf(Not(HasSubstr(again)), Not(HasSubstr("(38)"))));
  }
}

TEST(Diagnosis, claimsNothingThatTheResidualDoesNotSupport) {
  SeededDraws dice(5);
  const Diagnosis noisy = onHelix().said(ofColumns([&](auto& tau) {
    for (int i = 0; i < leg_count; ++i) tau(i) += dice.between(-1, 1);
  }));
  EXPECT_THAT(noisy.cause, StartsWith("no pattern from one instant to the next"));
  EXPECT_FALSE(noisy.named);
  const Diagnosis mixed = onHelix().said(onHelix().rightBut([](std::size_t k, Vector6d& tau) {
    tau *= 1.05;
    tau(0) += 40 * std::sin(0.1 * static_cast<double>(k));
  }));
  EXPECT_THAT(mixed.cause, AllOf(StartsWith("no simple explanation"), HasSubstr("explains only")));
}

/// A third of the motion, in which a factor explains all; of a pattern there is none, only the interval is named.
TEST(Diagnosis, namesAnIntervalAndWhatIsWrongInIt) {
  const auto within = [](const std::function<void(Vector6d&)>& change) {
    return onHelix().said(onHelix().rightBut([&](std::size_t k, Vector6d& tau) {
      if (k >= 20 && k <= 40) change(tau);
    }));
  };
  const Diagnosis scaled = within([](Vector6d& tau) { tau *= 1.001; });
  EXPECT_THAT(scaled.cause, StartsWith("right but from t = 1 to 2 s; there every torque scaled by 1.001"));
  const NamedCause window = named(scaled, CauseKind::window);
  EXPECT_NEAR(window.from_s.value(), 1, 1e-12);
  EXPECT_NEAR(window.to_s.value(), 2, 1e-12);
  SeededDraws dice(6);
  const Diagnosis noisy = within([&](Vector6d& tau) {
    for (int i = 0; i < leg_count; ++i) tau(i) += dice.between(1, 2);
  });
  EXPECT_EQ(noisy.cause, "right but from t = 1 to 2 s");
}

/// Six numbers of one pose can be made by much.
TEST(Diagnosis, ofOneInstantFitsNothingWithAsManyNumbers) {
  const auto said = [](const Vector6d& torques) {
    const GivenTorques given{"solver", {1.5}, {torques}};
    return diagnose(onHelix().scenario,
                    runExternal(onHelix().scenario, torqueFileOf(given, onHelix().scenario.manipulator->motors())));
  };
  const Motion<double> at = onHelix().scenario.trajectory->at(1.5);
  EXPECT_THAT(said(onHelix().solver()(at) + (Vector6d() << 1, -2, 3, -1, 2, 1).finished()).cause,
              Not(HasSubstr("offset")));
  const Diagnosis heavier = said(onHelix().solver([](auto& machine) { machine.platform.mass *= 1.01; })(at));
  EXPECT_FALSE(heavier.cause.empty());
  EXPECT_FALSE(heavier.named);
}

}  // namespace
}  // namespace ursula
