#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "model/engine.h"

namespace ursula {

/// The largest number of further formulations in one run.
constexpr std::size_t most_further_engines = 6;

/// One object per further formulation, in the order of furtherEngines(); the places behind them stay empty.
template <typename T>
using OfFurtherEngines = std::array<T, most_further_engines>;

/// All further formulations: Simbody's tree through leg 1, then those of the parts in this build.
const std::vector<EngineKind>& furtherEngines();

/// The rows of the parts in this build. CMake writes the definition (cmake/parts.cmake), once for each program.
std::vector<EngineKind> partEngines();

/// Returns null if `check` compares with no further formulation.
const EngineKind* furtherEngineOf(const std::string& check);

/// Returns them in the order of the table; null for engines that this build lacks.
OfFurtherEngines<std::unique_ptr<Engine>> makeFurtherEngines(const Manipulator& manipulator,
                                                             const std::shared_ptr<const Load>& load);

}  // namespace ursula
