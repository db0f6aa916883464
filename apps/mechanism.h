#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "model/mechanism_scenario.h"
#include "validation/outside/external_solver.h"
#include "validation/verdict/result.h"

namespace ursula {

// What the verbs do with a scenario that has [mechanism].

/// Reads the scenario if it has [mechanism]. Throws ScenarioError and InputError. Does not read standard input.
std::optional<MechanismScenario> openMechanism(const std::filesystem::path& file);

/// Writes motion, efforts and joints at equally spaced instants, as CSV.
int inverseOfMechanism(const MechanismScenario& scenario, int samples, const std::string& out);

/// Checks freedoms and motion, and says what was assumed on reading. Draws the machine at the start of its motion into
/// `picture` if that is not empty; as the model places it if it cannot move.
int checkMechanism(const MechanismScenario& scenario, const std::string& picture);

/// Judges this program's solver, a command if there is one, or the efforts of a file if `torques` is not empty.
ValidationResult judgeMechanism(const MechanismScenario& scenario, const std::string& torques,
                                const std::vector<std::string>& map, const ExternalSolverOptions& solver,
                                const MechanismOptions& options);

/// Writes a scenario for a model, with a small motion that its loops can follow.
int initFromModel(const std::string& file, const std::string& model);

}  // namespace ursula
