// What is said of torques that are wrong: each fault is put into exact ones of the helix and must be named.

#include "validation/causes/diagnosis.h"
#include "model/instants.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <tuple>

#include "tests/support/motions.h"
#include "tests/validation/external_torques.h"
#include "tests/validation/scenario_files.h"

namespace ursula {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr int instants = 61;

const TorqueTable& exact() {
  static const TorqueTable torques = exactTorques(helix(), instants);
  return torques;
}

Diagnosis diagnosed(const TorqueTable& torques, const Scenario& scenario = helix()) {
  return diagnose(scenario, runExternal(scenario, torques.file()));
}

/// Torques of a machine that differs.
TorqueTable ofAnother(const std::function<void(ManipulatorParameters&)>& change, const Scenario& scenario = helix()) {
  ManipulatorParameters parameters = scenario.manipulator->parameters();
  change(parameters);
  return torquesOf(scenario, nocSubject(Manipulator(parameters), scenario.load),
                   equallySpaced(scenario.trajectory->duration(), instants));
}

TEST(Diagnosis, saysNothingOfExactTorques) {
  const Diagnosis diagnosis = diagnosed(exact());
  EXPECT_EQ(diagnosis.summary, "");
  EXPECT_EQ(diagnosis.deviation, "");
  EXPECT_EQ(diagnosis.cause, "");
}

TEST(Diagnosis, saysWhichLegsWhenAndHowMuch) {
  const Diagnosis diagnosis = diagnosed(exact().changed([](std::size_t k, Vector6d& tau) {
    if (k >= 20 && k <= 40) tau(1) += k == 30 ? 50 : 5;
  }));
  EXPECT_THAT(diagnosis.summary, StartsWith("leg 2 by up to 50 N m (0.199 % of the largest torque), from t = 1 to 2 s, "
                                            "21 of 61 instants"));
  EXPECT_THAT(diagnosis.deviation, HasSubstr("leg 2 by up to 50 N m (0.199 % of the largest torque) at t = 1.5 s"));
  EXPECT_THAT(diagnosis.deviation, HasSubstr("within their limits: 1, 3, 4, 5, 6; off in 21 of 61 samples, 34.4 %"));
}

TEST(Diagnosis, namesGravity) {
  const auto without = [](ManipulatorParameters& machine) { machine.gravity.setZero(); };
  EXPECT_THAT(diagnosed(ofAnother(without)).cause, StartsWith("gravity left out, which explains more than 99.9999 %"));
  EXPECT_THAT(diagnosed(ofAnother([](auto& machine) { machine.gravity *= -1; })).cause,
              StartsWith("gravity with the wrong sign"));
  EXPECT_THAT(diagnosed(ofAnother([](auto& machine) { machine.gravity *= 1.001; })).cause,
              StartsWith("gravity scaled by 1.001,"));
}

TEST(Diagnosis, namesInertia) {
  TorqueTable torques = exact();
  const Subject noc = nocSubject(*helix().manipulator, nullptr);
  for (std::size_t k = 0; k < torques.t.size(); ++k) {
    Motion<double> motion = helix().trajectory->at(torques.t[k]);
    motion.omega_dot.setZero();
    motion.p_ddot.setZero();
    torques.torques[k] = noc.torques(motion);
  }
  EXPECT_THAT(diagnosed(torques).cause, StartsWith("the torques of acceleration (inertia) left out"));
}

TEST(Diagnosis, namesFriction) {
  Scenario rough = helix();
  ManipulatorParameters parameters = rough.manipulator->parameters();
  for (Leg& leg : parameters.legs) leg.friction = {30, 20, 10};
  rough.manipulator = std::make_shared<const Manipulator>(parameters);
  EXPECT_THAT(diagnosed(exact(), rough).cause, StartsWith("friction left out"));
}

TEST(Diagnosis, namesMasses) {
  EXPECT_THAT(diagnosed(ofAnother([](auto& machine) { machine.platform.mass *= 1.02; })).cause,
              AllOf(StartsWith("platform mass 510 +- "), HasSubstr(" kg instead of 500, which explains more than")));
  EXPECT_THAT(diagnosed(ofAnother([](auto& machine) { machine.platform.inertia *= 0.9; })).cause,
              StartsWith("platform inertia tensor scaled by 0.9 +- "));
}

TEST(Diagnosis, knowsStandardGravity) {
  EXPECT_THAT(diagnosed(ofAnother([](auto& machine) { machine.gravity.z() = -9.80665; })).cause,
              StartsWith("gravity scaled by 1 - 0.0003415 (9.80665 m/s^2, standard gravity), which"));
}

TEST(Diagnosis, givesAParameterAsManyDigitsAsTheFileHas) {
  const TorqueTable heavier = ofAnother([](auto& machine) { machine.platform.mass = 499.31; });
  std::string text = "t_s,tau_1_Nm,tau_2_Nm,tau_3_Nm,tau_4_Nm,tau_5_Nm,tau_6_Nm\n";
  for (std::size_t k = 0; k < heavier.t.size(); ++k) {
    text += fmt::format("{:.17g}", heavier.t[k]);
    for (int i = 0; i < leg_count; ++i) text += fmt::format(",{:.1f}", heavier.torques[k](i));
    text += '\n';
  }
  const TorqueFile file = parseTorqueFile(text, "rounded.csv");
  const std::string cause = diagnose(helix(), runExternal(helix(), file)).cause;
  EXPECT_THAT(cause, HasSubstr("platform mass 499.3"));
  EXPECT_THAT(cause, HasSubstr(" kg instead of 500"));
}

TEST(Diagnosis, namesAPartAsAPart) {
  // Two causes: the larger one is a part, and the rest is far beyond the file's precision.
  TorqueTable torques = ofAnother([](auto& machine) { machine.platform.mass *= 1.05; });
  SeededDraws dice(3);
  for (Vector6d& tau : torques.torques) tau(1) += dice.between(-1, 1);
  EXPECT_THAT(diagnosed(torques).cause, AllOf(StartsWith("a likely part: platform mass 52"),
                                              HasSubstr("times the limit of rounding and digits")));
}

TEST(Diagnosis, namesSwappedLegs) {
  const TorqueTable swapped = exact().changed([](std::size_t, Vector6d& tau) { std::swap(tau(1), tau(4)); });
  EXPECT_THAT(diagnosed(swapped).cause, StartsWith("legs 2 and 5 swapped, which explains more than 99.9999 %"));
  EXPECT_THAT(diagnosed(swapped).summary, StartsWith("legs 2, 5 by up to "));
}

TEST(Diagnosis, namesSigns) {
  EXPECT_THAT(diagnosed(exact().changed([](std::size_t, Vector6d& tau) { tau(2) *= -1; })).cause,
              StartsWith("the sign of leg 3 flipped, which explains"));
  EXPECT_THAT(diagnosed(exact().changed([](std::size_t, Vector6d& tau) { tau *= -1; })).cause,
              StartsWith("the sign of every leg flipped"));
}

TEST(Diagnosis, namesOffsetsScalesAndUnits) {
  const Vector6d offset = (Vector6d() << 0, 0, 0, 5, 0, 0).finished();
  EXPECT_THAT(diagnosed(exact().changed([&](std::size_t, Vector6d& tau) { tau += offset; })).cause,
              StartsWith("a constant offset: +5 N m on leg 4, which explains"));
  EXPECT_THAT(diagnosed(exact().changed([](std::size_t, Vector6d& tau) { tau *= 1e-3; })).cause,
              StartsWith("every torque scaled by 0.001 (kN m for N m)"));
  EXPECT_THAT(diagnosed(exact().changed([](std::size_t, Vector6d& tau) { tau(3) *= 1.02; })).cause,
              StartsWith("a factor of 1.02 on leg 4"));
  EXPECT_THAT(diagnosed(exact().changed([](std::size_t, Vector6d& tau) { tau *= 1 + 1e-8; })).cause,
              StartsWith("every torque scaled by 1 + 1e-08"));
  EXPECT_THAT(diagnosed(exact().changed([](std::size_t, Vector6d& tau) { tau(2) *= 1 - 1e-10; })).cause,
              StartsWith("a factor of 1 - 1e-10 on leg 3, which"));
}

TEST(Diagnosis, namesATimeShift) {
  for (double shift : {-0.01, 0.01, 0.2}) {
    TorqueTable torques = exact();
    const Subject noc = nocSubject(*helix().manipulator, nullptr);
    for (std::size_t k = 0; k < torques.t.size(); ++k)
      torques.torques[k] = noc.torques(helix().trajectory->at(std::min(std::max(torques.t[k] + shift, 0.0), 3.0)));
    EXPECT_THAT(diagnosed(torques).cause,
                StartsWith(shift == -0.01  ? "a time shift: the torques of 10 ms before (late)"
                           : shift == 0.01 ? "a time shift: the torques of 10 ms after (early)"
                                           : "a time shift: the torques of 200 ms after"));
  }
}

TEST(Diagnosis, namesAFormulaAsPrinted) {
  const TorqueTable torques =
      torquesOf(helix(), wrongNocSubject(*helix().manipulator, nullptr, WithFormulaErrors(FormulaError::eq43b_doubled)),
                equallySpaced(3, instants));
  EXPECT_THAT(diagnosed(torques).cause, StartsWith("(43b) as printed, its last terms doubled"));
}

/// The same mistake in other words is no alternative, and a telescopic leg has none of the paper's equations.
TEST(Diagnosis, namesAMistakeOnceAndWithoutEquations) {
  const Scenario telescopic = scenarioOf("flight-simulator");
  for (const auto& [error, words, again] :
       {std::tuple(FormulaError::drop_gyroscopic_platform, "the gyroscopic moment of the platform left out",
                   "the platform's gyroscopic moment"),
        std::tuple(FormulaError::drop_gyroscopic_legs, "the gyroscopic moment of the links left out",
                   "the links' gyroscopic moments")}) {
    const std::string cause =
        diagnosed(
            torquesOf(telescopic, wrongNocSubject(*telescopic.manipulator, telescopic.load, WithFormulaErrors(error)),
                      equallySpaced(telescopic.trajectory->duration(), instants)),
            telescopic)
            .cause;
    EXPECT_THAT(cause, StartsWith(words));
    EXPECT_THAT(cause, AllOf(Not(HasSubstr(again)), Not(HasSubstr("(38)"))));
  }
}

TEST(Diagnosis, namesSinglePrecision) {
  const TorqueTable torques =
      exact().changed([](std::size_t, Vector6d& tau) { tau = tau.cast<float>().cast<double>().eval(); });
  EXPECT_THAT(diagnosed(torques).cause, StartsWith("single precision"));
}

TEST(Diagnosis, claimsNothingThatTheResidualDoesNotSupport) {
  SeededDraws dice(5);
  const TorqueTable noisy = exact().changed([&](std::size_t, Vector6d& tau) {
    for (int i = 0; i < leg_count; ++i) tau(i) += dice.between(-1, 1);
  });
  EXPECT_THAT(diagnosed(noisy).cause, StartsWith("no pattern from one instant to the next"));
  const TorqueTable mixed = exact().changed([](std::size_t k, Vector6d& tau) {
    tau *= 1.05;
    tau(0) += 40 * std::sin(0.1 * static_cast<double>(k));
  });
  EXPECT_THAT(diagnosed(mixed).cause, StartsWith("no simple explanation"));
  EXPECT_THAT(diagnosed(mixed).cause, HasSubstr("explains only"));
}

/// A third of the motion, in which a factor explains all; of a pattern there is none, only the interval is named.
TEST(Diagnosis, namesAnIntervalAndWhatIsWrongInIt) {
  const auto within = [](std::size_t k) { return k >= 20 && k <= 40; };
  const TorqueTable scaled = exact().changed([&](std::size_t k, Vector6d& tau) {
    if (within(k)) tau *= 1.001;
  });
  EXPECT_THAT(diagnosed(scaled).cause, StartsWith("right but from t = 1 to 2 s; there every torque scaled by 1.001"));
  SeededDraws dice(6);
  const TorqueTable noisy = exact().changed([&](std::size_t k, Vector6d& tau) {
    for (int i = 0; i < leg_count && within(k); ++i) tau(i) += dice.between(1, 2);
  });
  EXPECT_EQ(diagnosed(noisy).cause, "right but from t = 1 to 2 s");
}

TEST(Diagnosis, ofOneInstantFitsNothingWithAsManyNumbers) {
  TorqueTable one = exact();
  one.t = {1.5};
  one.torques = {exact().torques[30] + (Vector6d() << 1, -2, 3, -1, 2, 1).finished()};
  EXPECT_THAT(diagnosed(one).cause, Not(HasSubstr("offset")));
}

}  // namespace
}  // namespace ursula
