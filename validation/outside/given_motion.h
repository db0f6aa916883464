#pragma once

#include <filesystem>
#include <string>

#include "validation/mechanism/validate_mechanism.h"
#include "validation/validate.h"

namespace ursula {

/// Validates a motion that another program made, read as `kind = "samples"` reads one. The efforts that it needs, by a
/// spline through its rows, are compared with those of `torques`, or with the right ones of the scenario's motion if
/// that is empty. They are compared as means over short windows: within these, what a row is off counts as a position,
/// not as an acceleration. What the rows' digits leave open is found with the scenario's own motion at the same
/// instants; what lies between the rows, by leaving out every second, fourth and eighth. `map` is as for
/// readMotorTable(). Throws CsvError, and like validate().
ValidationResult validateMotion(const Scenario& scenario, const std::filesystem::path& motion,
                                const TorqueFile* torques, const ExternalOptions& options = {});
ValidationResult validateMotion(const MechanismScenario& scenario, const std::filesystem::path& motion,
                                const GivenEfforts* efforts, const MechanismOptions& options = {},
                                const std::vector<std::string>& map = {});

}  // namespace ursula
