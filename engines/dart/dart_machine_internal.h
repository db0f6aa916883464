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
  Vector3d tip;  ///< on the distal link, in its body's frame

  /// Which joint has the leg's j-th coordinate, and which of its own that is.
  std::pair<dart::dynamics::Joint*, std::size_t> place(std::size_t j) const {
    const std::size_t first = joints[0]->getNumDofs();
    return j < first ? std::pair{joints[0], j} : std::pair{joints[1], j - first};
  }
};

/// One skeleton of open legs and a free platform, whose twist and twist rate DART has in the body's axes, [ω; v].
struct DartMachine {
  explicit DartMachine(const Manipulator& from);

  /// Puts platform and legs into the motion: coordinates by vector geometry and Newton's method on DART's gaps, rates
  /// and accelerations by its Jacobians and accelerations of points; with J̇ u left out of these unless `with_bias`.
  /// Throws std::domain_error where a leg cannot reach.
  void move(const Motion<double>& motion, bool with_bias);
  /// J, P and the gaps, in B.
  void readMaps(PlacedTree& out) const;
  /// Friction of a leg's three coordinates, as it acts.
  Vector3d friction(int leg) const;

  Manipulator manipulator;
  dart::dynamics::SkeletonPtr skeleton;
  std::vector<DartLeg> legs;
  dart::dynamics::FreeJoint* free = nullptr;
  dart::dynamics::BodyNode* platform = nullptr;

 private:
  void addLeg(const Leg& leg, const std::string& index);
};

/// A leg's coordinates for B at `k` from A in the frame [x̂, û, ẑ], to some digits. Throws std::domain_error.
Vector3d legCoordinates(const Leg& leg, int index, const Vector3d& k);
/// [x̂, û, ẑ] with x̂ level.
Matrix3d fixedFrame(const Leg& leg);

}  // namespace ursula::dart_engine
