// A batch on several threads equals the batch on one, to the last bit.

#include "parts/fast/threaded_batch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cstring>
#include <vector>

#include "tests/support/allocation_counter.h"
#include "tests/support/vectors.h"

namespace ursula {
namespace {

constexpr std::size_t count = 20011;  // no multiple of a thread's share or of a register's lanes

class ThreadedBatch : public testing::TestWithParam<std::string> {
 protected:
  ThreadedBatch() : scenario_(vectorScenario(GetParam())), batch_(*scenario_.manipulator) {
    const double duration = scenario_.trajectory->duration();
    for (std::size_t k = 0; k < count; ++k) {
      motions_.push_back(scenario_.trajectory->at(duration * static_cast<double>(k) / (count - 1)));
      loads_.push_back(Vector6d::Constant(static_cast<double>(k % 17)));
    }
    for (const std::size_t far : {std::size_t{777}, count - 1}) motions_[far].p *= 100;
  }

  bool same(const std::vector<Vector6d>& a, const std::vector<Vector6d>& b) const {
    return std::memcmp(a.data(), b.data(), sizeof(Vector6d) * count) == 0;
  }

  tbb::global_control threads_{tbb::global_control::max_allowed_parallelism, 8};  // more threads than the processor has
  Scenario scenario_;
  BatchDynamics batch_;
  std::vector<Motion<double>> motions_;
  std::vector<Vector6d> loads_;
};

TEST_P(ThreadedBatch, isTheBatchForAnyNumberOfThreads) {
  std::vector<Vector6d> efforts(count), rates(count), efforts_by(count), rates_by(count);
  std::vector<PoseFault> faults(count), faults_by(count);
  batch_.inverseDynamics(motions_.data(), count, efforts.data(), faults.data(), loads_.data());
  std::vector<Vector6d> other = efforts;
  for (Vector6d& each : other) each *= 1.1;
  batch_.directDynamics(motions_.data(), other.data(), count, rates.data(), faults.data(), loads_.data());
  EXPECT_NE(faults[777], PoseFault::none);
  EXPECT_NE(faults.back(), PoseFault::none);
  EXPECT_EQ(faults[778], PoseFault::none);
  for (const int jobs : {0, 1, 2, 7}) {
    faults_by.assign(count, PoseFault::stretched_leg);
    inverseDynamics(batch_, motions_.data(), count, efforts_by.data(), faults_by.data(), loads_.data(), jobs);
    EXPECT_TRUE(same(efforts_by, efforts)) << jobs;
    EXPECT_EQ(faults_by, faults) << jobs;
    directDynamics(batch_, motions_.data(), other.data(), count, rates_by.data(), faults_by.data(), loads_.data(),
                   jobs);
    EXPECT_TRUE(same(rates_by, rates)) << jobs;
    EXPECT_EQ(faults_by, faults) << jobs;
  }
  EXPECT_FALSE(same(efforts, other)) << "what differs is seen";
  inverseDynamics(batch_, motions_.data(), count, efforts_by.data(), faults_by.data(), nullptr, 2);
  EXPECT_FALSE(same(efforts_by, efforts)) << "the load is seen";
}

/// TBB itself may allocate, so the test has few poses, or one job, for which TBB is not used.
TEST_P(ThreadedBatch, allocatesNothingItself) {
  std::vector<Vector6d> efforts(count);
  std::vector<PoseFault> faults(count);
  EXPECT_EQ(allocationsIn([&] { inverseDynamics(batch_, motions_.data(), 300, efforts.data(), faults.data()); }), 0);
  EXPECT_EQ(allocationsIn(
                [&] { inverseDynamics(batch_, motions_.data(), count, efforts.data(), faults.data(), nullptr, 1); }),
            0);
  EXPECT_GT(efforts[0].norm(), 0);
}

INSTANTIATE_TEST_SUITE_P(All, ThreadedBatch, testing::Values("random-2", "kind-mixture"),
                         [](const auto& name) { return std::string(name.index == 0 ? "ofThePaper" : "mixed"); });

}  // namespace
}  // namespace ursula
