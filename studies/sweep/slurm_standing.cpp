#include "studies/sweep/slurm_standing.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <stdexcept>

#include "base/output_file.h"

namespace ursula {
namespace {

std::filesystem::path jobsIn(const std::filesystem::path& folder) { return folder / "jobs.json"; }

bool has(const std::vector<std::int64_t>& jobs, std::int64_t job) {
  return std::find(jobs.begin(), jobs.end(), job) != jobs.end();
}

/// Opens a database of this sweep; null if there is none yet.
std::unique_ptr<Sqlite> opened(const std::filesystem::path& file, const SweepIdentity& ours) {
  if (!std::filesystem::exists(file)) return {};
  auto out = std::make_unique<Sqlite>(file, Sqlite::Access::read);
  if (isEmpty(*out)) return {};
  requireSame(file, readIdentity(*out), ours);
  return out;
}

bool isWrittenTo(const std::filesystem::path& file) {
  Sqlite database(file, Sqlite::Access::write);
  try {
    database.run("PRAGMA busy_timeout = 0; BEGIN IMMEDIATE; ROLLBACK");
  } catch (const DatabaseLocked&) {
    return true;
  }
  return false;
}

std::int64_t within(Sqlite& database, std::int64_t first, std::int64_t end) {
  return database.number(fmt::format("SELECT count(*) FROM point WHERE id >= {} AND id < {}", first, end));
}

ShardStanding standingOf(const std::filesystem::path& file, const SweepIdentity& ours, std::int64_t points) {
  ShardStanding out;
  try {
    if (const auto database = opened(file, ours)) out.done = within(*database, 0, ours.points);
    if (out.done == points)
      out.state = ShardState::complete;
    else if (std::filesystem::exists(file) && isWrittenTo(file))
      out.state = ShardState::locked;
  } catch (const DatabaseLocked&) {
    out.state = ShardState::locked;
  }
  return out;
}

}  // namespace

SlurmJobs readSlurmJobs(const std::filesystem::path& folder) {
  std::ifstream file(jobsIn(folder));
  if (!file) return {};
  try {
    const nlohmann::json document = nlohmann::json::parse(file);
    return {document.at("shards").get<int>(), document.at("arrays").get<std::vector<std::int64_t>>(),
            document.at("merges").get<std::vector<std::int64_t>>()};
  } catch (const nlohmann::json::exception&) {
    throw std::runtime_error(
        fmt::format("{}: cannot be read; expected the numbers of the jobs. Remove it where none of them runs or waits",
                    jobsIn(folder).string()));
  }
}

void writeSlurmJobs(const std::filesystem::path& folder, const SlurmJobs& jobs) {
  const nlohmann::ordered_json document = {{"shards", jobs.shards}, {"arrays", jobs.arrays}, {"merges", jobs.merges}};
  writeFileAtomically(jobsIn(folder), document.dump() + "\n");
}

std::vector<QueuedTask> readQueue(const std::string& answer) {
  std::vector<QueuedTask> out;
  std::istringstream lines(answer);
  for (std::string line; std::getline(lines, line);) {
    QueuedTask task;
    const std::size_t first = line.find('|'), second = line.find('|', first + 1);
    try {
      if (second == std::string::npos) throw std::invalid_argument(line);
      task.job = std::stoll(line.substr(0, first));
      const std::string index = line.substr(first + 1, second - first - 1);
      if (index != "N/A") task.index = std::stoi(index);
      task.state = line.substr(second + 1);
    } catch (const std::logic_error&) {
      throw std::runtime_error(fmt::format("squeue said '{}', expected it in the form {}", line, queue_format));
    }
    out.push_back(task);
  }
  return out;
}

std::vector<int> SlurmStanding::in(ShardState state) const {
  std::vector<int> out;
  for (std::size_t k = 0; k < shards.size(); ++k)
    if (shards[k].state == state) out.push_back(static_cast<int>(k) + 1);
  return out;
}

SlurmStanding standingOf(const SweepIdentity& sweep, const std::filesystem::path& database, int shards,
                         const SlurmJobs& jobs, const std::vector<QueuedTask>& queue) {
  SlurmStanding out;
  std::set<int> queued;
  std::set<std::int64_t> arrays, merges;
  bool merging = false;
  for (const QueuedTask& task : queue) {
    if (has(jobs.merges, task.job)) {
      merges.insert(task.job);
      merging = merging || task.state != "PENDING";
    } else if (has(jobs.arrays, task.job)) {
      arrays.insert(task.job);
      queued.insert(task.index);
    }
  }
  out.arrays.assign(arrays.begin(), arrays.end());
  out.merges.assign(merges.begin(), merges.end());
  const std::unique_ptr<Sqlite> whole = merging ? nullptr : opened(database, sweep);
  out.merged = whole && within(*whole, 0, sweep.points) == sweep.points;
  SweepIdentity part = sweep;
  part.shards = shards;
  for (int k = 1; k <= shards; ++k) {
    part.shard = k;
    const Shard shard{k, shards};
    const std::int64_t first = shard.first(sweep.points), end = shard.end(sweep.points);
    if (queued.count(k) > 0)
      out.shards.push_back({ShardState::queued, 0});
    else if (out.merged || (whole && within(*whole, first, end) == end - first))
      out.shards.push_back({ShardState::complete, end - first});
    else
      out.shards.push_back(standingOf(shardDatabase(database, shard), part, end - first));
  }
  return out;
}

}  // namespace ursula
