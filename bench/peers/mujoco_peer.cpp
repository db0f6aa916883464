#include "bench/peers/peer.h"
#include "parts/engines/closing.h"
#include "parts/engines/mujoco/mujoco_loop.h"

namespace ursula::bench {
namespace {

class MujocoPeer : public Peer {
 public:
  explicit MujocoPeer(const Manipulator& manipulator) : manipulator_(manipulator), loop_(manipulator) {}

  std::string name() const override { return "MuJoCo"; }
  std::string version() const override { return mujocoVersion(); }

  void coordinates(const Motion<double>& motion, const JointMotion& joints, TreeCoordinates& out) const override {
    loop_.coordinates(motion, joints, out);
  }
  Vector6d inverseDynamics(const TreeCoordinates& at) override {
    loop_.openTree(at, tree_);
    return closedEfforts(tree_, manipulator_);
  }
  Vector6d directDynamics(const TreeCoordinates& at, const Vector6d& efforts) override {
    loop_.openTree(at, tree_, masses_);
    return loop_.twistRate(at, closedRates(tree_, masses_, manipulator_, efforts));
  }

 protected:
  Manipulator manipulator_;
  MujocoLoop loop_;
  OpenTree tree_;
  OpenTreeMasses masses_;
};

class SoftMujocoPeer : public MujocoPeer {
 public:
  using MujocoPeer::MujocoPeer;

  std::string name() const override { return "MuJoCo, soft"; }
  bool hasInverse() const override { return false; }
  Vector6d directDynamics(const TreeCoordinates& at, const Vector6d& efforts) override {
    return loop_.softTwistRate(at, efforts);
  }

  /// Compares the loop closed exactly, with J̇ q̇ and without.
  Deviation deviation(const TreeCoordinates& at, const Vector6d& efforts) override {
    loop_.openTree(at, tree_, masses_);
    const Vector6d with = closedRates(tree_, masses_, manipulator_, efforts);
    for (Vector3d& drift : masses_.drift) drift.setZero();
    const Vector6d without = closedRates(tree_, masses_, manipulator_, efforts);
    const Vector6d change = changeOfRates(tree_, masses_, manipulator_, efforts, 1 - MujocoLoop::softImpedance());
    return {loop_.twistRate(at, without) - loop_.twistRate(at, with), change};
  }
};

}  // namespace

std::unique_ptr<Peer> makeMujocoPeer(const Manipulator& manipulator) {
  return mujocoAvailable() ? std::make_unique<MujocoPeer>(manipulator) : nullptr;
}

std::unique_ptr<Peer> makeSoftMujocoPeer(const Manipulator& manipulator) {
  return mujocoAvailable() ? std::make_unique<SoftMujocoPeer>(manipulator) : nullptr;
}

}  // namespace ursula::bench
