#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "parts/exchange/recognise/chains.h"
#include "parts/exchange/recognise/machine.h"

namespace ursula::exchange {

/// The crosses within a universal joint or a ball: bodies that belong to a joint and are no links.
struct Cross {
  std::size_t group = 0;
  enum class Rides { base, proximal, platform } rides = Rides::base;  ///< the body that gets its mass
  Vector3d centre = Vector3d::Zero();
};

/// Assumptions of a smaller size, relative to the machine or in rad, are rounding of a file's digits and not reported.
constexpr double worth_saying = 1e-9;

/// A recognised chain: three single-axis joints and a ball.
struct LegShape {
  LegKind kind = LegKind::UPS;
  std::string place;  ///< its joints, for messages
  /// The joints of the three coordinates, then the ball on the platform. A ball in place of the universal joint takes
  /// one place instead of two.
  std::vector<Primitive> joints;
  std::optional<std::size_t> inner_ball;      ///< index in `joints` of that ball, if the rod is free to spin
  std::vector<std::size_t> proximal, distal;  ///< groups
  std::vector<std::size_t> spinning;          ///< groups among them that spin alone about the line on a hinge
  std::vector<Cross> crosses;
  Assumptions assumptions;  ///< the used part of the tolerance

  /// Returns the index in `joints` of one of the kind's coordinates. Returns nothing if the inner ball replaces it.
  std::optional<std::size_t> jointOf(std::size_t coordinate) const;
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

double largestMoment(const Matrix3d& inertia);

/// The point that is nearest to the axes of three hinges.
struct HingePoint {
  Vector3d at = Vector3d::Zero();
  double off = 0;    ///< the largest distance of the point from an axis, m
  double apart = 0;  ///< the largest distance between two of the axes, m
};
/// Returns nothing unless all three are hinges whose axes are in no plane.
std::optional<HingePoint> hingePoint(const Primitive* three);

/// Input for the numbers of a leg.
struct LegTask {
  const ModelGraph& graph;
  const Groups& groups;
  const LegShape& shape;
  const ImportChoices& choices;
  double size;                 ///< size of the machine, m
  Eigen::Isometry3d base;      ///< B in the world
  Eigen::Isometry3d platform;  ///< M in the world
  Group& of_platform;          ///< gets the masses of crosses on it
  Assumptions& assumptions;
};

/// Returns the leg in the scenario's terms, measured on its own bodies at the initial pose. Throws ImportError if it
/// lacks the geometry of its kind.
ImportedLeg legOf(const LegTask& task);

/// Copies friction, motors and rotors to the coordinates of a leg. The scenario's coordinates grow about or along the
/// axes `grows_along`, in the world; says where a motor's coordinate in the file grows the other way. Throws
/// ImportError for a rotor without a motor.
void takeLegDynamics(const LegTask& task, const std::array<Vector3d, 3>& grows_along, ImportedLeg& leg);

/// The lengths of a telescopic leg between which it may move, m.
struct Stroke {
  double least = 0, most = 0;
  bool from_file = false;  ///< else a third of the leg's length either way
};

/// Reads the stroke from a slide's limits. The leg's line is `along`, its length at the initial pose is `length`.
Stroke strokeOf(const LegTask& task, const Primitive& slide, const Vector3d& along, double length);

/// Returns a physically possible tensor if only the rounding of the file's digits makes it impossible. With
/// `line_may_be_zero` the third entry may be zero. Throws ImportError for larger errors.
Matrix3d snapped(const Matrix3d& inertia, bool line_may_be_zero, const Group& body, Assumptions& assumptions);

/// Combines bodies into one link. `frame` is in the world, with its origin at the first end of the link. Its axis
/// number `line` lies along the link.
Link linkOf(const LegTask& task, const Group& link, const Eigen::Isometry3d& frame, int line, double length,
            bool line_may_be_zero);

/// Makes `link` exactly round with `keep_moment`, as `spin = "free"` asks; else removes from it the moment about the
/// line of a freely spinning body, at zero rate. Throws ImportError if that changes the dynamics: unequal transverse
/// moments, a mass centre off the line.
void freeSpin(const LegTask& task, const Group& body, const Eigen::Isometry3d& frame, bool keep_moment, Link& link);

/// Reports what is lost with the tensors of the joints' crosses, as a share of the leg's moments. Adds their masses to
/// the bodies that they ride on.
void lumpCrosses(const LegTask& task, const Vector3d& base_point, Group& proximal, const Group& distal);

}  // namespace ursula::exchange
