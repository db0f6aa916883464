#pragma once

#include <array>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/simulation/World.hpp>
#include <vector>

#include "parts/engines/engine_machine.h"

namespace ursula::dart_engine {

struct DartLeg {
  std::array<dart::dynamics::Joint*, 2> joints{};
  dart::dynamics::BodyNode* distal = nullptr;
  Vector3d tip;  ///< the leg's point on the distal link, in its body's frame

  /// Returns the joint of the leg's j-th coordinate, and the coordinate's index in that joint.
  std::pair<dart::dynamics::Joint*, std::size_t> place(int j) const {
    const std::size_t at = j, first = joints[0]->getNumDofs();
    return at < first ? std::pair{joints[0], at} : std::pair{joints[1], at - first};
  }
};

/// One skeleton of open legs and a free platform. DART expresses the platform's twist and twist rate in the body's
/// axes, [ω; v].
class DartMachine : public EngineMachine {
 public:
  explicit DartMachine(const Manipulator& from);

  /// Sets platform and legs to the motion. Coordinates come from vector geometry and Newton's method on DART's gaps.
  /// Rates and accelerations come from its Jacobians and accelerations of points. Without `with_bias` the accelerations
  /// lack J̇ u. Throws std::domain_error if a leg cannot reach.
  void move(const Motion<double>& motion, bool with_bias);

  /// Closes the loops where they are by ball constraints of a world, whose steps are semi-implicit. Throws
  /// std::runtime_error if the legs have no mass.
  void close(const Rigidity& rigidity);

  double coordinate(int leg, int j) const override;
  double rate(int leg, int j) const override;
  ChainBody platformBody() const override;
  double energy() override;
  void readMaps(PlacedTree& out) override;
  void addEffort(int leg, int j, double effort) override;
  void addWrench(const Vector6d& moment_and_force) override;
  void step(double h) override;

  dart::dynamics::SkeletonPtr skeleton;
  std::vector<DartLeg> legs;
  dart::dynamics::FreeJoint* free = nullptr;
  dart::dynamics::BodyNode* platform = nullptr;

 private:
  void addLeg(const Leg& leg, const std::string& index);
  void chooseUnit();

  dart::simulation::WorldPtr world_;  ///< null while the loops are open
  Rigidity rigidity_;
  double unit_ = 1;  ///< factor on masses and forces, 1/kg
};

}  // namespace ursula::dart_engine
