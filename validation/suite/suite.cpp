#include "validation/suite/suite.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

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

std::vector<std::filesystem::path> scenarioFiles(const std::vector<std::filesystem::path>& arguments,
                                                 std::vector<std::string>& errors) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& argument : arguments) {
    std::error_code ignored;
    const bool is_folder = std::filesystem::is_directory(argument, ignored);
    const auto found = is_folder ? scenariosIn(argument) : std::vector<std::filesystem::path>{argument};
    if (found.empty())
      errors.push_back(fmt::format("{}: error: no scenario in this folder, expected *.toml", argument.string()));
    files.insert(files.end(), found.begin(), found.end());
  }
  return files;
}

/// Names of folders beside files of the suite's own.
void checkNames(const std::vector<Scenario>& scenarios, std::vector<std::string>& errors) {
  std::map<std::string, std::string> taken;
  if (scenarios.size() > 1)
    taken = {{"index.html", "the suite's index"},
             {"junit.xml", "the suite's JUnit file"},
             {"suite.json", "the suite's summary"}};
  for (const Scenario& scenario : scenarios) {
    const auto [holder, is_new] = taken.emplace(scenario.name, scenario.file.string());
    if (!is_new)
      errors.push_back(fmt::format("{}: error: name = '{}' is also that of {}, expected a name for each",
                                   scenario.file.string(), scenario.name, holder->second));
  }
}

/// Scenarios are handed out one by one to whichever thread is free; each writes where no other does.
class SuiteRun {
 public:
  SuiteRun(const std::vector<Scenario>& scenarios, const std::filesystem::path& dir, const SuiteOptions& options)
      : scenarios_(scenarios), dir_(dir), options_(options), entries_(scenarios.size()) {}

  std::vector<SuiteEntry> run() {
    const std::size_t count = std::min(static_cast<std::size_t>(options_.jobs), scenarios_.size());
    std::vector<std::thread> threads;
    for (std::size_t i = 1; i < count; ++i) threads.emplace_back([this] { work(); });
    work();
    for (std::thread& thread : threads) thread.join();
    if (broken_) std::rethrow_exception(broken_);
    return std::move(entries_);
  }

 private:
  void work() {
    try {
      for (std::size_t i = next_++; i < scenarios_.size(); i = next_++) {
        entries_[i] = judgeOne(scenarios_[i]);
        const std::lock_guard<std::mutex> lock(mutex_);
        ++done_;
        if (options_.finished) options_.finished(entries_[i], done_);
      }
    } catch (...) {
      next_ = scenarios_.size();  // the others stop after what they are at
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!broken_) broken_ = std::current_exception();
    }
  }

  SuiteEntry judgeOne(const Scenario& scenario) const {
    const auto start = std::chrono::steady_clock::now();
    SuiteEntry entry;
    std::optional<ValidationResult> result;
    try {
      result = options_.judge(scenario);
    } catch (const std::exception& error) {
      entry.scenario = scenario.name;
      entry.folder = scenario.name;
      entry.error = error.what();
    }
    if (result) {
      writeResults(*result, dir_ / scenario.name, Place::in_suite);
      entry = suiteEntry(*result, scenario.name, 0);
    } else {
      std::filesystem::remove(dir_ / scenario.name / "summary.json");  // of an older run
    }
    entry.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return entry;
  }

  const std::vector<Scenario>& scenarios_;
  const std::filesystem::path& dir_;
  const SuiteOptions& options_;
  std::vector<SuiteEntry> entries_;
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;  // guards what follows
  std::size_t done_ = 0;
  std::exception_ptr broken_;
};

}  // namespace

std::vector<Scenario> readSuite(const std::vector<std::filesystem::path>& arguments) {
  std::vector<Scenario> scenarios;
  std::vector<std::string> errors;
  for (const std::filesystem::path& file : scenarioFiles(arguments, errors)) {
    try {
      scenarios.push_back(readScenario(file));
      tryMotion(scenarios.back());
    } catch (const ScenarioError& error) {
      errors.emplace_back(error.what());  // begins with file:line:column
    }
  }
  checkNames(scenarios, errors);
  if (!errors.empty()) throw ScenarioError(fmt::format("{}", fmt::join(errors, "\n")));
  return scenarios;
}

std::vector<SuiteEntry> runSuite(const std::vector<Scenario>& scenarios, const std::filesystem::path& dir,
                                 const SuiteOptions& options) {
  if (options.jobs < 1) throw std::invalid_argument(fmt::format("{} jobs, expected at least 1", options.jobs));
  std::filesystem::remove(dir / "index.html");  // until the new one there is none: its presence means all is there
  std::vector<SuiteEntry> entries = SuiteRun(scenarios, dir, options).run();
  writeSuiteIndex(entries, dir);
  return entries;
}

}  // namespace ursula
