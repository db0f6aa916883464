#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "report/page/picture.h"
#include "report/page/plots.h"
#include "validation/verdict/result.h"

namespace ursula::report {

/// Returns the data of the page's script as JSON for a <script> block: charts, the machine along its motion, events. It
/// is thinned to visible detail; numbers have six digits. `picture` may be null; a result's mechanism needs none.
std::string pageData(const ValidationResult& result, const Picture* picture, const std::vector<Plot>& plots);

/// The same for a page with charts only.
std::string chartData(const std::string& title, const std::vector<Plot>& plots);

/// Returns the machine's points and directions at the picture's instants, with the result's errors, efforts and
/// reactions there.
nlohmann::ordered_json machineJson(const Picture& picture, const ValidationResult& result);

/// Returns a mechanism's bodies, joints and poses at its picture's instants, with the result's efforts there.
nlohmann::ordered_json machineJson(const MechanismPicture& picture, const ValidationResult& result);

/// Writes JSON that can stand in a <script> block: without "<", so that neither "</script" nor "<!--" ends or breaks
/// it, and without characters that HTML does not have. All of these occur in strings only.
std::string inScript(const nlohmann::ordered_json& json);

/// Returns `value` with six digits, more than a screen shows; null if it is not finite.
nlohmann::ordered_json screenNumber(double value);
nlohmann::ordered_json screenNumbers(const std::vector<double>& values);

}  // namespace ursula::report
