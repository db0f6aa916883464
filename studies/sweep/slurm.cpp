#include "studies/sweep/slurm.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "base/shell_word.h"

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

/// Escapes a file name for Slurm, in which % starts a placeholder.
std::string logIn(const std::filesystem::path& folder, const std::string& name) {
  std::string out;
  for (const char c : folder.string()) out += c == '%' ? std::string("%%") : std::string(1, c);
  if (out.find_first_of("\\\n\r") != std::string::npos)
    throw std::invalid_argument(
        fmt::format("{}: Slurm cannot write logs to a path with a backslash or line break, expected another --db",
                    folder.string()));
  return out + "/" + name;
}

/// Throws for an option that the user may not set; sbatch accepts abbreviated long names.
void requireUsersOwn(const std::string& option) {
  const std::string name = option.substr(0, option.find_first_of("= "));
  for (const std::string ours : {"--array", "-a", "--dependency", "-d", "--wrap", "--parsable", "--test-only"})
    if (ours.size() == 2 ? name[1] != '-' && name.substr(0, 2) == ours : name.size() > 3 && ours.rfind(name, 0) == 0)
      throw std::invalid_argument(
          fmt::format("[slurm] options: '{}' is not to be set here: ursula sets {} itself", option, ours));
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

/// The start of a shard database's name, before the number.
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

}  // namespace ursula
