#pragma once

#include <optional>
#include <string>

#include "model/joint_variables.h"
#include "model/legs/leg_chain.h"
#include "model/manipulator.h"

namespace ursula {

/// The distance from a leg's base point to its platform point, and its parts along and across the base axis; m.
struct LegSpan {
  double distance, along, across;
};
/// Returns the span of AB over the unit axis û.
LegSpan spanOf(const Vector3d& u, const Vector3d& AB);

/// The distance that a leg must span and the range that its links can span, in m, with words for messages.
struct Reach {
  double distance, least, most;
  const char* before;  ///< "its base and platform points are"
  const char* after;   ///< "m apart, and its two links span"
};

/// A pose at which a leg's rates are undetermined: "is stretched straight", and a clause with the distance from it.
struct DeadCentre {
  std::string state, measure;
};

struct LinkLengths {
  double l, s;
};

/// Joints, geometry and words of one kind of leg, without mechanics; each kind has a file in this folder.
class LegType {
 public:
  LegType() = default;
  virtual ~LegType() = default;
  LegType(const LegType&) = delete;
  LegType& operator=(const LegType&) = delete;

  /// Returns the three joints, from the base to the tip.
  virtual LegJoints joints(const Leg& leg) const = 0;
  /// Returns what coordinatesAt() does, for a leg that can reach.
  virtual Vector3d coordinates(const Leg& leg, const Matrix3d& frame, const Vector3d& AB) const = 0;

  /// Returns the distance that the leg must span and what it can span.
  virtual Reach reach(const Leg& leg, const LegSpan& span) const = 0;

  /// Describes how near a pose is to the leg's dead centre; there the leg spans `reach`.
  virtual DeadCentre deadCentre(const Reach& reach) const;

  /// Returns leg i's margin from the end of its reach: zero there, with the opposite sign beyond.
  virtual double margin(const Leg& leg, const JointVariables<double>& q, int i) const = 0;
  /// Returns the name of that end: "stretched".
  virtual const char* endOfReach(const JointVariables<double>& q, int i) const = 0;

  /// Names the axis about which the first angle is measured, for the message about a platform point on it.
  virtual const char* firstAxis() const { return "axis of its motor"; }
  virtual const char* firstAngle() const { return "motor's"; }
  /// Returns the part that bends, and its state at a dead centre.
  virtual const char* bends() const { return "knee"; }
  virtual const char* atDeadCentre() const { return "straight or folded"; }

  /// Returns links that span `span` with `angle` at the knee or its equivalent (rad, 20° to 160°). `ratio` is l over s,
  /// or over the part of s across the axis.
  virtual LinkLengths lengths(const LegSpan& span, double angle, double ratio) const = 0;
  /// Returns whether the leg has two dead centres, folded and stretched; lengths() reaches them at 0 and 180°.
  virtual bool folds() const { return true; }
  /// Returns links within `angle` of the dead centre of a leg that does not fold; nullopt if it has none.
  virtual std::optional<LinkLengths> lengthsAtDeadCentre(const LegSpan& span, double angle) const;

 private:
  virtual const char* measuredFrom() const { return "apart"; }
};

inline const LegType& typeOf(LegKind kind) { return rowOf(kind).type(); }

/// Returns links of a telescopic leg that uses `share` (0 to 1) of its stroke at `distance`; l over s is `ratio`.
LinkLengths lengthsAtStroke(double distance, double share, double ratio);

/// Returns φ, and ψ of the line AB, of a universal joint at the base: the turn about −û from `frame`, then the angle
/// from û.
std::array<double, 2> directionOf(const Matrix3d& frame, const Vector3d& AB);

/// Returns 1 or −1, the sign that selects the leg's branch.
inline double sideOf(const Leg& leg) { return leg.knee == Knee::positive ? 1 : -1; }

/// Turns z to û, so that the second angle of a universal joint counts from û, and half a turn about x.
inline const Eigen::Quaterniond z_to_axis(1, -1, 0, 0), half_turn(0, 1, 0, 0);

/// Solves the triangle whose sides s·`ratio` and s enclose `angle` opposite `side`; returns s.
double sideOfTriangle(double side, double angle, double ratio);

}  // namespace ursula
