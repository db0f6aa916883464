#pragma once

#include <array>
#include <memory>
#include <string>

#include "model/loops/road.h"

namespace ursula {

/// A row of the table: all that the validation knows of a further road.
struct RoadKind {
  const char* check;    ///< that holds a subject against it
  const char* name;     ///< in a list of roads: "MuJoCo"
  const char* made_of;  ///< after "torques against": "MuJoCo's trees, closed by Lagrange multipliers"
  const char* engine;   ///< roads of one engine count as one
  bool (*available)();  ///< in this build
  std::unique_ptr<Road> (*make)(const Manipulator& manipulator, std::shared_ptr<const Load> load);
};

/// Another engine is a folder here, its row in further_roads.cpp, and one more in this count.
constexpr std::size_t further_road_count = 3;

/// An object for each further road.
template <typename T>
using OfFurtherRoads = std::array<T, further_road_count>;

const OfFurtherRoads<RoadKind>& furtherRoads();

/// Null where `check` holds nothing against a further road.
const RoadKind* furtherRoadOf(const std::string& check);

/// In the table's order; null where this build has none.
OfFurtherRoads<std::unique_ptr<Road>> makeFurtherRoads(const Manipulator& manipulator,
                                                       const std::shared_ptr<const Load>& load);

}  // namespace ursula
