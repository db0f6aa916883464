#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "apps/mechanism.h"
#include "apps/validate_options.h"
#include "model/scenario.h"

namespace ursula {

/// A call of `ursula validate`.
struct ValidateOptions {
  std::vector<std::string> scenarios;
  std::string out, format, against;
  OtherSubject other;         ///< who is judged, if not this program's solver
  EffortTolerance tolerance;  ///< zeros if not given
  double time_limit = 0;      ///< per scenario, s; 0 if not given
  bool json = false, quiet = false, verbose = false, strict = false, thorough = false, watch = false;
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));

  PrintedForm form() const {
    if (json) return PrintedForm::json;
    return quiet ? PrintedForm::verdict : verbose ? PrintedForm::table : PrintedForm::groups;
  }
};

/// Returns the files whose change is judged again: the inputs, or those that are named if these cannot be read.
std::vector<std::filesystem::path> watchedFiles(const ValidateOptions& options);

/// Reads, checks and judges the scenarios; returns the exit code. Wrong usage, and a suite without a valid member, are
/// refused before anything is computed or written.
int validateAll(const ValidateOptions& options);

}  // namespace ursula
