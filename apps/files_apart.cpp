#include "apps/files_apart.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "apps/output.h"
#include "apps/verbs.h"
#include "base/output_file.h"
#include "model/scenario_files.h"

namespace ursula {
namespace {

struct Named {
  std::string option, file;
  bool written;
};

bool isWritten(const std::string& option) {
  const std::vector<std::string> writing = {"--out", "--picture", "--csv", "--junit", "--db", "--json", "--markdown"};
  return std::find(writing.begin(), writing.end(), option) != writing.end();
}

/// Gathers values that may name files. Flags name none; positional options that are no files do no harm.
void gather(const CLI::App& app, std::vector<Named>& out) {
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_name();
    const bool written = isWritten(name) && option->get_expected_min() > 0;
    if (!written && !option->get_positional() && name != "--torques") continue;
    for (const std::string& file : option->results())
      if (namesFile(file))
        out.push_back({name, file, written});
      else if (file == "-" && !written)
        out.push_back({name, "/dev/stdin", false});  // may be a file that the shell opened
  }
  for (const CLI::App* verb : app.get_subcommands()) gather(*verb, out);
}

bool areSame(const std::string& a, const std::string& b) {
  std::error_code none, ignored;
  if (std::filesystem::is_character_file(a, none)) return false;  // two names of /dev/null are fine
  return std::filesystem::equivalent(a, b, ignored) ||
         std::filesystem::absolute(a, none).lexically_normal() == std::filesystem::absolute(b, none).lexically_normal();
}

bool isIn(const std::filesystem::path& folder, const std::string& file) {
  std::error_code none;
  const std::filesystem::path end = endOfLinks(std::filesystem::absolute(file));
  if (std::filesystem::equivalent(end.parent_path(), folder, none)) return true;
  const auto isHardLink = [&file](const auto& entry) { return areSame(file, entry.path().string()); };
  return std::any_of(std::filesystem::directory_iterator(folder, none), {}, isHardLink);
}

}  // namespace

std::string namedTwice(const CLI::App& app) {
  std::vector<Named> files;
  gather(app, files);
  for (const Named& written : files)
    for (const Named& other : files)
      if (written.written && &written != &other && areSame(written.file, other.file))
        return fmt::format("{} {}: {} this file, expected another file", written.option, written.file,
                           other.written ? other.option + " also writes" : "the program reads");
  return "";
}

void requireApart(const Scenario& scenario, std::initializer_list<std::string> written) {
  requireApart(scenario.text, scenario.file, written);
}

void requireApart(const std::string& text, const std::filesystem::path& scenario,
                  std::initializer_list<std::string> written) {
  if (std::none_of(written.begin(), written.end(), namesFile)) return;  // then the text need not be parsed again
  for (const std::filesystem::path& read : filesNamedBy(text, scenario))
    for (const std::string& file : written)
      if (namesFile(file) && areSame(file, read.string()))
        throw UsageError(fmt::format("{}: {} reads this file, expected another file", file, scenario.string()));
}

void refuseToReplace(const std::string& folder, const std::filesystem::path& read) {
  throw UsageError(
      fmt::format("--out {}: results would replace {}, which is read, expected another folder", folder, read.string()));
}

void requireKept(const Scenario& scenario, const std::string& folder, std::initializer_list<const char*> written,
                 const std::string& also) {
  requireKept(scenario.text, scenario.file, folder, written, also);
}

void requireKept(const std::string& text, const std::filesystem::path& scenario, const std::string& folder,
                 std::initializer_list<const char*> written, const std::string& also) {
  std::vector<std::filesystem::path> inputs = filesNamedBy(text, scenario);
  inputs.push_back(scenario);
  inputs.emplace_back(also);
  for (const std::filesystem::path& read : inputs)
    for (const char* name : written)
      if (namesFile(read.string()) && areSame((std::filesystem::path(folder) / name).string(), read.string()))
        refuseToReplace(folder, read);
}

void requireOutside(std::initializer_list<std::string> compared, std::initializer_list<std::string> written) {
  std::error_code none;
  for (const std::string& folder : compared)
    for (const std::string& file : written)
      if (std::filesystem::is_directory(folder, none) && namesFile(file) && isIn(folder, file))
        throw UsageError(fmt::format("{}: is inside {}, which is compared, expected another folder", file, folder));
}

}  // namespace ursula
