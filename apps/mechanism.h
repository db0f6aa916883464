#pragma once

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "model/mechanism_scenario.h"
#include "nocsolver/loops/loop_solver.h"
#include "report/files/report.h"
#include "validation/outside/external_solver.h"
#include "validation/verdict/result.h"

namespace ursula {

// What the verbs do with a scenario that has [mechanism].

/// A scenario of either machine.
struct AnyScenario {
  std::optional<MechanismScenario> mechanism;
  std::optional<Scenario> manipulator;  ///< if it is no mechanism
};
/// Reads a scenario of either machine, `-` for standard input. Throws ScenarioError and InputError, and UsageError if
/// one of the options' values `written` is a file that it names. `map` is for a mechanism's motion file. Warnings are
/// not said.
AnyScenario readAny(const std::string& file, std::initializer_list<std::string> written = {},
                    const std::vector<std::string>& map = {});
/// Reads one for a verb that uses its motion, and says on standard error what is odd of it.
AnyScenario openAny(const std::string& file, std::initializer_list<std::string> written = {},
                    const std::vector<std::string>& map = {});

/// Throws UsageError for an entry of the map that is not among those that files used.
void requireUsed(const std::vector<std::string>& map, const std::vector<std::string>& used);
/// The same for a verb that reads no file of efforts.
void requireUsed(const std::vector<std::string>& map, const AnyScenario& any);

/// Returns the result of `run`; errors of the loops become errors at the scenario.
template <class Run>
auto alongLoops(const MechanismScenario& scenario, const Run& run) {
  try {
    return run();
  } catch (const LoopError& error) {
    throw ScenarioError(scenario.file.string() + ": error: " + error.what());
  }
}

/// Reads a file of efforts, with `map` as for readTorquesAloud(), and says on standard error how its columns were read.
/// Entries that files of motion `used` need no column in this one.
GivenEfforts readEffortsAloud(const std::string& file, const std::vector<std::string>& map,
                              const std::vector<std::string>& used, const MechanismScenario& scenario);

/// Writes motion, efforts and joints at equally spaced instants, as CSV.
int inverseOfMechanism(const MechanismScenario& scenario, int samples, const std::string& out);

/// Checks freedoms and motion; `freedoms` gets a sentence about them. Draws the machine at the start of its motion into
/// `picture` if that is not empty; as the model places it if it cannot move. Throws ScenarioError.
CheckedScenario checkMechanism(const MechanismScenario& scenario, const std::string& picture, std::string& freedoms);

/// Whom the options of `validate` name instead of this program's solver; members that do not apply are empty.
struct OtherSubject {
  std::string torques, trajectory;  ///< files; a trajectory may have its torques
  std::vector<std::string> map;     ///< of the torques, and of a mechanism's motion
  ExternalSolverOptions solver;     ///< a command
  bool simulates = false;           ///< the command is a simulator
};
/// Judges this program's solver or another subject.
ValidationResult judgeMechanism(const MechanismScenario& scenario, const OtherSubject& other,
                                const MechanismOptions& options);

/// Writes a scenario for a model, with a small motion that its loops can follow. `motors` are joints' names; empty for
/// those that the model drives.
int initFromModel(const std::string& file, const std::string& model, const std::vector<std::string>& motors);

/// Returns the first line of a new scenario, "#:schema PATH", by which editors find the installed schema; empty if it
/// is not installed or the scenario goes to standard output.
std::string schemaLine(const std::string& file);

}  // namespace ursula
