#pragma once

#include <memory>
#include <vector>

#include "base/csv.h"
#include "base/errors.h"
#include "model/scenario.h"
#include "model/toml_reader.h"

// The parts of a scenario, each read from its own table; scenario.cpp puts them together. All throw ScenarioError;
// what only Manipulator or a trajectory can judge comes back as InvalidParameter, for `located` to place.

namespace ursula {

ManipulatorParameters readManipulator(const TomlSection& manipulator);
std::shared_ptr<const Trajectory> readTrajectory(const TomlSection& trajectory);
std::shared_ptr<const Load> readLoad(const TomlSection& table);

/// The CSV that `key` names; a relative path is taken from the scenario's own folder. Throws also CsvError.
CsvTable readCsvBeside(const TomlSection& table, const std::string& key);

/// Finds the value that `refusal` names in the document, or in manipulator.leg_defaults where a leg inherits it, or the
/// nearest table around it.
ScenarioError located(const InvalidParameter& refusal, const TomlSection& document);

}  // namespace ursula
