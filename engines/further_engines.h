#pragma once

#include <array>
#include <memory>
#include <string>

#include "engines/engine.h"

namespace ursula {

/// A row of the table: all that the validation knows of a further formulation.
struct EngineKind {
  const char* check;    ///< that holds a subject against it
  const char* name;     ///< in a list of formulations: "MuJoCo"
  const char* made_of;  ///< after "torques against": "MuJoCo's trees, closed by Lagrange multipliers"
  const char* engine;   ///< formulations of one engine count as one
  bool (*available)();  ///< in this build
  std::unique_ptr<Engine> (*make)(const Manipulator& manipulator, std::shared_ptr<const Load> load);
};

using MakeEngine = std::unique_ptr<Engine>(const Manipulator& manipulator, std::shared_ptr<const Load> load);

// Each engine's folder defines its own.
MakeEngine makeSimbodyTree, makeMaximalLoop, makeMujocoLoop;
bool mujocoAvailable();  ///< false where this was built without MuJoCo
inline bool alwaysAvailable() { return true; }

/// The table of them all. Another engine is a folder here and its row.
inline constexpr std::array further_engines = {
    EngineKind{"torque.twin", "Simbody, tree through leg 1", "Simbody's loop grown through leg 1, balls at the others",
               "Simbody", alwaysAvailable, makeSimbodyTree},
    EngineKind{"torque.maximal", "maximal coordinates",
               "links and platform in maximal coordinates with Lagrange multipliers", "maximal coordinates",
               alwaysAvailable, makeMaximalLoop},
    EngineKind{"torque.mujoco", "MuJoCo", "MuJoCo's trees, closed by Lagrange multipliers", "MuJoCo", mujocoAvailable,
               makeMujocoLoop},
};
constexpr std::size_t further_engine_count = further_engines.size();

/// An object for each further formulation.
template <typename T>
using OfFurtherEngines = std::array<T, further_engine_count>;

/// Null where `check` holds nothing against a further formulation.
const EngineKind* furtherEngineOf(const std::string& check);

/// In the table's order; null where this build has none.
OfFurtherEngines<std::unique_ptr<Engine>> makeFurtherEngines(const Manipulator& manipulator,
                                                             const std::shared_ptr<const Load>& load);

}  // namespace ursula
