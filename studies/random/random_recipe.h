#pragma once

#include <string>
#include <vector>

#include "studies/random/random_kind.h"

// What a random scenario is to be like: drawn before any of its numbers, so that what is hard to meet is not drawn less
// often than it was asked for.

namespace ursula {

/// Where the legs stand: pairs as in the paper's Table I, six around a ring, three points shared by pairs on both sides
/// or on the platform alone, or no order at all.
enum class Arrangement { paper, ring, three_three, six_three, anywhere };
enum class Axes { tilted, radial, tangential, random };
/// Bodies of about one mass, the platform's and the links' apart, or each body's its own.
enum class Masses { even, apart, mixed };
enum class Inertias { solid, points, rods, laminae, mixed };
enum class GravityKind { none, tilted, up, sideways, down };
enum class MotionKind { helix, hold, waypoints, samples };
enum class Pace { even, tight, abrupt };
enum class LoadKind { none, constant, table, jumps };

struct Recipe {
  // units of the machine
  double length = 1;        ///< m
  double mass = 1;          ///< kg
  double acceleration = 1;  ///< m/s²: of gravity where there is any
  // machine
  RandomKind kind = RandomKind::URS;
  std::vector<LegRecipe> legs;
  Arrangement arrangement = Arrangement::paper;
  Axes axes = Axes::tilted;
  bool unequal_links = false;  ///< one link of a leg up to five times the other
  bool stroke_end = false;     ///< one or two telescopic legs nearly as short or as long as they can be
  bool far_zero = false;       ///< a carriage far from where its rail's zero is
  bool axis_along_z = false;   ///< of one leg, exactly or nearly: where the fixed frame takes another seed
  bool turned = false;         ///< the machine lies any way in B
  double offset = 0;           ///< of the machine from the origin of B, m
  double platform_offset = 0;  ///< of P from the platform's points, m
  Masses masses = Masses::even;
  bool centres_anywhere = false;  ///< mass centres of links at their ends and outside of them
  double platform_centre = 0;     ///< of the platform's mass from its points, m
  Inertias inertias = Inertias::solid;
  bool viscous = false, coulomb = false;
  // surroundings
  GravityKind gravity = GravityKind::down;
  LoadKind load = LoadKind::none;
  bool load_far = false;
  // motion
  MotionKind motion = MotionKind::helix;
  Pace pace = Pace::even;
  bool noisy = false;
  bool near_singular = false;
  double duration = 1;  ///< s

  std::vector<std::string> unusual;  ///< what is, in words

  /// The time in which `acceleration` moves about `length`, s.
  double time() const { return std::sqrt(length / acceleration); }
  /// Units, layout and what is unusual.
  std::string text() const;
  /// The largest κ(B) κ(legs) kept.
  double largestKappa() const;
};

Recipe randomRecipe(Dice& dice, RandomKind kind);

}  // namespace ursula
