#pragma once

#include <filesystem>
#include <functional>

#include "model/scenario.h"
#include "validation/subject/torque_file.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Judges somebody else's torques: pointwise at their own instants, and by replay on a spline through them. What is
/// wrong with them goes into the `why` of the checks that fail and into the findings. Throws CsvError for instants
/// outside of the motion, and as validate() does.
/// `time_limit`, `asked_to_end`: as ValidationOptions has them.
ValidationResult validateExternal(const Scenario& scenario, const TorqueFile& torques, double time_limit = 0,
                                  std::function<bool()> asked_to_end = nullptr);

/// The same from a file; throws CsvError as readTorqueFile does.
ValidationResult validateExternal(const Scenario& scenario, const std::filesystem::path& torques_csv);

}  // namespace ursula
