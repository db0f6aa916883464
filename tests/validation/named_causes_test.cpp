// The cause by the contract's terms: each fault alone is named as it is, and where several would do none is.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <string>

#include "tests/support/motions.h"
#include "tests/validation/external_torques.h"
#include "validation/causes/asked_apart.h"
#include "validation/causes/diagnosis.h"
#include "validation/causes/explanation.h"
#include "validation/mistakes/tied_parameters.h"

namespace ursula {
namespace {

constexpr int instants = 61;

using MachineFault = std::function<void(ManipulatorParameters&)>;
using MotionFault = std::function<void(Motion<double>&)>;

Subject ofMachine(const MachineFault& fault) {
  ManipulatorParameters parameters = helix().manipulator->parameters();
  fault(parameters);
  return nocSubject(Manipulator(parameters), helix().load);
}

Subject ofMotion(const MotionFault& fault) {
  Subject out;
  out.torques = [noc = nocSubject(*helix().manipulator, nullptr), fault](Motion<double> motion) {
    fault(motion);
    return noc.torques(motion);
  };
  return out;
}

Diagnosis diagnosed(const TorqueTable& torques) { return diagnose(helix(), runExternal(helix(), torques.file())); }

Diagnosis diagnosed(const Subject& subject) {
  return diagnosed(torquesOf(helix(), subject, equallySpaced(helix().trajectory->duration(), instants)));
}

NamedCause named(const Diagnosis& diagnosis) {
  EXPECT_TRUE(diagnosis.named) << diagnosis.cause;
  return diagnosis.named.value_or(NamedCause{});
}

TEST(NamedCause, severalNumbersHaveTheStartOfTheirPaths) {
  std::set<std::string> paths;
  for (const TiedParameters& tied : tiedParameters(*helix().manipulator)) {
    const std::optional<NamedCause> named = tied.named(helix().manipulator->parameters(), 0.01, 0.001);
    if (named && tied.members.size() > 1) paths.insert(named->parameter);
  }
  for (const char* each : {"manipulator.leg_defaults.distal.mass", "manipulator.leg_defaults.distal.inertia",
                           "manipulator.leg_defaults", "manipulator.leg.4"})
    EXPECT_THAT(paths, testing::Contains(each));
  for (const char* each : {"", "manipulator"}) EXPECT_THAT(paths, testing::Not(testing::Contains(each)));
}

TEST(NamedCause, parametersHaveTheScenariosPathAndNumbers) {
  const NamedCause one = named(diagnosed(ofMachine([](auto& machine) { machine.legs[3].distal.mass = 10.5; })));
  EXPECT_EQ(one.kind, CauseKind::parameter);
  EXPECT_EQ(one.parameter, "manipulator.leg.4.distal.mass");
  EXPECT_EQ(one.body, "distal");
  EXPECT_EQ(one.leg, 4);
  EXPECT_EQ(one.unit, "kg");
  EXPECT_EQ(one.expected, 10);
  EXPECT_NEAR(one.found.value(), 10.5, one.uncertainty.value() + 1e-9);
  EXPECT_GT(one.explained, 1 - 1e-6);

  const NamedCause all = named(diagnosed(ofMachine([](auto& machine) {
    for (Leg& leg : machine.legs) leg.proximal.mass = 9;
  })));
  EXPECT_EQ(all.parameter, "manipulator.leg_defaults.proximal.mass");
  EXPECT_EQ(all.leg, 0);
  EXPECT_NEAR(all.found.value(), 9, 1e-6);

  const NamedCause gravity = named(diagnosed(ofMachine([](auto& machine) { machine.gravity.z() = -9.80665; })));
  EXPECT_EQ(gravity.parameter, "manipulator.gravity");
  EXPECT_NEAR(gravity.found.value(), 9.80665, 1e-9);
}

struct Fault {
  const char* what;
  Subject subject;
  CauseKind kind;
  const char *term, *body;
};

std::vector<Fault> faults() {
  const auto formula = [](FormulaError error) {
    return wrongNocSubject(*helix().manipulator, nullptr, WithFormulaErrors(error));
  };
  return {
      {"no gravity", ofMachine([](auto& machine) { machine.gravity.setZero(); }), CauseKind::missing_term, "gravity",
       "all"},
      {"gravity upwards", ofMachine([](auto& machine) { machine.gravity *= -1; }), CauseKind::sign, "gravity", "all"},
      {"platform's gravity", formula(FormulaError::drop_gravity_platform), CauseKind::missing_term, "gravity",
       "platform"},
      {"Coriolis", formula(FormulaError::drop_coriolis), CauseKind::missing_term, "coriolis", "legs"},
      {"Q transposed", ofMotion([](auto& motion) { motion.Q.transposeInPlace(); }), CauseKind::frame, "orientation",
       "all"},
      {"no angular acceleration", ofMotion([](auto& motion) { motion.omega_dot.setZero(); }), CauseKind::missing_term,
       "angular_acceleration", "all"},
      {"platform's mass centre on the other side",
       ofMachine([](auto& machine) { machine.platform.center_of_mass *= -1; }), CauseKind::reference_point, "",
       "platform"},
  };
}

TEST(NamedCause, faultsOfTermsFramesAndPointsAreNamed) {
  for (const Fault& fault : faults()) {
    const NamedCause found = named(diagnosed(fault.subject));
    EXPECT_EQ(found.kind, fault.kind) << fault.what;
    EXPECT_EQ(found.term, fault.term) << fault.what;
    EXPECT_EQ(found.body, fault.body) << fault.what;
  }
}

TEST(NamedCause, columnsAreNamed) {
  const TorqueTable exact = exactTorques(helix(), instants);
  const NamedCause swapped =
      named(diagnosed(exact.changed([](std::size_t, Vector6d& tau) { std::swap(tau(1), tau(4)); })));
  EXPECT_EQ(swapped.kind, CauseKind::order);
  EXPECT_THAT(swapped.legs, testing::ElementsAre(1, 5, 3, 4, 2, 6));
  const NamedCause flipped = named(diagnosed(exact.changed([](std::size_t, Vector6d& tau) { tau(2) *= -1; })));
  EXPECT_EQ(flipped.kind, CauseKind::sign);
  EXPECT_EQ(flipped.motor, 3);
  const NamedCause several = named(diagnosed(exact.changed([](std::size_t, Vector6d& tau) {
    for (const int i : {1, 3, 5}) tau(i) *= -1;
  })));
  EXPECT_EQ(several.kind, CauseKind::sign);
  EXPECT_THAT(several.legs, testing::ElementsAre(2, 4, 6));
  EXPECT_EQ(named(diagnosed(exact.changed([](std::size_t, Vector6d& tau) { tau *= 1e-3; }))).kind, CauseKind::units);
  const NamedCause offset = named(diagnosed(exact.changed([](std::size_t, Vector6d& tau) { tau(3) += 5; })));
  EXPECT_EQ(offset.kind, CauseKind::offset);
  EXPECT_EQ(offset.motor, 4);
  EXPECT_NEAR(offset.found.value(), 5, 1e-9);
  const NamedCause window = named(diagnosed(exact.changed([](std::size_t k, Vector6d& tau) {
    if (k >= 20 && k <= 40) tau *= 1.001;
  })));
  EXPECT_EQ(window.kind, CauseKind::window);
  EXPECT_NEAR(window.from_s.value(), 1, 1e-12);
  EXPECT_NEAR(window.to_s.value(), 2, 1e-12);
}

TEST(NamedCause, anAxisIsNamedByItsEntryOrAsAWhole) {
  const NamedCause entry = named(diagnosed(ofMachine([](auto& machine) { machine.legs[2].base_axis.z() += 0.02; })));
  EXPECT_EQ(entry.kind, CauseKind::parameter);
  EXPECT_EQ(entry.parameter, "manipulator.leg.3.base_axis.2");
  EXPECT_NEAR(entry.found.value() - entry.expected.value(), 0.02, 1e-9);
  const NamedCause whole =
      named(diagnosed(ofMachine([](auto& machine) { machine.legs[2].base_axis += Vector3d(0.01, 0.02, 0.02); })));
  EXPECT_EQ(whole.parameter, "manipulator.leg.3.base_axis");
  EXPECT_EQ(whole.leg, 3);
  EXPECT_EQ(named(diagnosed(ofMachine([](auto& machine) {
              machine.gravity = {0.4, -0.7, -9.78};
            }))).parameter,
            "manipulator.gravity");
  const Diagnosis two = diagnosed(ofMachine([](auto& machine) {
    for (const std::size_t i : {1, 4}) machine.legs[i].base_axis += Vector3d(0.01, 0.02, 0.02);
  }));
  EXPECT_FALSE(two.cause.empty());
  EXPECT_FALSE(two.named) << two.cause;
}

/// Answers that say nothing of the machine are small beside the right ones: what they leave out is no cause.
TEST(NamedCause, theSameAnswerAlwaysIsNamedAndNothingElse) {
  const TorqueTable exact = exactTorques(helix(), instants);
  const auto all = [&](const Vector6d& answer) {
    return diagnosed(exact.changed([answer](std::size_t, Vector6d& tau) { tau = answer; }));
  };
  const NamedCause zeros = named(all(Vector6d::Zero()));
  EXPECT_EQ(zeros.kind, CauseKind::scale);
  EXPECT_EQ(zeros.body, "all");
  EXPECT_EQ(zeros.found, 0.0);
  const NamedCause dead = named(diagnosed(exact.changed([](std::size_t, Vector6d& tau) { tau(3) = 0; })));
  EXPECT_EQ(dead.kind, CauseKind::scale);
  EXPECT_EQ(dead.motor, 4);
  for (const Vector6d& answer : {Vector6d(Vector6d::Unit(5)), exact.torques[7]}) {
    const Diagnosis same = all(answer);
    EXPECT_EQ(same.cause.find("the same answer at every instant: "), 0U) << same.cause;
    EXPECT_FALSE(same.named) << same.cause;
  }
  const Diagnosis little =
      diagnosed(exact.changed([](std::size_t k, Vector6d& tau) { tau = Vector6d::Unit(static_cast<int>(k % 6)); }));
  EXPECT_FALSE(little.named);
  EXPECT_EQ(little.cause.find("left out"), std::string::npos) << little.cause;
}

TEST(NamedCause, noneIsNamedWithoutEvidence) {
  SeededDraws dice(5);
  const Diagnosis noise = diagnosed(exactTorques(helix(), instants).changed([&](std::size_t, Vector6d& tau) {
    for (int i = 0; i < leg_count; ++i) tau(i) += dice.between(-1, 1);
  }));
  EXPECT_FALSE(noise.cause.empty());
  EXPECT_FALSE(noise.named);
  TorqueTable one = exactTorques(helix(), instants);  // one pose: six numbers, which much can make
  one.t = {1.5};
  one.torques = {ofMachine([](auto& machine) { machine.platform.mass *= 1.01; }).torques(helix().trajectory->at(1.5))};
  EXPECT_FALSE(diagnosed(one).cause.empty());
  EXPECT_FALSE(diagnosed(one).named);
}

/// Left out, with the wrong sign: also a number that is 0 or turned about, which is not another cause. Two that are
/// unlike and do as well leave the cause open.
TEST(NamedCause, tiesAreLeftOpenUnlessTheySayTheSame) {
  const Motion<double> one = helix().trajectory->at(1), other = helix().trajectory->at(2);
  TorqueResidual data;
  data.motions = {one, other};
  data.commanded = 2;
  const auto hypothesis = [](const NamedCause& cause) {
    Hypothesis out{"", 0, 1};
    out.named = cause;
    return out;
  };
  const NamedCause missing{CauseKind::missing_term, "gravity", "all"};
  const NamedCause zero{CauseKind::parameter, "", "", "manipulator.gravity.2", "m/s^2", -9.81, 0.0};
  const NamedCause mass{CauseKind::parameter, "", "platform", "manipulator.platform.mass", "kg", 500.0, 400.0};
  EXPECT_EQ(named({hypothesis(missing), hypothesis(zero)}, data, "").named.value().kind, CauseKind::missing_term);
  const Explanation open = named({hypothesis(missing), hypothesis(mass)}, data, "");
  EXPECT_FALSE(open.named);
  EXPECT_EQ(open.others.size(), 2U);
  const NamedCause frame{CauseKind::frame, "gravity", "all"}, of_platform{CauseKind::frame, "gravity", "platform"};
  const NamedCause point{CauseKind::reference_point, "gravity", "all"};
  const Explanation likelier =
      named({hypothesis(missing), hypothesis(frame), hypothesis(point), hypothesis(frame)}, data, "");
  EXPECT_EQ(likelier.named.value().kind, CauseKind::missing_term);
  EXPECT_EQ(likelier.others.size(), 2U) << "each is listed once";
  EXPECT_FALSE(named({hypothesis(missing), hypothesis(of_platform)}, data, "").named) << "of another body";
  data.motions = {one, one};
  EXPECT_FALSE(named({hypothesis(missing)}, data, "").named);
}

TEST(NamedCause, anAnswerThatChangesComesFirst) {
  ValidationResult result;
  result.cause_words = {"leg 1", "a factor"};
  result.cause = NamedCause{CauseKind::scale, "", "all"};
  result.terms = {{"statics", 1e-6}};
  nameState(result);
  EXPECT_EQ(result.cause.value().kind, CauseKind::scale);
  result.terms.push_back({repeat_term, 1e-6});
  nameState(result);
  EXPECT_EQ(result.cause.value().kind, CauseKind::state);
  ASSERT_EQ(result.causes.size(), 1U);
  EXPECT_EQ(result.causes.front().kind, CauseKind::scale);
}

std::map<std::string, double> asked(const Subject& subject) {
  std::vector<Motion<double>> motions;
  for (const double t : {0.2, 1.0, 2.0}) motions.push_back(helix().trajectory->at(t));
  std::map<std::string, double> out;
  for (const TermError& each : askedApart(subject, helix(), motions).terms) out[each.term] = each.error;
  return out;
}

TEST(AskedApart, showsWhatIsOff) {
  const auto right = asked(nocSubject(*helix().manipulator, nullptr));
  EXPECT_EQ(right.size(), 8U);
  for (const auto& [term, error] : right) EXPECT_LE(error, 1e-9) << term;
  const auto gyroscopic =
      asked(wrongNocSubject(*helix().manipulator, nullptr, WithFormulaErrors(FormulaError::drop_gyroscopic_legs)));
  EXPECT_LE(gyroscopic.at("statics"), 1e-9);
  EXPECT_LE(gyroscopic.at("acceleration"), 1e-9);
  EXPECT_GT(gyroscopic.at("velocity") + gyroscopic.at("angular_velocity"), 1e-4);
  const auto weightless = asked(ofMachine([](auto& machine) { machine.gravity.setZero(); }));
  EXPECT_GT(weightless.at("statics"), 0.99);
  EXPECT_LE(weightless.at("angular_acceleration"), 1e-9);
  Subject blind = nocSubject(*helix().manipulator, nullptr);
  blind.torques = [right = blind.torques](const Motion<double>& motion) -> Vector6d {
    return right(motion) * (motion.omega.isZero() ? 1 : std::nan(""));
  };
  EXPECT_TRUE(std::isnan(asked(blind).at("angular_velocity")));
  Subject forgetful = nocSubject(*helix().manipulator, nullptr);
  const auto calls = std::make_shared<int>(0);
  forgetful.torques = [right = forgetful.torques, calls](const Motion<double>& motion) -> Vector6d {
    return right(motion) * (1 + 1e-6 * ++*calls);
  };
  EXPECT_GT(asked(forgetful).at("repeat"), 1e-6);
}

}  // namespace
}  // namespace ursula
