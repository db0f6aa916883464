#include "apps/suite/suite.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>

#include "apps/suite/no_model.h"
#include "base/errors.h"
#include "base/output_folder.h"
#include "base/start_threads.h"
#include "model/scenario_excerpt.h"
#include "model/scenario_files.h"
#include "report/files/run.h"
#include "validation/mechanism/validate_mechanism.h"
#include "validation/subject/motion_check.h"

namespace ursula {
namespace {

std::vector<std::filesystem::path> scenariosIn(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".toml" && !entry.is_directory()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

SuiteMember readMember(const std::filesystem::path& file, const std::vector<std::string>& map) {
  SuiteMember member;
  member.name = file.string();
  member.file = file;
  try {
    std::string text = scenarioNotModel(file);
    if (isMechanism(text)) {
      member.mechanism =
          std::make_shared<const MechanismScenario>(parseMechanism(text, namedInput(file), partModelReader(), map));
      member.name = member.mechanism->name;
      static_cast<void>(MechanismAlong(*member.mechanism));
      return member;
    }
    member.scenario = parseScenario(text, namedInput(file));
    member.name = member.scenario->name;
    tryMotion(*member.scenario);
  } catch (const ScenarioError& error) {
    member.error = error.what();  // starts with file:line:column
    member.at_length = atLength(error);
  } catch (const InputError& error) {
    member.error = error.what();
  } catch (const LoopError& error) {
    member.error = fmt::format("{}: error: {}", file.string(), error.what());
  }
  return member;
}

/// Returns NAME.csv beside NAME.toml if it is there and not a file that the scenario itself names.
std::filesystem::path effortsBeside(const SuiteMember& member) {
  std::filesystem::path csv = member.file;
  csv.replace_extension(".csv");
  std::error_code ignored;
  if (!member.isRead() || !std::filesystem::is_regular_file(csv, ignored)) return {};
  const std::string text = member.scenario ? member.scenario->text : member.mechanism->text;
  for (const std::filesystem::path& named : filesNamedBy(text, member.file))
    if (std::filesystem::equivalent(named, csv, ignored)) return {};
  return csv;
}

void readFolder(const std::filesystem::path& folder, const std::vector<std::string>& map,
                std::vector<SuiteMember>& members) {
  const std::vector<std::filesystem::path> files = scenariosIn(folder);
  for (const std::filesystem::path& file : files) {
    members.push_back(readMember(file, map));
    members.back().torques = effortsBeside(members.back());
  }
  if (!files.empty()) return;
  SuiteMember none;
  none.name = folder.string();
  none.file = folder;
  none.error = folder.string() + ": error: no scenario in this folder, expected *.toml";
  members.push_back(std::move(none));
}

/// The names become folders next to the suite's own files.
void checkNames(const std::vector<SuiteMember>& members) {
  std::map<std::string, std::string> taken;
  std::vector<std::string> errors;
  if (members.size() > 1)
    taken = {{"index.html", "the suite's index"},
             {"junit.xml", "the suite's JUnit file"},
             {"suite.json", "the suite's summary"}};
  for (const SuiteMember& member : members) {
    if (!member.isRead()) continue;
    const std::string file = (member.mechanism ? member.mechanism->file : member.scenario->file).string();
    const auto [holder, is_new] = taken.emplace(member.name, file);
    if (!is_new)
      errors.push_back(fmt::format("{}: error: name = '{}' is also that of {}, expected a name for each", file,
                                   member.name, holder->second));
  }
  if (!errors.empty()) throw ScenarioError(fmt::format("{}", fmt::join(errors, "\n")));
}

/// Each free thread takes the next scenario; each writes to its own place.
class SuiteRun {
 public:
  SuiteRun(const std::vector<SuiteMember>& members, OutputFolder& out, const SuiteOptions& options)
      : members_(members), out_(out), options_(options), entries_(members.size()) {}

  std::vector<SuiteEntry> run() {
    inParallel(options_.jobs, static_cast<int>(members_.size()), [this](int k) {
      entries_[k] = judgeOne(members_[k]);
      const std::lock_guard<std::mutex> lock(mutex_);
      ++done_;
      if (options_.finished) options_.finished(entries_[k], done_);
    });
    return std::move(entries_);
  }

 private:
  SuiteEntry judgeOne(const SuiteMember& member) {
    const Stopwatch watch;
    std::string error = member.error;
    std::optional<ValidationResult> result;
    try {
      if (error.empty()) result = options_.judge(member);
    } catch (const std::bad_alloc&) {
      error = out_of_memory_for_scenario;
    } catch (const std::exception& refusal) {
      error = refusal.what();
    }
    if (result) return addResults(*result, out_, member.name, watch.time(), Place::in_suite);
    SuiteEntry entry;
    entry.scenario = member.name;
    entry.error = error;
    entry.time = watch.time();
    return entry;
  }

  const std::vector<SuiteMember>& members_;
  OutputFolder& out_;
  const SuiteOptions& options_;
  std::vector<SuiteEntry> entries_;
  std::mutex mutex_;  // guards what follows
  std::size_t done_ = 0;
};

}  // namespace

std::vector<SuiteMember> readSuite(const std::vector<std::filesystem::path>& arguments,
                                   const std::vector<std::string>& map) {
  std::vector<SuiteMember> members;
  for (const std::filesystem::path& argument : arguments) {
    std::error_code ignored;
    if (std::filesystem::is_directory(argument, ignored))
      readFolder(argument, map, members);
    else
      members.push_back(readMember(argument, map));
  }
  checkNames(members);
  return members;
}

std::vector<SuiteMember> allOrNothing(std::vector<SuiteMember> members) {
  std::vector<std::string> errors;
  for (const SuiteMember& member : members)
    if (!member.error.empty()) errors.push_back(member.at_length.empty() ? member.error : member.at_length);
  if (!errors.empty()) throw ScenarioError(fmt::format("{}", fmt::join(errors, "\n")));
  return members;
}

std::vector<SuiteEntry> runSuite(const std::vector<SuiteMember>& members, const std::filesystem::path& dir,
                                 const SuiteOptions& options) {
  if (options.jobs < 1) throw std::invalid_argument(fmt::format("{} jobs, expected at least 1", options.jobs));
  OutputFolder out(dir, report::resultsIn);
  for (const char* file : report::suite_files) out.require(file);
  for (const SuiteMember& member : members)
    if (member.isRead()) requireResults(out, member.name);
  std::vector<SuiteEntry> entries = SuiteRun(members, out, options).run();
  addSuiteIndex(entries, out);
  out.commit();
  return entries;
}

}  // namespace ursula
