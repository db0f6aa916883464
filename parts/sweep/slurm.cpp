#include "parts/sweep/slurm.h"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <stdexcept>

#include "base/output_file.h"
#include "base/text.h"

namespace ursula {
namespace {

/// Escapes for a line `#SBATCH`, which sbatch parses by its own rules. Only double quotes protect blanks and #, and a
/// backslash escapes any byte.
std::string escaped(const std::string& word) {
  const auto plain = [](unsigned char c) {
    return std::isalnum(c) != 0 || std::string("-_=.,:/%+@").find(static_cast<char>(c)) != std::string::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
  std::string out = "\"";
  for (const char c : word) out += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return out + "\"";
}

/// Returns a log file in a folder, escaped for Slurm, in which % starts a placeholder. Throws for a folder that Slurm
/// cannot write to.
std::string logIn(const std::filesystem::path& folder, const std::string& name) {
  std::string out;
  for (const char c : folder.string()) out += c == '%' ? std::string("%%") : std::string(1, c);
  if (out.find_first_of("\\\n\r") != std::string::npos)
    throw std::invalid_argument(
        fmt::format("{}: Slurm cannot write logs to a path with a backslash or line break, expected another --db",
                    shownPath(folder.string())));
  return out + "/" + name;
}

/// Throws for an option that the user may not set; sbatch accepts abbreviated long names.
void requireUsersOwn(const std::string& option) {
  const std::string name = option.substr(0, option.find_first_of("= "));
  for (const std::string ours : {"--array", "-a", "--dependency", "-d", "--wrap", "--parsable", "--test-only"})
    if (ours.size() == 2 ? name[1] != '-' && name.substr(0, 2) == ours : name.size() > 3 && ours.rfind(name, 0) == 0)
      throw std::invalid_argument(
          fmt::format("[slurm] options: '{}' is not to be set here: ursula sets {} itself", shown(option), ours));
}

/// Escapes an option as sbatch's words: "--comment=a b" is one, "-A x" and "--account x" are two.
std::string words(const std::string& option) {
  const std::size_t end = option.find_first_of("= ");
  if (end == std::string::npos || option[end] == '=') return escaped(option);
  return option.substr(0, end) + " " + escaped(option.substr(end + 1));
}

std::string setting(const std::string& line) { return fmt::format("#SBATCH {}\n", line); }

/// Returns the lines `#SBATCH`. The user's options come last and take precedence.
std::string head(const SlurmJob& job, const std::string& name, int cpus, const std::string& log) {
  std::string out = "#!/bin/bash\n";
  out += setting("--job-name=" + escaped(fmt::format("{}-{}", name, job.database.stem().string())));
  out += setting(fmt::format("--ntasks=1 --cpus-per-task={}", cpus));
  out += setting("--output=" + escaped(logIn(slurmFolder(job.database) / "logs", log)));
  out += setting("--open-mode=append");
  out += setting("--requeue");
  if (!job.settings.partition.empty()) out += setting("--partition=" + escaped(job.settings.partition));
  if (!job.settings.time.empty()) out += setting("--time=" + escaped(job.settings.time));
  if (!job.settings.memory.empty()) out += setting("--mem=" + escaped(job.settings.memory));
  for (const std::string& option : job.settings.options) {
    requireUsersOwn(option);
    out += setting(words(option));
  }
  return out;
}

/// Returns the start of a shard database's name, before the number.
std::string stemOf(const std::filesystem::path& database) { return database.stem().string() + ".shard-"; }

}  // namespace

std::filesystem::path shardDatabase(const std::filesystem::path& database, const Shard& shard) {
  return database.parent_path() / fmt::format("{}{}-of-{}.db", stemOf(database), shard.index, shard.of);
}

std::filesystem::path slurmFolder(const std::filesystem::path& database) {
  return database.parent_path() / (database.stem().string() + ".slurm");
}

std::string arrayNumbers(const std::vector<int>& ascending) {
  std::string out;
  for (std::size_t k = 0; k < ascending.size();) {
    std::size_t last = k;
    while (last + 1 < ascending.size() && ascending[last + 1] == ascending[last] + 1) ++last;
    if (!out.empty()) out += ',';
    out += last == k ? fmt::format("{}", ascending[k]) : fmt::format("{}-{}", ascending[k], ascending[last]);
    k = last + 1;
  }
  return out;
}

std::string arrayScript(const SlurmJob& job) {
  const std::string before = shellWord((job.database.parent_path() / stemOf(job.database)).string());
  std::string out = head(job, "ursula", job.cpus, "%A_%a.log");
  out += setting("--array=" + arrayNumbers(job.todo));
  out += fmt::format(R"(
shard=$SLURM_ARRAY_TASK_ID
trap : TERM  # to be there until the sweep has written what it has
{} sweep {}{} --shard "$shard/{}" \
  --db {}"$shard-of-{}.db" --jobs "${{SLURM_CPUS_PER_TASK:-1}}"
code=$?
case $code in 1 | 3) code=0 ;; esac  # of points that failed or are inconclusive: the shard is whole
exit "$code"
)",
                     shellWord(job.program.string()), shellWord(job.sweep.string()),
                     job.pointwise ? " --pointwise" : "", job.shards, before, job.shards);
  return out;
}

std::string mergeScript(const SlurmJob& job) {
  return head(job, "ursula-merge", 1, "merge-%j.log") +
         fmt::format(R"(
cd {} || exit 2
shopt -s nullglob
shards=(./{}*-of-{}.db)
if ((${{#shards[@]}} == 0)); then
  echo 'no shard has a database' >&2
  exit 3
fi
exec {} sweep merge "${{shards[@]}}" --db {}
)",
                     shellWord(job.database.parent_path().string()), shellWord(stemOf(job.database)), job.shards,
                     shellWord(job.program.string()), shellWord(job.database.string()));
}

namespace {

std::filesystem::path jobsIn(const std::filesystem::path& folder) { return folder / "jobs.json"; }

bool has(const std::vector<std::int64_t>& jobs, std::int64_t job) {
  return std::find(jobs.begin(), jobs.end(), job) != jobs.end();
}

/// Opens a database of this sweep. Returns null if there is none yet.
std::unique_ptr<Sqlite> opened(const std::filesystem::path& file, const SweepIdentity& ours) {
  if (!std::filesystem::exists(file)) return {};
  auto out = std::make_unique<Sqlite>(file, Sqlite::Access::read);
  if (isEmpty(*out)) return {};
  requireSame(file, readIdentity(*out), ours);
  return out;
}

/// Returns whether another process is writing to the database now.
bool isWrittenTo(const std::filesystem::path& file) {
  Sqlite database(file, Sqlite::Access::write);
  try {
    database.run("PRAGMA busy_timeout = 0; BEGIN IMMEDIATE; ROLLBACK");
  } catch (const DatabaseLocked&) {
    return true;
  }
  return false;
}

/// Returns the number of points in [first, end) that the database has.
std::int64_t countWithin(Sqlite& database, std::int64_t first, std::int64_t end) {
  return database.number(fmt::format("SELECT count(*) FROM point WHERE id >= {} AND id < {}", first, end));
}

ShardState stateOf(const std::filesystem::path& file, const SweepIdentity& ours, std::int64_t points) {
  try {
    const auto database = opened(file, ours);
    if (database && countWithin(*database, 0, ours.points) == points) return ShardState::complete;
    return std::filesystem::exists(file) && isWrittenTo(file) ? ShardState::locked : ShardState::missing;
  } catch (const DatabaseLocked&) {
    return ShardState::locked;
  }
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
      throw std::runtime_error(fmt::format("squeue said '{}', expected it in the form {}", shown(line), queue_format));
    }
    out.push_back(task);
  }
  return out;
}

std::vector<int> SlurmStanding::in(ShardState state) const {
  std::vector<int> out;
  for (std::size_t k = 0; k < shards.size(); ++k)
    if (shards[k] == state) out.push_back(static_cast<int>(k) + 1);
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
  out.merged = whole && countWithin(*whole, 0, sweep.points) == sweep.points;
  SweepIdentity part = sweep;
  part.shards = shards;
  for (int k = 1; k <= shards; ++k) {
    part.shard = k;
    const Shard shard{k, shards};
    const std::int64_t first = shard.first(sweep.points), end = shard.end(sweep.points);
    if (queued.count(k) > 0)
      out.shards.push_back(ShardState::queued);
    else if (out.merged || (whole && countWithin(*whole, first, end) == end - first))
      out.shards.push_back(ShardState::complete);
    else
      out.shards.push_back(stateOf(shardDatabase(database, shard), part, end - first));
  }
  return out;
}

}  // namespace ursula
