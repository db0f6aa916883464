#include "apps/validate_inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "apps/mechanism.h"
#include "apps/verbs.h"
#include "base/text.h"
#include "model/scenario_files.h"

namespace ursula {
namespace {

/// Refuses entries of the map that no file uses. Those of a given file are judged with it.
void requireMapped(const ValidateOptions& options, const std::vector<SuiteMember>& members) {
  if (options.other.map.empty() || !options.other.torques.empty()) return;
  std::vector<std::string> used;
  bool any_mechanism = false;
  for (const SuiteMember& member : members) {
    if (!member.mechanism) continue;
    any_mechanism = true;
    used.insert(used.end(), member.mechanism->mapped.begin(), member.mechanism->mapped.end());
  }
  if (!any_mechanism) throw UsageError("--map: expected also --torques FILE.csv, whose columns it names");
  if (options.other.trajectory.empty()) requireUsed(options.other.map, used);
}

}  // namespace

void requireConsistent(const ValidateOptions& options, const std::vector<SuiteMember>& members) {
  for (const auto& [option, file] :
       {std::pair("--torques", &options.other.torques), {"--trajectory", &options.other.trajectory}})
    if (members.size() > 1 && !file->empty())
      throw UsageError(
          fmt::format("{}: got {} scenarios, expected one, because a file is of one motion", option, members.size()));
  for (const std::string& each : options.scenarios)
    if (std::filesystem::path(each).extension() == ".csv")
      throw UsageError(fmt::format("{} is no scenario, did you mean --torques {}?", shellWord(each), shellWord(each)));
  requireMapped(options, members);
  const auto& given = options.scenarios;
  if (!options.other.solver.command.empty() && std::find(given.begin(), given.end(), "-") != given.end())
    throw UsageError("--solver: got - as the scenario, expected a file, because the command gets its path");
  if (options.watch && std::find(given.begin(), given.end(), "-") != given.end())
    throw UsageError("--watch: got - as the scenario, expected a file, because it is read again");
}

bool isSuite(const ValidateOptions& options, const std::vector<SuiteMember>& members) {
  const auto is_folder = [](const std::string& each) {
    std::error_code ignored;
    return std::filesystem::is_directory(each, ignored);
  };
  return members.size() > 1 || (options.other.torques.empty() && options.other.trajectory.empty() &&
                                std::any_of(options.scenarios.begin(), options.scenarios.end(), is_folder));
}

std::filesystem::path folderOf(const ValidateOptions& options, const std::vector<SuiteMember>& members) {
  if (options.out == "-")
    throw UsageError("--out -: expected a folder, not standard output; --json puts the summary there");
  const std::filesystem::path by_name = isSuite(options, members) ? "suite" : members.front().name;
  const std::filesystem::path dir = options.out.empty() ? "results" / by_name : std::filesystem::path(options.out);
  refuseFile(dir.string());
  return dir;
}

std::vector<std::filesystem::path> inputsOf(const ValidateOptions& options, const std::vector<SuiteMember>& members) {
  std::vector<std::filesystem::path> out(options.scenarios.begin(), options.scenarios.end());
  for (const std::string* each : {&options.other.torques, &options.other.trajectory})
    if (!each->empty()) out.emplace_back(*each);
  for (const SuiteMember& member : members) {
    if (!member.torques.empty()) out.push_back(member.torques);
    if (member.mechanism) out.push_back(member.mechanism->model);
    if (!member.scenario) continue;
    for (std::filesystem::path& each : filesNamedBy(*member.scenario)) out.push_back(std::move(each));
  }
  return out;
}

std::vector<std::filesystem::path> watchedFiles(const ValidateOptions& options) {
  std::vector<std::filesystem::path> out;
  try {
    const std::vector<SuiteMember> members =
        readSuite({options.scenarios.begin(), options.scenarios.end()}, options.other.map);
    out = inputsOf(options, members);
    for (const SuiteMember& member : members) out.push_back(member.file);
  } catch (const std::exception&) {  // judging says what is wrong
    out = inputsOf(options, {});
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace ursula
