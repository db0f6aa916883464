#pragma once

#include <memory>
#include <vector>

#include "base/csv.h"
#include "base/errors.h"
#include "model/scenario.h"
#include "model/toml_reader.h"

// Each function reads one table of a scenario; scenario.cpp combines them. All throw ScenarioError. What only
// Manipulator or a trajectory can check throws InvalidParameter; `located` adds the place.

namespace ursula {

/// Reads what every scenario has: name, simulation and acceptance.
void readJudging(const TomlSection& document, Scenario& scenario);
/// Throws ScenarioError if the document has both [manipulator] and [mechanism].
void requireOneMachine(const TomlSection& document);
/// Throws it also for [mechanism] alone: the one place that refuses it for all that cannot take one.
void requireManipulator(const TomlSection& document);
ManipulatorParameters readManipulator(const TomlSection& manipulator);
std::shared_ptr<const Trajectory> readTrajectory(const TomlSection& trajectory);
std::shared_ptr<const Load> readLoad(const TomlSection& table);

/// Reads the poses, or with `loads` the loads, of the CSV that `key` names, by readByMeaning(). A relative path refers
/// to the scenario's folder. Throws also CsvError.
CsvTable readCsvBeside(const TomlSection& table, const std::string& key, bool loads);

/// Finds the value that `refusal` names in the document or in manipulator.leg_defaults, or the nearest enclosing table.
PlacedError located(const InvalidParameter& refusal, const TomlSection& document);

/// Adds further errors to the first one that a reader met: other wrong keys, types and bounds of the whole document.
/// There are at most ten in all, in the order of `text`, which is the file.
PlacedError withOthers(const PlacedError& first, const TomlSection& document, const std::string& text);

}  // namespace ursula
