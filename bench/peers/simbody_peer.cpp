#include "base/provenance.h"
#include "bench/peers/peer.h"
#include "parts/engines/closing.h"
#include "simbody/simbody_loop.h"

namespace ursula::bench {
namespace {

class SimbodyPeer : public Peer {
 public:
  explicit SimbodyPeer(const Manipulator& manipulator) : manipulator_(manipulator), loop_(manipulator) {}

  std::string name() const override { return "Simbody"; }
  std::string version() const override { return buildProvenance().simbody; }

  void coordinates(const Motion<double>& motion, const JointMotion& joints, TreeCoordinates& out) const override {
    loop_.coordinates(motion, joints, out);
  }
  Vector6d inverseDynamics(const TreeCoordinates& at) override {
    loop_.openTree(at, tree_);
    return closedEfforts(tree_, manipulator_);
  }
  Vector6d directDynamics(const TreeCoordinates& at, const Vector6d& efforts) override {
    return loop_.twistRate(at, efforts);
  }

 private:
  Manipulator manipulator_;
  SimbodyLoop loop_;
  OpenTree tree_;
};

}  // namespace

std::unique_ptr<Peer> makeSimbodyPeer(const Manipulator& manipulator) {
  return std::make_unique<SimbodyPeer>(manipulator);
}

}  // namespace ursula::bench
