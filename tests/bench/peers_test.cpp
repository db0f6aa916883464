// Compares the benchmarks' peers with the paper's equations, on the timed machines and on legs of other kinds. A peer
// with a wrong parameter or wrong efforts must not agree.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "bench/peers/agreement.h"
#include "parts/engines/mujoco/mujoco_loop.h"

namespace ursula::bench {
namespace {

using testing::AllOf, testing::Each, testing::Not, testing::SizeIs;

MATCHER(Holds, "agrees") {
  *result_listener << toText(arg);
  return arg.holds();
}

TEST(Peers, agreeOnThePapersHelix) {
  const auto peers = makePeers(helix().manipulator());
  const std::size_t expected = 2 + (mujocoAvailable() ? 3 : 0) + (dartAvailable() ? 2 : 0);
  EXPECT_THAT(agreementsOf(peers, helix()), AllOf(SizeIs(expected), Each(Holds())));
  EXPECT_THAT(missingPeers(), SizeIs((mujocoAvailable() ? 0 : 1) + (dartAvailable() ? 0 : 1)));
}

class PeersOnKinds : public testing::TestWithParam<const char*> {};

TEST_P(PeersOnKinds, agree) {
  const Poses poses(GetParam());
  std::vector<std::unique_ptr<Peer>> peers;
  for (const auto make : {makeSimbodyPeer, makeMujocoPeer, makeSoftMujocoPeer})
    if (auto peer = make(poses.manipulator())) peers.push_back(std::move(peer));
  EXPECT_THAT(agreementsOf(peers, poses), AllOf(SizeIs(mujocoAvailable() ? 5 : 2), Each(Holds())));
}

INSTANTIATE_TEST_SUITE_P(Shipped, PeersOnKinds,
                         testing::Values("flight-simulator", "hexa", "hexaglide", "mixture", "three-legs"),
                         [](const auto& instance) {
                           std::string name = instance.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

/// Expects as many agreements as `peers` have, none of which holds.
void expectNoneAgrees(const Manipulator& wrong) {
  for (const std::unique_ptr<Peer>& peer : makePeers(wrong)) {
    const auto found = agreementsOf(answersOf(*peer, helix()), helix());
    EXPECT_THAT(found, AllOf(SizeIs(peer->hasInverse() ? 2 : 1), Each(Not(Holds()))));
  }
}

ManipulatorParameters ofTheHelix() { return helix().manipulator().parameters(); }

/// The platform is so much heavier that even the softest peer shows it, which yields by some hundredths of an
/// acceleration.
TEST(Peers, withAHeavierPlatformDoNotAgree) {
  ManipulatorParameters wrong = ofTheHelix();
  wrong.platform.mass *= 1.01;
  expectNoneAgrees(Manipulator(wrong));
}

TEST(Peers, withFrictionDoNotAgree) {
  ManipulatorParameters wrong = ofTheHelix();
  for (Leg& leg : wrong.legs) {
    leg.friction.phi = 500;
    leg.coulomb.theta = 500;
  }
  expectNoneAgrees(Manipulator(wrong));
}

TEST(Peers, withAPointSlightlyOffDoNotAgree) {
  ManipulatorParameters wrong = ofTheHelix();
  wrong.legs[2].distal.center_of_mass += 1e-8;
  for (const auto make : {makeSimbodyPeer, makeMujocoPeer, makeDartPeer})
    if (const auto peer = make(Manipulator(wrong))) {
      EXPECT_THAT(agreementsOf(answersOf(*peer, helix()), helix()), AllOf(SizeIs(2), Each(Not(Holds()))));
    }
}

/// MuJoCo's own constraints agree only after correction by the term that they are said to leave out.
TEST(Peers, softConstraintsLeaveOutWhatIsSaid) {
  const auto peer = makeSoftMujocoPeer(helix().manipulator());
  if (!peer) GTEST_SKIP() << "MuJoCo is not installed";
  Answers answers = answersOf(*peer, helix());
  EXPECT_THAT(agreementsOf(answers, helix()), AllOf(SizeIs(1), Each(Holds())));
  for (Peer::Deviation& known : answers.known) known.left_out.setZero();
  EXPECT_THAT(agreementsOf(answers, helix()), AllOf(SizeIs(1), Each(Not(Holds()))));
}

TEST(Agreement, isNotHadFromAnswersThatAreNoNumbersOrTooFew) {
  Answers answers{"somebody", helix().efforts, {}, {}};
  EXPECT_THAT(agreementsOf(answers, helix()), AllOf(SizeIs(1), Each(Holds())));
  answers.efforts[5](3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(agreementsOf(answers, helix()), AllOf(SizeIs(1), Each(Not(Holds()))));
  answers.efforts[5] = helix().efforts[5] * (1 + 1e-11);
  EXPECT_THAT(agreementsOf(answers, helix()), AllOf(SizeIs(1), Each(Not(Holds()))));
  answers.efforts.pop_back();
  EXPECT_THROW(agreementsOf(answers, helix()), std::invalid_argument);
}

TEST(DartPeer, refusesLegsThatItDoesNotKnow) {
  if (!dartAvailable()) GTEST_SKIP() << "DART is not installed";
  EXPECT_THROW(makeDartPeer(Poses("hexa").manipulator()), std::invalid_argument);
  EXPECT_THROW(makeDartPeer(Poses("three-legs").manipulator()), std::invalid_argument);
}

}  // namespace
}  // namespace ursula::bench
