#pragma once

#include <array>
#include <type_traits>

namespace ursula {

/// The three joints from the base to the platform's spherical joint: universal–revolute, universal–prismatic,
/// revolute–universal, prismatic–universal.
enum class LegKind { URS, UPS, RUS, PUS };

/// The coordinates of a leg's joints; φ, ψ, θ are angles, d is a length.
enum class Coordinate { phi, psi, theta, d };
constexpr std::size_t coordinate_count = 4;

constexpr bool slides(Coordinate coordinate) { return coordinate == Coordinate::d; }
/// The name in files: "phi".
constexpr const char* nameOf(Coordinate coordinate) {
  constexpr std::array<const char*, coordinate_count> names = {"phi", "psi", "theta", "d"};
  return names[static_cast<std::size_t>(coordinate)];
}

/// What a kind of leg says of itself beyond its row; each kind has it in its file, model/legs/KIND.cpp.
class LegType;
using LegTypeOfKind = const LegType&();
LegTypeOfKind ursLeg, upsLeg, rusLeg, pusLeg;

/// The properties of a kind of leg that are needed without its file. CONTRIBUTING.md explains how to add a kind.
struct LegKindRow {
  const char* name;
  const char* words;                      ///< "telescopic"
  const char* joints;                     ///< "universal joint, cylinder and rod, ball"
  std::array<Coordinate, 3> coordinates;  ///< from the base to the tip
  int joints_of_proximal;                 ///< number of coordinates before the proximal link
  std::size_t actuated;                   ///< index of the coordinate that a motor drives by default
  const char* knee;  ///< the expression whose sign `knee` selects, "sin theta"; null if there is one branch
  LegTypeOfKind* type;

  /// Whether the proximal link is a carriage: it slides along the base axis, never turns, and has no length.
  constexpr bool hasCarriage() const { return slides(coordinates[0]); }
  /// Whether the distal link is a rod that slides in the proximal one, a cylinder.
  constexpr bool isTelescopic() const { return slides(coordinates[2]); }
};

/// All kinds, in the order of LegKind.
inline constexpr std::array leg_kinds = {
    LegKindRow{"URS",
               "the paper's",
               "universal joint, pin at the knee, ball",
               {Coordinate::phi, Coordinate::psi, Coordinate::theta},
               2,
               0,
               "sin theta",
               ursLeg},
    LegKindRow{"UPS",
               "telescopic",
               "universal joint, cylinder and rod, ball",
               {Coordinate::phi, Coordinate::psi, Coordinate::d},
               2,
               2,
               nullptr,
               upsLeg},
    LegKindRow{"RUS",
               "crank and rod",
               "pin, universal joint, ball",
               {Coordinate::phi, Coordinate::psi, Coordinate::theta},
               1,
               0,
               "sin psi",
               rusLeg},
    LegKindRow{"PUS",
               "carriage and rod",
               "slide, universal joint, ball",
               {Coordinate::d, Coordinate::psi, Coordinate::theta},
               1,
               0,
               "cos theta",
               pusLeg},
};
constexpr std::size_t leg_kind_count = leg_kinds.size();

constexpr const LegKindRow& rowOf(LegKind kind) { return leg_kinds[static_cast<std::size_t>(kind)]; }

/// Calls f with the kind as a constant.
template <class F>
auto withKind(LegKind kind, const F& f) {
  switch (kind) {
    case LegKind::UPS:
      return f(std::integral_constant<LegKind, LegKind::UPS>());
    case LegKind::RUS:
      return f(std::integral_constant<LegKind, LegKind::RUS>());
    case LegKind::PUS:
      return f(std::integral_constant<LegKind, LegKind::PUS>());
    case LegKind::URS:
      break;
  }
  return f(std::integral_constant<LegKind, LegKind::URS>());
}

}  // namespace ursula
