#pragma once

#include <array>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <vector>

#include "engines/loop_engine.h"
#include "model/manipulator.h"

namespace ursula::dart_engine {

struct DartLeg {
  std::array<dart::dynamics::Joint*, 2> joints{};
  dart::dynamics::BodyNode* distal = nullptr;
  Vector3d tip;  ///< the leg's point on the distal link, in its body's frame

  /// Returns the joint of the leg's j-th coordinate, and the coordinate's index in that joint.
  std::pair<dart::dynamics::Joint*, std::size_t> place(std::size_t j) const {
    const std::size_t first = joints[0]->getNumDofs();
    return j < first ? std::pair{joints[0], j} : std::pair{joints[1], j - first};
  }
};

/// One skeleton of open legs and a free platform. DART expresses the platform's twist and twist rate in the body's
/// axes, [ω; v].
struct DartMachine {
  explicit DartMachine(const Manipulator& from);

  /// Sets platform and legs to the motion. Coordinates come from vector geometry and Newton's method on DART's gaps.
  /// Rates and accelerations come from its Jacobians and accelerations of points. Without `with_bias` the accelerations
  /// lack J̇ u. Throws std::domain_error if a leg cannot reach.
  void move(const Motion<double>& motion, bool with_bias);
  /// Reads J, P and the gaps, in B.
  void readMaps(PlacedTree& out) const;
  /// Returns the friction forces that act on a leg's three coordinates.
  Vector3d friction(int leg) const;

  Manipulator manipulator;
  dart::dynamics::SkeletonPtr skeleton;
  std::vector<DartLeg> legs;
  dart::dynamics::FreeJoint* free = nullptr;
  dart::dynamics::BodyNode* platform = nullptr;

 private:
  void addLeg(const Leg& leg, const std::string& index);
};

}  // namespace ursula::dart_engine
