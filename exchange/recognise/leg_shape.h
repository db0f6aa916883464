#pragma once

#include <string>
#include <vector>

#include "exchange/recognise/chains.h"
#include "model/leg_kind.h"

namespace ursula::exchange {

/// What stands for a joint without being a link: the crosses within a universal joint or a ball.
struct Cross {
  std::size_t group = 0;
  enum class Rides { base, proximal, platform } rides = Rides::base;  ///< where its mass goes
  Vector3d centre = Vector3d::Zero();
};

/// What is less, of the machine's size or rad, is rounding of a file's digits, and no word is lost on it.
constexpr double worth_saying = 1e-9;

/// A chain that is known: three freedoms and a ball.
struct LegShape {
  LegKind kind = LegKind::UPS;
  std::string place;  ///< its joints, for messages
  std::vector<Primitive>
      joints;                  ///< three of the kind's coordinates, then the ball; of a free rod the ball counts once
  std::size_t inner_ball = 0;  ///< where a ball stands for the universal joint: its index in `joints`
  bool has_inner_ball = false;
  std::vector<std::size_t> proximal, distal;  ///< groups
  std::vector<std::size_t> spinning;  ///< of those, the ones that a hinge along the line lets spin by themselves
  std::vector<Cross> crosses;
  std::vector<Assumption> assumptions;  ///< what of the tolerance was used
};

/// Finds the universal and ball joints among the primitives. `size` is the machine's, m. Throws ImportError with what
/// was found instead, distances and angles.
LegShape shapeOf(const ModelGraph& graph, const Groups& groups, const Chain& chain, double size,
                 const ImportChoices& choices);

/// Where two lines are nearest, in the middle, and how far they are apart there.
struct Meeting {
  Vector3d at = Vector3d::Zero();
  double apart = 0;
  double angle = 0;  ///< between them, rad, in [0, π/2]
};
Meeting meetingOf(const Vector3d& p, const Vector3d& along_p, const Vector3d& q, const Vector3d& along_q);

}  // namespace ursula::exchange
