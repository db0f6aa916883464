#pragma once

#include <array>
#include <string>
#include <vector>

#include "model/manipulator.h"
#include "parts/random/dice.h"

namespace ursula {

/// The legs of a random machine: six of one kind; four to six of any kinds; three to five, some with two or three
/// motors. All kinds except URS may drive any of a leg's coordinates.
enum class RandomKind { URS, UPS, RUS, PUS, mixture, two_motors };
inline constexpr std::array<const char*, 6> random_kind_names = {"URS", "UPS", "RUS", "PUS", "mixture", "two-motors"};

constexpr const char* nameOf(RandomKind kind) { return random_kind_names[static_cast<std::size_t>(kind)]; }

/// The arrangement of the legs: pairs as in the paper's Table I, six around a ring, or no order. In 3-3 pairs share
/// points on both sides, in 6-3 only on the platform.
enum class Arrangement { paper, ring, three_three, six_three, anywhere };
enum class Axes { tilted, radial, tangential, random };
/// Bodies of about equal mass, the platform's and the links' masses apart, or every mass independent.
enum class Masses { even, apart, mixed };
enum class Inertias { solid, points, rods, laminae, mixed };
enum class GravityKind { none, tilted, up, sideways, down };
enum class MotionKind { helix, hold, waypoints, samples };
enum class Pace { even, tight, abrupt };
enum class LoadKind { none, constant, table, jumps };

/// The properties of a random scenario. They are drawn before its numbers, so properties that are hard to satisfy are
/// not drawn less often.
struct RandomRecipe {
  // units of the machine
  double length = 1;        ///< m
  double mass = 1;          ///< kg
  double acceleration = 1;  ///< m/s²: that of gravity, if there is any
  // machine
  RandomKind kind = RandomKind::URS;
  std::vector<Leg> legs;  ///< only their kinds and motors
  Arrangement arrangement = Arrangement::paper;
  Axes axes = Axes::tilted;
  bool unequal_links = false;  ///< one link of a leg is up to five times the other
  bool stroke_end = false;     ///< one or two telescopic legs are nearly as short or as long as possible
  bool far_zero = false;       ///< a carriage is far from its rail's zero
  bool axis_along_z = false;   ///< one leg's axis lies along e_z, exactly or nearly; its fixed frame then uses e_y
  bool turned = false;         ///< the machine has any orientation in B
  double offset = 0;           ///< distance of the machine from the origin of B, m
  double platform_offset = 0;  ///< distance of P from the platform's points, m
  Masses masses = Masses::even;
  bool centres_anywhere = false;  ///< mass centres of links may be at their ends or outside them
  double platform_centre = 0;     ///< distance of the platform's mass centre from its points, m
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

  std::vector<std::string> unusual;  ///< the unusual properties, in words

  /// The time in which `acceleration` moves something by about `length`, s.
  double time() const { return std::sqrt(length / acceleration); }
  /// Units, layout and the unusual properties.
  std::string text() const;
  /// The largest accepted κ(B) κ(legs).
  double largestKappa() const;
};

RandomRecipe randomRecipe(Dice& dice, RandomKind kind);

}  // namespace ursula
