#pragma once

#include <array>

namespace ursula {

/// Three joints from the base to a spherical one on the platform: universal–revolute, universal–prismatic,
/// revolute–universal, prismatic–universal.
enum class LegKind { URS, UPS, RUS, PUS };
constexpr std::size_t leg_kind_count = 4;

/// What a joint of a leg may turn or slide by. φ, ψ, θ are angles, d is a length.
enum class Coordinate { phi, psi, theta, d };
constexpr std::size_t coordinate_count = 4;

constexpr bool slides(Coordinate coordinate) { return coordinate == Coordinate::d; }
/// "phi", as files write it.
constexpr const char* nameOf(Coordinate coordinate) {
  constexpr std::array<const char*, coordinate_count> names = {"phi", "psi", "theta", "d"};
  return names[static_cast<std::size_t>(coordinate)];
}

/// What there is to know of a kind of leg without its geometry; model/legs/ has the rest. CONTRIBUTING.md says what
/// another kind needs.
struct LegKindRow {
  const char* name;
  std::array<Coordinate, 3> coordinates;  ///< from the base to the tip
  int joints_of_proximal;                 ///< how many of them come before the proximal link
  std::size_t actuated;                   ///< which of them a motor drives if nothing is said
  const char* knee;                       ///< what `knee` is the sign of, "sin theta"; null where there is one branch

  /// The proximal link is a carriage: it slides along the base axis, never turns, and has no length.
  constexpr bool hasCarriage() const { return slides(coordinates[0]); }
  /// The distal link is a rod that slides in the proximal one, a cylinder.
  constexpr bool isTelescopic() const { return slides(coordinates[2]); }
};

inline constexpr std::array<LegKindRow, leg_kind_count> leg_kinds = {{
    {"URS", {Coordinate::phi, Coordinate::psi, Coordinate::theta}, 2, 0, "sin theta"},
    {"UPS", {Coordinate::phi, Coordinate::psi, Coordinate::d}, 2, 2, nullptr},
    {"RUS", {Coordinate::phi, Coordinate::psi, Coordinate::theta}, 1, 0, "sin psi"},
    {"PUS", {Coordinate::d, Coordinate::psi, Coordinate::theta}, 1, 0, "cos theta"},
}};

constexpr const LegKindRow& rowOf(LegKind kind) { return leg_kinds[static_cast<std::size_t>(kind)]; }

}  // namespace ursula
