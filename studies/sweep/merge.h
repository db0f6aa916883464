#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "studies/sweep/run.h"

namespace ursula {

struct MergeResult {
  SweepIdentity identity;
  std::int64_t added = 0, done = 0;   ///< points
  std::vector<PointRange> missing;    ///< in order; at most most_named of them
  std::vector<Shard> missing_shards;  ///< that hold a missing point, where all databases are shards of one number
};

constexpr std::size_t most_named = 1000;

/// Takes all points of `parts` into the database `into`, which may be there already, in part or as a whole: those that
/// it has are left as they are. Throws DatabaseError, and changes nothing of `into` that it had, for a part of another
/// sweep or of another version of the program, for one that is damaged, and where a point is not the same in both.
/// `progress` is told of each part that is done; `stop` is asked now and then, and where it says yes, the parts that
/// are done stay and DatabaseStopped is thrown; either may be empty.
MergeResult mergeSweeps(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& into,
                        const std::function<void(std::size_t parts)>& progress = {},
                        const std::function<bool()>& stop = {});

}  // namespace ursula
