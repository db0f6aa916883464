#pragma once

#include <string>
#include <vector>

#include "exchange/recognise/chains.h"
#include "model/leg_kind.h"

namespace ursula::exchange {

/// The crosses within a universal joint or a ball: bodies that belong to a joint and are no links.
struct Cross {
  std::size_t group = 0;
  enum class Rides { base, proximal, platform } rides = Rides::base;  ///< the body that gets its mass
  Vector3d centre = Vector3d::Zero();
};

/// Smaller values, relative to the machine's size or in rad, are rounding of a file's digits and not reported.
constexpr double worth_saying = 1e-9;

/// A recognised chain: three single-axis joints and a ball.
struct LegShape {
  LegKind kind = LegKind::UPS;
  std::string place;  ///< its joints, for messages
  std::vector<Primitive>
      joints;                  ///< the three coordinates of the kind, then the ball; the balls of a free rod count once
  std::size_t inner_ball = 0;  ///< index in `joints` of a ball that replaces the universal joint
  bool has_inner_ball = false;
  std::vector<std::size_t> proximal, distal;  ///< groups
  std::vector<std::size_t> spinning;          ///< groups among them that spin alone about the line on a hinge
  std::vector<Cross> crosses;
  std::vector<Assumption> assumptions;  ///< the used part of the tolerance
};

/// Finds the universal and ball joints among the primitives. `size` is the machine's, m. Throws ImportError with the
/// joints found instead, and their distances and angles.
LegShape shapeOf(const ModelGraph& graph, const Groups& groups, const Chain& chain, double size,
                 const ImportChoices& choices);

/// The midpoint where two lines are nearest, and their distance there.
struct CommonPerpendicular {
  Vector3d at = Vector3d::Zero();
  double apart = 0;
  double angle = 0;  ///< angle between the lines, rad, in [0, π/2]
};
CommonPerpendicular commonPerpendicular(const Vector3d& p, const Vector3d& along_p, const Vector3d& q,
                                        const Vector3d& along_q);

}  // namespace ursula::exchange
