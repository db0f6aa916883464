#pragma once

#include <optional>
#include <string>

#include "model/joint_variables.h"
#include "model/manipulator.h"

namespace ursula {

/// From a leg's base point to its platform point, m: the distance, and what of it lies along the base axis and across.
struct LegSpan {
  double distance, along, across;
};

/// A distance that a leg has to bridge, and what its links can, m; with the words around them.
struct Reach {
  double distance, least, most;
  const char* before;  ///< "its base and platform points are"
  const char* after;   ///< "m apart, and its two links span"
};

/// Where a leg's speed is not determined: "is stretched straight", and a clause that says how near it is.
struct DeadCentre {
  std::string state, measure;
};

struct LinkLengths {
  double l, s;
};

/// All that a kind of leg can say of itself and that is no mechanics: a file of this folder for each.
class LegType {
 public:
  LegType() = default;
  virtual ~LegType() = default;
  LegType(const LegType&) = delete;
  LegType& operator=(const LegType&) = delete;

  /// What the leg has to bridge.
  virtual Reach reach(const Leg& leg, const LegSpan& span) const = 0;

  /// Says how near a pose is to the leg's dead centre. The leg bridges `reach` there.
  virtual DeadCentre deadCentre(const Reach& reach) const;

  /// How far leg i is from the end of its reach: zero there, and of another sign beyond.
  virtual double margin(const Leg& leg, const JointVariables<double>& q, int i) const = 0;
  /// Which end that is: "stretched".
  virtual const char* endOfReach(const JointVariables<double>& q, int i) const = 0;

  /// What the first angle is counted about, and whose angle that is, where the platform point lies on it.
  virtual const char* firstAxis() const { return "axis of its motor"; }
  virtual const char* firstAngle() const { return "motor's"; }
  /// What bends at a dead centre, and how it then lies.
  virtual const char* bends() const { return "knee"; }
  virtual const char* atDeadCentre() const { return "straight or folded"; }

  /// Links that bridge the span with `angle` (rad, 20° to 160°) at the knee, or with what the kind has instead; l over
  /// s, or over what s has across the axis, is `ratio`.
  virtual LinkLengths lengths(const LegSpan& span, double angle, double ratio) const = 0;
  /// Whether the leg has two dead centres, folded and stretched, which lengths() reaches at 0 and 180°.
  virtual bool folds() const { return true; }
  /// Where it does not fold: links within `angle` of its dead centre; none where it has none.
  virtual std::optional<LinkLengths> lengthsAtDeadCentre(const LegSpan& span, double angle) const;

 private:
  virtual const char* measuredFrom() const { return "apart"; }
};

const LegType& typeOf(LegKind kind);

/// Links of a telescopic leg that uses `share` (0 to 1) of its stroke over the distance; l over s is `ratio`.
LinkLengths lengthsAtStroke(double distance, double share, double ratio);

/// Far side of a triangle with `angle` between sides `ratio` and 1, over which `side` is to be: the length of side 1.
double sideOfTriangle(double side, double angle, double ratio);

/// What there is of each kind, in urs.cpp and so on.
const LegType& ursLeg();
const LegType& upsLeg();
const LegType& rusLeg();
const LegType& pusLeg();

}  // namespace ursula
