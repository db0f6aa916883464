#pragma once

#include <filesystem>
#include <functional>

#include "model/scenario.h"
#include "validation/subject/torque_file.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Validates external torques: pointwise at their own instants, and by replay on a spline through them. The failed
/// checks' `why` and the findings describe their errors. Throws CsvError for instants outside the motion, and like
/// validate(). `time_limit` and `asked_to_end` are those of ValidationOptions.
ValidationResult validateExternal(const Scenario& scenario, const TorqueFile& torques, double time_limit = 0,
                                  std::function<bool()> asked_to_end = nullptr);

/// The same from a file; throws CsvError like readTorqueFile.
ValidationResult validateExternal(const Scenario& scenario, const std::filesystem::path& torques_csv);

}  // namespace ursula
