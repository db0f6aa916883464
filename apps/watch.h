#pragma once

#include <filesystem>
#include <functional>
#include <vector>

namespace ursula {

/// Calls `judge` now, and again after each change of one of `files()`, which are asked for before it. What `judge`
/// throws is said on standard error, because the next change may mend it. SIGINT ends the waiting; returns the last
/// exit code of `judge`, or 2 after an error.
int watched(const std::function<int()>& judge, const std::function<std::vector<std::filesystem::path>()>& files);

}  // namespace ursula
