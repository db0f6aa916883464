// FastDynamics against Noc, which forms T, in 50 digits and in doubles; BatchDynamics against FastDynamics, by every
// instruction set that this processor has.

#include "parts/fast/fast_dynamics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "base/real50.h"
#include "model/load.h"
#include "parts/derivatives/effort_derivatives.h"
#include "parts/fast/batch_dynamics.h"
#include "parts/fast/solver.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/motions.h"
#include "tests/support/vectors.h"

namespace ursula {
namespace {

constexpr double promised = 1e-12;

template <class V, class W>
double distance(const V& found, const W& expected) {
  using S = typename V::Scalar;
  return static_cast<double>(S((found - expected.template cast<S>()).norm() / expected.template cast<S>().norm()));
}

template <class S>
Vector6<S> someLoad() {
  Vector6<S> load;
  load << S(3), S(-5), S(2), S(40), S(-30), S(70);
  return load;
}

/// The instruction sets of this processor, the plainest first.
std::vector<InstructionSet> supportedSets() {
  std::vector<InstructionSet> out;
  for (const InstructionSet set :
       {InstructionSet::portable, InstructionSet::sse2, InstructionSet::avx2, InstructionSet::avx512})
    if (isSupported(set)) out.push_back(set);
  return out;
}

/// A pose far from all legs.
Motion<double> away(Motion<double> motion) {
  motion.p *= 100;
  return motion;
}

class FastOf : public testing::TestWithParam<std::string> {
 protected:
  Scenario scenario_ = vectorScenario(GetParam());
  std::vector<VectorRow> rows_ = vectorRows(GetParam());
};

TEST_P(FastOf, agreesWithTheRecursionInFiftyDigits) {
  const FastDynamics<Real50> fast(*scenario_.manipulator);
  const Noc<Real50> chain(*scenario_.manipulator);
  NocWorkspace<Real50> work;
  double efforts = 0, rates = 0;
  for (const VectorRow& row : rows_) {
    const auto load = someLoad<Real50>();
    const Vector6<Real50> right = chain.inverseDynamics(row.motion, work, load);
    efforts = std::max(efforts, distance(fast.inverseDynamics(row.motion, load), right));
    const Vector6<Real50> other = Real50("1.1") * right;
    rates = std::max(rates, distance(fast.directDynamics(row.motion, other, load),
                                     chain.directDynamics(row.motion, other, work, load)));
    EXPECT_GT(distance(fast.inverseDynamics(row.motion), right), 1e-9) << "the load is seen";
  }
  EXPECT_LE(efforts, 1e-44);
  EXPECT_LE(rates, 1e-42);
}

TEST_P(FastOf, agreesWithTheRecursionInDoubles) {
  const Noc<Real50> chain(*scenario_.manipulator);
  NocWorkspace<Real50> work;
  ASSERT_GE(supportedSets().size(), 1u);
  for (const InstructionSet set : supportedSets()) {
    const FastDynamics<double> fast(*scenario_.manipulator, set);
    for (const VectorRow& row : rows_) {
      const Motion<double> motion = rounded(row.motion);
      const Vector6<Real50> right = chain.inverseDynamics(row.motion, work);
      const Vector6d found = fast.inverseDynamics(motion);
      EXPECT_LE(distance(found, right), promised) << nameOf(set);
      const Vector6d other = 1.1 * found, load = someLoad<double>();
      EXPECT_LE(distance(fast.directDynamics(motion, other, load),
                         chain.directDynamics(row.motion, other.cast<Real50>(), work, someLoad<Real50>())),
                1e-9)
          << nameOf(set);
      EXPECT_LE(
          distance(fast.inverseDynamics(motion, load), chain.inverseDynamics(row.motion, work, someLoad<Real50>())),
          promised)
          << nameOf(set);
    }
    EXPECT_GT(distance(fast.inverseDynamics(rounded(rows_[0].motion)), chain.inverseDynamics(rows_[3].motion, work)),
              1e-6);
  }
}

TEST_P(FastOf, allocatesNothing) {
  for (const InstructionSet set : supportedSets()) {
    const FastDynamics<double> fast(*scenario_.manipulator, set);
    const Motion<double> motion = rounded(rows_[2].motion);
    Vector6d efforts, rates;
    EXPECT_EQ(allocationsIn([&] { efforts = fast.inverseDynamics(motion); }), 0);
    EXPECT_EQ(allocationsIn([&] { rates = fast.directDynamics(motion, efforts); }), 0);
    EXPECT_GT(efforts.norm(), 0);
    EXPECT_GT(rates.norm(), 0);
  }
}

/// FastDynamics refuses the same impossible poses as Noc.
TEST_P(FastOf, refusesWhatTheRecursionRefuses) {
  const Noc<double> chain(*scenario_.manipulator);
  NocWorkspace<double> work;
  for (const InstructionSet set : supportedSets()) {
    const FastDynamics<double> fast(*scenario_.manipulator, set);
    SeededDraws dice(11);
    int refused = 0;
    for (int k = 0; k < 200; ++k) {
      Motion<double> motion = rounded(rows_[static_cast<std::size_t>(k) % rows_.size()].motion);
      for (int j = 0; j < 3; ++j) motion.p(j) += dice.between(-1, 1) * chain.machine().length;
      std::string by_chain, by_fast;
      try {
        chain.inverseDynamics(motion, work);
      } catch (const PoseError& error) {
        by_chain = error.what();
      }
      try {
        fast.inverseDynamics(motion);
      } catch (const PoseError& error) {
        by_fast = error.what();
      }
      refused += by_chain.empty() ? 0 : 1;
      EXPECT_EQ(by_fast.substr(0, 30), by_chain.substr(0, 30)) << nameOf(set);
    }
    EXPECT_GT(refused, 10);
  }
}

class BatchOf : public FastOf {
 protected:
  /// The rows' motions, repeated, with an unreachable motion at `bad`.
  std::vector<Motion<double>> motions(std::size_t count, std::size_t bad) const {
    std::vector<Motion<double>> out;
    for (std::size_t k = 0; k < count; ++k) out.push_back(rounded(rows_[k % rows_.size()].motion));
    if (bad < count) out[bad] = away(out[bad]);
    return out;
  }
};

TEST_P(BatchOf, givesWhatSinglePosesGive) {
  const FastDynamics<double> fast(*scenario_.manipulator);
  for (const InstructionSet set : supportedSets()) {
    const BatchDynamics batch(*scenario_.manipulator, set);
    for (const std::size_t count : {1u, 2u, 3u, 7u, 8u, 9u, 16u, 29u}) {
      const std::size_t bad = count / 2;
      const auto m = motions(count, bad);
      std::vector<Vector6d> loads(count, someLoad<double>()), efforts(count), rates(count);
      std::vector<PoseFault> faults(count, PoseFault::singular_jacobian);
      batch.inverseDynamics(m.data(), count, efforts.data(), faults.data(), loads.data());
      std::vector<Vector6d> other = efforts;
      for (Vector6d& each : other) each *= 1.1;
      batch.directDynamics(m.data(), other.data(), count, rates.data(), faults.data(), loads.data());
      for (std::size_t k = 0; k < count; ++k) {
        if (k == bad) {
          EXPECT_TRUE(faults[k] == PoseFault::out_of_reach || faults[k] == PoseFault::end_of_stroke) << nameOf(set);
          EXPECT_TRUE(efforts[k].array().isNaN().all() && rates[k].array().isNaN().all());
          continue;
        }
        EXPECT_EQ(faults[k], PoseFault::none) << nameOf(set) << ", pose " << k << " of " << count;
        EXPECT_LE(distance(efforts[k], fast.inverseDynamics(m[k], loads[k])), promised) << nameOf(set);
        EXPECT_LE(distance(rates[k], fast.directDynamics(m[k], other[k], loads[k])), 1e-9) << nameOf(set);
        EXPECT_GT(distance(efforts[k], fast.inverseDynamics(m[k])), 1e-9) << "the load is seen";
      }
    }
  }
}

/// The square of a velocity overflows: the pose is flagged, and Solver names its instant.
TEST_P(BatchOf, flagsWhatIsNotFinite) {
  const Solver<double> solver(*scenario_.manipulator);
  Workspace<double> work;
  auto m = motions(9, 9);
  m[4].p_dot.setConstant(1e200);
  m[4].t = 1.5;
  for (const InstructionSet set : supportedSets()) {
    const BatchDynamics batch(*scenario_.manipulator, set);
    std::vector<Vector6d> efforts(9), rates(9);
    std::vector<PoseFault> faults(9), direct_faults(9);
    batch.inverseDynamics(m.data(), 9, efforts.data(), faults.data());
    batch.directDynamics(m.data(), efforts.data(), 9, rates.data(), direct_faults.data());
    for (std::size_t k = 0; k < 9; ++k) {
      EXPECT_EQ(faults[k], k == 4 ? PoseFault::not_finite : PoseFault::none) << nameOf(set) << ", pose " << k;
      EXPECT_EQ(direct_faults[k], faults[k]) << nameOf(set) << ", pose " << k;
    }
    EXPECT_TRUE(efforts[4].array().isNaN().all() && rates[4].array().isNaN().all()) << nameOf(set);
  }
  EXPECT_THAT(
      [&] { solver.inverseDynamics(m[4], work); },
      testing::ThrowsMessage<std::domain_error>(testing::ContainsRegex("effort [1-6] = -?(inf|nan) at t = 1.5 s")));
  EXPECT_THAT([&] { solver.directDynamics(m[4], Vector6d::Zero(), work); },
              testing::ThrowsMessage<std::domain_error>(testing::HasSubstr("at t = 1.5 s, expected a finite number")));
  EXPECT_NO_THROW(solver.inverseDynamics(m[3], work));
}

TEST_P(BatchOf, andDerivativesOutliveAMove) {
  BatchDynamics batch(*scenario_.manipulator);
  EffortDerivatives derivatives(*scenario_.manipulator);
  const BatchDynamics to = std::move(batch);
  const EffortDerivatives there = std::move(derivatives);
  const auto m = motions(1, 1);
  Vector6d by_from, by_to;
  PoseFault fault = PoseFault::none;
  batch.inverseDynamics(m.data(), 1, &by_from,
                        &fault);  // NOLINT(bugprone-use-after-move): using it after the move is the point
  to.inverseDynamics(m.data(), 1, &by_to, &fault);
  EXPECT_EQ(by_from, by_to);
  EXPECT_EQ(derivatives.byState(m[0]).efforts, there.byState(m[0]).efforts);  // NOLINT(bugprone-use-after-move)
}

/// A pose's numbers do not depend on its place in a batch or on its neighbours.
TEST_P(BatchOf, numbersDoNotDependOnTheNeighbours) {
  for (const InstructionSet set : supportedSets()) {
    const BatchDynamics batch(*scenario_.manipulator, set);
    const auto m = motions(23, 5);
    std::vector<Vector6d> together(23), alone(23);
    std::vector<PoseFault> faults(23);
    batch.inverseDynamics(m.data(), 23, together.data(), faults.data());
    for (std::size_t k = 0; k < 23; ++k) batch.inverseDynamics(&m[k], 1, &alone[k], &faults[k]);
    EXPECT_EQ(std::memcmp(together.data(), alone.data(), sizeof(Vector6d) * 23), 0) << nameOf(set);
  }
}

TEST_P(BatchOf, flagsWhatSinglePosesRefuse) {
  const BatchDynamics one_by_one(*scenario_.manipulator, InstructionSet::portable);
  SeededDraws dice(5);
  std::vector<Motion<double>> m = motions(400, 400);
  for (Motion<double>& motion : m)
    for (int j = 0; j < 3; ++j)
      motion.p(j) += dice.between(-1, 1) * MachineParameters<double>(*scenario_.manipulator).length;
  std::vector<Vector6d> out(m.size());
  std::vector<PoseFault> expected(m.size()), found(m.size());
  one_by_one.inverseDynamics(m.data(), m.size(), out.data(), expected.data());
  ASSERT_THAT(expected, testing::Contains(testing::Ne(PoseFault::none)));
  for (const InstructionSet set : supportedSets()) {
    BatchDynamics(*scenario_.manipulator, set).inverseDynamics(m.data(), m.size(), out.data(), found.data());
    EXPECT_EQ(found, expected) << nameOf(set);
  }
}

INSTANTIATE_TEST_SUITE_P(All, FastOf, testing::ValuesIn(allNames()), byName);
INSTANTIATE_TEST_SUITE_P(All, BatchOf, testing::ValuesIn(allNames()), byName);

TEST(Batch, ofNothingDoesNothing) {
  const BatchDynamics batch(*vectorScenario("random-1").manipulator);
  batch.inverseDynamics(nullptr, 0, nullptr, nullptr);
  EXPECT_EQ(batch.instructionSet(), bestInstructionSet());
  EXPECT_TRUE(isSupported(bestInstructionSet()));
}

}  // namespace
}  // namespace ursula
