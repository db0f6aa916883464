// The cause by the contract's terms: each fault alone is named as it is, and where several would do none is.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "parts/causes/explanation.h"
#include "parts/causes/tied_parameters.h"
#include "parts/wrong_formulas/wrong_noc.h"
#include "tests/validation/wrong_solvers.h"

namespace ursula {
namespace {

TEST(NamedCause, severalNumbersHaveTheStartOfTheirPaths) {
  std::set<std::string> paths;
  for (const TiedParameters& tied : tiedParameters(*onHelix().scenario.manipulator)) {
    const std::optional<NamedCause> named = tied.named(onHelix().scenario.manipulator->parameters(), 0.01, 0.001);
    if (named && tied.members.size() > 1) paths.insert(named->parameter);
  }
  for (const char* each : {"manipulator.leg_defaults.distal.mass", "manipulator.leg_defaults.distal.inertia",
                           "manipulator.leg_defaults", "manipulator.leg.4"})
    EXPECT_THAT(paths, testing::Contains(each));
  for (const char* each : {"", "manipulator"}) EXPECT_THAT(paths, testing::Not(testing::Contains(each)));
}

TEST(NamedCause, parametersHaveTheScenariosPathAndNumbers) {
  const NamedCause one =
      named(onHelix().said([](Machine& machine) { machine.legs[3].distal.mass = 10.5; }), CauseKind::parameter);
  EXPECT_EQ(one.parameter, "manipulator.leg.4.distal.mass");
  EXPECT_EQ(one.body, "distal");
  EXPECT_EQ(one.leg, 4);
  EXPECT_EQ(one.unit, "kg");
  EXPECT_EQ(one.expected, 10);
  EXPECT_NEAR(one.found.value(), 10.5, one.uncertainty.value() + 1e-9);
  EXPECT_GT(one.explained, 1 - 1e-6);

  const NamedCause all =
      named(onHelix().said(ofEachLeg([](Leg& leg) { leg.proximal.mass = 9; })), CauseKind::parameter);
  EXPECT_EQ(all.parameter, "manipulator.leg_defaults.proximal.mass");
  EXPECT_EQ(all.leg, 0);
  EXPECT_NEAR(all.found.value(), 9, 1e-6);

  const NamedCause gravity =
      named(onHelix().said([](Machine& machine) { machine.gravity.z() = -9.80665; }), CauseKind::parameter);
  EXPECT_EQ(gravity.parameter, "manipulator.gravity");
  EXPECT_NEAR(gravity.found.value(), 9.80665, 1e-9);
}

Diagnosis ofColumn(const std::function<void(Vector6d&)>& change) {
  return onHelix().said(onHelix().rightBut([&](std::size_t, Vector6d& tau) { change(tau); }));
}

TEST(NamedCause, columnsAreNamed) {
  const NamedCause swapped = named(ofColumn([](auto& tau) { std::swap(tau(1), tau(4)); }), CauseKind::order);
  EXPECT_THAT(swapped.legs, testing::ElementsAre(1, 5, 3, 4, 2, 6));
  EXPECT_EQ(named(ofColumn([](auto& tau) { tau(2) *= -1; }), CauseKind::sign).motor, 3);
  const auto several = [](auto& tau) {
    for (const int i : {1, 3, 5}) tau(i) *= -1;
  };
  EXPECT_THAT(named(ofColumn(several), CauseKind::sign).legs, testing::ElementsAre(2, 4, 6));
  const NamedCause offset = named(ofColumn([](auto& tau) { tau(3) += 5; }), CauseKind::offset);
  EXPECT_EQ(offset.motor, 4);
  EXPECT_NEAR(offset.found.value(), 5, 1e-9);
}

TEST(NamedCause, anAxisIsNamedByItsEntryOrAsAWhole) {
  const NamedCause entry =
      named(onHelix().said([](Machine& machine) { machine.legs[2].base_axis.z() += 0.02; }), CauseKind::parameter);
  EXPECT_EQ(entry.parameter, "manipulator.leg.3.base_axis.2");
  EXPECT_NEAR(entry.found.value() - entry.expected.value(), 0.02, 1e-9);
  const auto of = [](std::vector<std::size_t> legs) {
    return onHelix().said([=](Machine& machine) {
      for (const std::size_t i : legs) machine.legs[i].base_axis += Vector3d(0.01, 0.02, 0.02);
    });
  };
  const NamedCause whole = named(of({2}), CauseKind::parameter);
  EXPECT_EQ(whole.parameter, "manipulator.leg.3.base_axis");
  EXPECT_EQ(whole.leg, 3);
  const Diagnosis gravity = onHelix().said([](Machine& machine) { machine.gravity = {0.4, -0.7, -9.78}; });
  EXPECT_EQ(named(gravity, CauseKind::parameter).parameter, "manipulator.gravity");
  const Diagnosis two = of({1, 4});
  EXPECT_FALSE(two.cause.empty());
  EXPECT_FALSE(two.named) << two.cause;
}

/// Answers that say nothing of the machine are small beside the right ones: what they leave out is no cause.
TEST(NamedCause, theSameAnswerAlwaysIsNamedAndNothingElse) {
  const auto all = [](const Vector6d& answer) { return ofColumn([&](Vector6d& tau) { tau = answer; }); };
  const NamedCause zeros = named(all(Vector6d::Zero()), CauseKind::scale);
  EXPECT_EQ(zeros.body, "all");
  EXPECT_EQ(zeros.found, 0.0);
  EXPECT_EQ(named(ofColumn([](auto& tau) { tau(3) = 0; }), CauseKind::scale).motor, 4);
  for (const Vector6d& answer : {Vector6d(Vector6d::Unit(5)), onHelix().right()[7]}) {
    const Diagnosis same = all(answer);
    EXPECT_EQ(same.cause.find("the same answer at every instant: "), 0U) << same.cause;
    EXPECT_FALSE(same.named) << same.cause;
  }
  const Diagnosis little = onHelix().said(
      onHelix().rightBut([](std::size_t k, Vector6d& tau) { tau = Vector6d::Unit(static_cast<int>(k % 6)); }));
  EXPECT_FALSE(little.named);
  EXPECT_EQ(little.cause.find("left out"), std::string::npos) << little.cause;
}

Hypothesis hypothesis(const NamedCause& cause, const char* text = "") {
  Hypothesis out{text, 0, 1};
  out.named = cause;
  return out;
}

/// Left out, with the wrong sign: also a number that is 0 or turned about, which is not another cause. Two that are
/// unlike and do as well leave the cause open.
TEST(Explanation, leavesTiesOpenUnlessTheySayTheSame) {
  TorqueResidual data;
  data.motions = onHelix().motions();
  data.commanded = data.motions.size();
  const auto of = [&](const std::vector<NamedCause>& causes) {
    std::vector<Hypothesis> all;
    for (const NamedCause& cause : causes) all.push_back(hypothesis(cause));
    return named(all, data, "");
  };
  const NamedCause missing{CauseKind::missing_term, "gravity", "all"};
  const NamedCause zero{CauseKind::parameter, "", "", "manipulator.gravity.2", "m/s^2", -9.81, 0.0};
  const NamedCause mass{CauseKind::parameter, "", "platform", "manipulator.platform.mass", "kg", 500.0, 400.0};
  EXPECT_EQ(of({missing, zero}).named.value().kind, CauseKind::missing_term);
  EXPECT_FALSE(of({missing, mass}).named);
  EXPECT_EQ(of({missing, mass}).others.size(), 2U);
  const NamedCause frame{CauseKind::frame, "gravity", "all"}, of_platform{CauseKind::frame, "gravity", "platform"};
  const NamedCause point{CauseKind::reference_point, "gravity", "all"};
  const Explanation likelier = of({missing, frame, point, frame});
  EXPECT_EQ(likelier.named.value().kind, CauseKind::missing_term);
  EXPECT_EQ(likelier.others.size(), 2U) << "each is listed once";
  EXPECT_FALSE(of({missing, of_platform}).named) << "of another body";
  data.motions.assign(data.commanded, data.motions.front());
  EXPECT_FALSE(of({missing}).named);
}

TEST(Explanation, prefersTheNarrowerOfOneMistake) {
  const NamedCause legs{CauseKind::reference_point, "", "legs"}, distal{CauseKind::reference_point, "", "distal"},
      other{CauseKind::reference_point, "inertia", "distal"};
  std::vector<Hypothesis> best = {hypothesis(legs, "all links"), hypothesis(distal, "the distal links")};
  putNarrowerFirst(best);
  EXPECT_EQ(best.front().text, "the distal links");
  best = {hypothesis(legs, "all links"), hypothesis(other, "another mistake")};
  putNarrowerFirst(best);
  EXPECT_EQ(best.front().text, "all links");
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
  for (const double t : {0.2, 1.0, 2.0}) motions.push_back(onHelix().scenario.trajectory->at(t));
  std::map<std::string, double> out;
  for (const TermError& each : askedApart(subject, onHelix().scenario, motions).terms) out[each.term] = each.error;
  return out;
}

TEST(AskedApart, showsWhatIsOff) {
  const auto right = asked(nocSubject(*onHelix().scenario.manipulator, nullptr));
  EXPECT_EQ(right.size(), 8U);
  for (const auto& [term, error] : right) EXPECT_LE(error, 1e-9) << term;
  const auto gyroscopic = asked(
      wrongNocSubject(*onHelix().scenario.manipulator, nullptr, WithFormulaErrors(FormulaError::drop_gyroscopic_legs)));
  EXPECT_LE(gyroscopic.at("statics"), 1e-9);
  EXPECT_LE(gyroscopic.at("acceleration"), 1e-9);
  EXPECT_GT(gyroscopic.at("velocity") + gyroscopic.at("angular_velocity"), 1e-4);
  const Scenario floating = changed(onHelix().scenario, [](Machine& machine) { machine.gravity.setZero(); });
  const auto weightless = asked(nocSubject(*floating.manipulator, nullptr));
  EXPECT_GT(weightless.at("statics"), 0.99);
  EXPECT_LE(weightless.at("angular_acceleration"), 1e-9);
  Subject blind = nocSubject(*onHelix().scenario.manipulator, nullptr);
  blind.torques = [right = blind.torques](const Motion<double>& motion) -> Vector6d {
    return right(motion) * (motion.omega.isZero() ? 1 : std::nan(""));
  };
  EXPECT_TRUE(std::isnan(asked(blind).at("angular_velocity")));
  Subject forgetful = nocSubject(*onHelix().scenario.manipulator, nullptr);
  const auto calls = std::make_shared<int>(0);
  forgetful.torques = [right = forgetful.torques, calls](const Motion<double>& motion) -> Vector6d {
    return right(motion) * (1 + 1e-6 * ++*calls);
  };
  EXPECT_GT(asked(forgetful).at("repeat"), 1e-6);
}

}  // namespace
}  // namespace ursula
