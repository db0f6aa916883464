// Two and three mistakes at once: named where each is needed, and nothing else.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "parts/causes/pursuit.h"
#include "parts/wrong_formulas/wrong_noc.h"
#include "tests/support/motions.h"
#include "tests/validation/scenario_files.h"
#include "tests/validation/wrong_solvers.h"

namespace ursula {
namespace {

using Eigen::VectorXd;
using testing::HasSubstr;
using testing::StartsWith;
using Kinds = std::vector<CauseKind>;

/// Efforts of two motors at twelve instants, and mistakes that add something to them.
class Additive {
 public:
  Additive() {
    for (const char* term : {"gravity", "gyroscopic", "friction", "inertia", "coriolis"})
      suspects.push_back({{CauseKind::missing_term, term}, drawn()});
    suspects.push_back({{CauseKind::parameter, "", "", "mass"}, drawn(), true});
  }

  /// The pursuit's sets for efforts that were found.
  std::vector<Mistakes> pursued(const VectorXd& found) const {
    return Pursuit(suspects, right, found, limit, 2,
                   [this](const auto& which, const VectorXd& x) { return std::optional(with(which, x)); })
        .all();
  }
  VectorXd with(const std::vector<std::size_t>& which, const VectorXd& x) const {
    VectorXd out = right;
    for (std::size_t i = 0; i < which.size(); ++i)
      out += (suspects[which[i]].has_number ? x(static_cast<Eigen::Index>(i)) : 1) * suspects[which[i]].effect;
    return out;
  }
  VectorXd with(const std::vector<std::size_t>& which) const { return with(which, VectorXd::Constant(3, 0.3)); }

  VectorXd drawn() {
    return VectorXd::NullaryExpr(24, [this] { return dice.between(-1, 1); });
  }
  SeededDraws dice{4};
  VectorXd right = 10 * drawn(), limit = VectorXd::Constant(24, 1e-12);
  std::vector<Suspect> suspects;
};

std::vector<std::size_t> only(const std::vector<Mistakes>& sets) {
  EXPECT_EQ(sets.size(), 1U);
  std::vector<std::size_t> out = sets.empty() ? std::vector<std::size_t>() : sets.front().which;
  std::sort(out.begin(), out.end());
  return out;
}

TEST(Pursuit, findsPairsAndTriplesWithTheirNumbers) {
  const Additive here;
  EXPECT_THAT(only(here.pursued(here.with({1, 2}))), testing::ElementsAre(1, 2));
  EXPECT_THAT(only(here.pursued(here.with({0, 3, 4}))), testing::ElementsAre(0, 3, 4));
  const std::vector<Mistakes> with_number = here.pursued(here.with({2, 5}));
  EXPECT_THAT(only(with_number), testing::ElementsAre(2, 5));
  EXPECT_EQ(with_number.front().numbers, 1);
  EXPECT_NEAR(with_number.front().x.sum(), 0.3, 1e-9);
}

TEST(Pursuit, appliesAnOrderAndFactorsLast) {
  const Additive here;
  VectorXd swapped = here.with({1}), larger = swapped;
  for (Eigen::Index k = 0; k < swapped.size(); k += 2) std::swap(swapped(k), swapped(k + 1)), larger(k) *= 1.5;
  for (const VectorXd& found : {swapped, larger}) {
    const std::vector<std::size_t> which = only(here.pursued(found));
    ASSERT_EQ(which.size(), 2U);
    EXPECT_EQ(which.front(), 1U);
    EXPECT_GE(which.back(), here.suspects.size()) << "an output";
  }
}

/// A single mistake is no pair with one without effect, noise is none at all, and a pair that another explains as well
/// is not alone.
TEST(Pursuit, findsNothingThatIsNotNeeded) {
  Additive here;
  EXPECT_TRUE(here.pursued(here.with({1})).empty());
  EXPECT_TRUE(here.pursued(here.right + here.drawn()).empty());
  here.suspects.push_back(
      {{CauseKind::frame, "load"}, here.suspects[0].effect + here.suspects[1].effect - here.suspects[2].effect});
  const std::vector<Mistakes> two = here.pursued(here.with({0, 1}));
  EXPECT_EQ(two.size(), 2U) << "those of the new one and the third";
}

/// Six telescopic legs with friction, tumbling.
const Trial& platform() {
  static const Trial trial{tumblingOf("/scenarios/ups-friction-load.toml"), 41};
  return trial;
}

Answering without(
    FormulaError error, const MachineChange& change = [](Machine&) {}) {
  const Scenario other = changed(platform().scenario, change);
  return wrongNocSubject(*other.manipulator, other.load, WithFormulaErrors(error)).torques;
}

void noFriction(Machine& machine) {
  for (Leg& leg : machine.legs) leg.friction = {}, leg.coulomb.phi = leg.coulomb.psi = leg.coulomb.d = 0;
}

Kinds kindsOf(const Diagnosis& said) {
  Kinds out;
  for (const NamedCause& each : said.together) out.push_back(each.kind);
  std::sort(out.begin(), out.end());
  return out;
}

void expectTogether(const Rows& efforts, const Kinds& kinds, const char* words) {
  const Diagnosis said = platform().said(efforts);
  EXPECT_EQ(kindsOf(said), kinds) << said.cause;
  EXPECT_THAT(said.cause, HasSubstr(words));
  ASSERT_TRUE(said.named) << said.cause;
  ASSERT_FALSE(said.together.empty());
  EXPECT_EQ(said.named->kind, said.together.front().kind);
  for (std::size_t i = 0; i < said.together.size(); ++i) {
    EXPECT_GE(said.together[i].explained, 0);
    EXPECT_LE(said.together[i].explained, 1);
    EXPECT_LE(said.together[i].explained, said.together.front().explained);
  }
}

TEST(SeveralMistakes, ofTermsLeftOut) {
  expectTogether(platform().answers(without(FormulaError::drop_gyroscopic_platform, noFriction)),
                 {CauseKind::missing_term, CauseKind::missing_term}, "friction left out");
  expectTogether(platform().answers(without(FormulaError::drop_gravity_legs,
                                            [](Machine& m) { noFriction(m), m.platform.mass *= 1.02; })),
                 {CauseKind::parameter, CauseKind::missing_term, CauseKind::missing_term}, "three mistakes together");
}

TEST(SeveralMistakes, ofNumbersOfOneBody) {
  expectTogether(platform().answers(platform().solver([](Machine& machine) {
    machine.platform.mass *= 1.05;
    machine.platform.center_of_mass(2) += 0.004;
  })),
                 {CauseKind::parameter, CauseKind::parameter}, "platform mass centre z");
}

TEST(SeveralMistakes, ofAnOrderOrAFactorAfterATerm) {
  Rows swapped = platform().answers(without(FormulaError::drop_gravity_legs)), larger = swapped;
  for (std::size_t k = 0; k < swapped.size(); ++k) std::swap(swapped[k](1), swapped[k](4)), larger[k](2) *= 1.1;
  expectTogether(swapped, {CauseKind::order, CauseKind::missing_term}, "legs 2 and 5 swapped");
  expectTogether(larger, {CauseKind::scale, CauseKind::missing_term}, "a factor of 1.1 on leg 3");
}

/// A factor and an offset of one motor explain the same in either order, with another offset. The truth is within what
/// is said, though each fit alone is exact to 14 digits.
TEST(SeveralMistakes, sayHowFarTheirNumbersDependOnTheOrder) {
  for (const bool offset_first : {false, true}) {
    Rows efforts = platform().right();
    for (Vector6d& row : efforts) row(2) = offset_first ? 1.02 * (row(2) + 2) : 1.02 * row(2) + 2;
    const Diagnosis said = platform().said(efforts);
    const auto offset = std::find_if(said.together.begin(), said.together.end(),
                                     [](const NamedCause& one) { return one.kind == CauseKind::offset; });
    ASSERT_NE(offset, said.together.end()) << said.cause;
    ASSERT_TRUE(offset->found && offset->uncertainty) << said.cause;
    EXPECT_LE(std::abs(*offset->found - 2), *offset->uncertainty + 1e-9) << said.cause;
    EXPECT_LT(*offset->uncertainty, 0.1);
    EXPECT_THAT(said.cause, HasSubstr("+- 0.04"));
  }
}

/// Numbers whose effects are nearly alike are less certain together than each alone.
TEST(Pursuit, knowsAlikeNumbersLessWell) {
  Additive here;
  here.suspects.push_back(
      {{CauseKind::parameter, "", "", "length"}, here.suspects[5].effect + 0.1 * here.drawn(), true});
  const VectorXd found = here.right + 0.3 * here.suspects[5].effect + 0.2 * here.suspects[6].effect;
  const Pursuit pursuit(here.suspects, here.right, found, here.limit, 2,
                        [&](const auto& which, const VectorXd& x) { return std::optional(here.with(which, x)); });
  const std::vector<Mistakes> sets = pursuit.all();
  ASSERT_EQ(sets.size(), 1U);
  const NumbersDoubt doubt = pursuit.doubt(sets.front());
  EXPECT_GT(doubt.inflation.minCoeff(), 3);
  EXPECT_LT(doubt.shift.maxCoeff(), 1e-6) << "their order makes no difference";
}

TEST(Words, sayZeroForZeros) {
  EXPECT_EQ(withDeviation(0, 1e-11), "0");
  EXPECT_EQ(withDeviation(5e-16, 2e-14, 9.81), "0");
  EXPECT_EQ(withDeviation(0.3, 0.5, 62), "0.3 +- 0.5") << "it is not known to be zero";
  EXPECT_EQ(withDeviation(5e-3, 2e-14, 9.81), "0.005 +- 2e-14");
}

/// One mistake is never two, and neither is one with noise that no mistake makes.
TEST(SeveralMistakes, areNotClaimedForOne) {
  const Rows one = platform().answers(without(FormulaError::drop_gyroscopic_platform));
  EXPECT_TRUE(platform().said(one).together.empty());
  SeededDraws dice(7);
  Rows noisy = one;
  for (Vector6d& row : noisy) row(0) += dice.between(-1, 1);
  const Diagnosis said = platform().said(noisy);
  EXPECT_TRUE(said.together.empty()) << said.cause;
  EXPECT_FALSE(said.named) << said.cause;
}

/// Where nothing explains all, the best three come with their shares.
TEST(SeveralMistakes, areRankedWhereNothingExplainsAll) {
  Rows efforts = platform().answers(without(FormulaError::drop_gyroscopic_platform, noFriction));
  for (std::size_t k = 0; k < efforts.size(); ++k) efforts[k](3) += 2 * std::sin(0.7 * static_cast<double>(k * k));
  const Diagnosis said = platform().said(efforts);
  EXPECT_FALSE(said.named) << said.cause;
  EXPECT_THAT(said.cause, HasSubstr(". Next: "));
  ASSERT_GE(said.others.size(), 2U);
  EXPECT_GE(said.others[0].explained, said.others[1].explained);
}

}  // namespace
}  // namespace ursula
