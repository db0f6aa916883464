#pragma once

#include <array>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/simulation/World.hpp>
#include <vector>

#include "parts/engines/leg_motion.h"
#include "parts/engines/loop_engine.h"

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

/// One skeleton of open legs and a free platform, without rotors, friction and loads; in B, SI. DART expresses the
/// platform's twist and twist rate in the body's axes, [ω; v]. Efforts and wrenches add up until the next step.
class DartMachine {
 public:
  explicit DartMachine(const Manipulator& from);

  /// Sets platform and legs to the motion. Coordinates come from vector geometry and Newton's method on DART's gaps.
  /// Rates and accelerations come from its Jacobians and accelerations of points. Without `with_bias` the accelerations
  /// lack J̇ u. Throws std::domain_error if a leg cannot reach.
  void move(const Motion<double>& motion, bool with_bias);

  /// Closes the loops where they are by ball constraints of a world, whose steps are semi-implicit. Throws
  /// std::runtime_error if the legs have no mass.
  void close(const Rigidity& rigidity);

  double coordinate(int leg, int j) const;
  Vector3d friction(int leg) const { return frictionOn(manipulator.leg(leg), rates(leg)); }
  double energy();  ///< kinetic and potential, J
  void readMaps(PlacedTree& out);
  void addEffort(int leg, int j, double effort);
  void addFrictionAndLoad(const Load* load, double t);
  double powerOfFrictionAndLoad(const Load* load, double t) const;  ///< W
  /// Throws std::runtime_error if the engine gives up.
  void step();

  Manipulator manipulator;
  dart::dynamics::SkeletonPtr skeleton;
  std::vector<DartLeg> legs;
  dart::dynamics::FreeJoint* free = nullptr;
  dart::dynamics::BodyNode* platform = nullptr;

 private:
  void addLeg(const Leg& leg, const std::string& index);
  void chooseUnit();
  Vector3d rates(int leg) const;

  dart::simulation::WorldPtr world_;  ///< null while the loops are open
  Rigidity rigidity_;
  double unit_ = 1;  ///< factor on masses and forces, 1/kg
};

}  // namespace ursula::dart_engine
