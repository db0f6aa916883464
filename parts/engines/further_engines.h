#pragma once

#include <array>
#include <memory>
#include <string>

#include "model/engine.h"

namespace ursula {

/// Everything that the validation knows of a further formulation.
struct EngineKind {
  const char* check;    ///< name of the check that compares the subject with it
  const char* name;     ///< in a list of formulations: "MuJoCo"
  const char* made_of;  ///< follows "torques against": "MuJoCo's trees, closed by Lagrange multipliers"
  bool (*available)();  ///< whether this build has it
  std::unique_ptr<Engine> (*make)(const Manipulator& manipulator, std::shared_ptr<const Load> load);
};

using MakeEngine = std::unique_ptr<Engine>(const Manipulator& manipulator, std::shared_ptr<const Load> load);

// Each engine's folder defines its own function.
MakeEngine makeSimbodyTree, makeMaximalLoop, makeMujocoLoop;
bool mujocoAvailable();  ///< false if this build lacks MuJoCo
inline bool alwaysAvailable() { return true; }

/// All further formulations. A new one needs a folder in engines/ and a row.
inline constexpr std::array further_engines = {
    EngineKind{"torque.twin", "Simbody, tree through leg 1", "Simbody's tree through leg 1, balls at the others",
               alwaysAvailable, makeSimbodyTree},
    EngineKind{"torque.maximal", "maximal coordinates",
               "links and platform in maximal coordinates with Lagrange multipliers", alwaysAvailable, makeMaximalLoop},
    EngineKind{"torque.mujoco", "MuJoCo", "MuJoCo's trees, closed by Lagrange multipliers", mujocoAvailable,
               makeMujocoLoop},
};
constexpr std::size_t further_engine_count = further_engines.size();

/// One object per further formulation.
template <typename T>
using OfFurtherEngines = std::array<T, further_engine_count>;

/// Returns null if `check` compares with no further formulation.
const EngineKind* furtherEngineOf(const std::string& check);

/// Returns them in the order of the table; null for engines that this build lacks.
OfFurtherEngines<std::unique_ptr<Engine>> makeFurtherEngines(const Manipulator& manipulator,
                                                             const std::shared_ptr<const Load>& load);

}  // namespace ursula
