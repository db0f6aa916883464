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

/// Another engine is a folder here, its row in further_engines.cpp, and one more in this count.
constexpr std::size_t further_engine_count = 3;

/// An object for each further formulation.
template <typename T>
using OfFurtherEngines = std::array<T, further_engine_count>;

const OfFurtherEngines<EngineKind>& furtherEngines();

/// Null where `check` holds nothing against a further formulation.
const EngineKind* furtherEngineOf(const std::string& check);

/// In the table's order; null where this build has none.
OfFurtherEngines<std::unique_ptr<Engine>> makeFurtherEngines(const Manipulator& manipulator,
                                                             const std::shared_ptr<const Load>& load);

}  // namespace ursula
