#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "parts/sweep/run.h"

namespace ursula {

struct MergeResult {
  SweepIdentity identity;
  std::int64_t added = 0, done = 0;   ///< numbers of points
  std::vector<PointRange> missing;    ///< in order; at most most_named of them
  std::vector<Shard> missing_shards;  ///< shards with a missing point, if all databases are shards of equal count
};

constexpr std::size_t most_named = 1000;

/// Copies all points of `parts` into the database `into`, which may exist with some or all points; existing points
/// stay. Throws DatabaseError for a part of another sweep or program version, for a damaged one, and if a point
/// differs. It then leaves the earlier content of `into` unchanged. `progress` receives each finished part. If `stop`
/// returns true, finished parts stay and DatabaseStopped is thrown; both may be empty.
MergeResult mergeSweeps(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& into,
                        const std::function<void(std::size_t parts)>& progress = {},
                        const std::function<bool()>& stop = {});

}  // namespace ursula
