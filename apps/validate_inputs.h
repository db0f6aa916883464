#pragma once

#include <filesystem>
#include <vector>

#include "apps/suite/suite.h"
#include "apps/validate_call.h"

namespace ursula {

/// Checks that options fit together, and that options for one motion get one scenario. Throws UsageError.
void requireConsistent(const ValidateOptions& options, const std::vector<SuiteMember>& members);

/// A folder is always a suite, so that scripts find the same files.
bool isSuite(const ValidateOptions& options, const std::vector<SuiteMember>& members);

/// Returns the folder of the results. Throws UsageError if it is none.
std::filesystem::path folderOf(const ValidateOptions& options, const std::vector<SuiteMember>& members);

/// The input files.
std::vector<std::filesystem::path> inputsOf(const ValidateOptions& options, const std::vector<SuiteMember>& members);

}  // namespace ursula
