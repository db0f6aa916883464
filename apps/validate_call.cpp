#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "apps/ci_findings.h"
#include "apps/files_apart.h"
#include "apps/mechanism.h"
#include "apps/output.h"
#include "apps/progress.h"
#include "apps/suggest.h"
#include "apps/suite/suite.h"
#include "apps/validate_call.h"
#include "apps/validate_inputs.h"
#include "apps/verbs.h"
#include "base/output_folder.h"
#include "model/scenario.h"
#include "model/scenario_files.h"
#include "report/files/report.h"
#include "report/files/run.h"
#include "report/files/written_files.h"
#include "validation/outside/external_solver.h"
#include "validation/outside/given_motion.h"
#include "validation/validate.h"

namespace ursula {
namespace {

/// Default time limit per scenario of a suite, s, because nobody watches it.
constexpr double suite_time_limit = 600;

/// "3 min", "5 h"
std::string roughTime(double seconds) {
  constexpr double minute = 60, hour = 3600, day = 86400;
  if (seconds < 2 * hour) return fmt::format("{:.0f} min", seconds / minute);
  return seconds < 2 * day ? fmt::format("{:.0f} h", seconds / hour) : fmt::format("{:.3g} days", seconds / day);
}

/// Announces long work before it starts, and what ends it.
void sayWork(const Scenario& scenario, const ValidateOptions& options) {
  constexpr double worth_a_word = 60;  // s: shorter work is not announced
  const double time_limit = options.time_limit;
  if (!options.other.solver.command.empty() && options.thorough && !(time_limit > 0))
    say("{}: asks the solver 20,000 times or more; without --thorough at most 2,000 times\n", scenario.name);
  const double estimate = estimatedSeconds(scenario);
  if (!(estimate > worth_a_word)) return;
  const std::string ends =
      time_limit > 0 ? fmt::format("ends after {:g} s", time_limit) : "--time-limit SECONDS ends it sooner";
  say("{}: about {} of work for {} samples of a motion of {:g} s; {}\n", scenario.name, roughTime(estimate),
      scenario.simulation.samples, scenario.trajectory->duration(), ends);
}

ValidationResult judgeCommand(const Scenario& scenario, const OtherSubject& other,
                              const ValidationOptions& validation) {
  return other.simulates ? validateExternalSimulator(scenario, other.solver, validation)
                         : validateExternalSolver(scenario, other.solver, validation);
}

/// Judges this program's solver, another subject, or the torques or the motion of a file.
ValidationResult judge(const Scenario& scenario, const ValidateOptions& options) {
  const OtherSubject& other = options.other;
  const bool from_file = !other.torques.empty();
  const TorqueFile torques =
      from_file ? readTorquesAloud(other.torques, other.map, scenario.manipulator->motors()) : TorqueFile{};
  std::optional<Progress> progress;
  if (!options.quiet) {
    alongMotion(scenario, [&] { sayWork(scenario, options); });
    progress.emplace(scenario.name);
  }
  ExternalOptions external;
  external.time_limit = options.time_limit;
  external.threads = options.jobs;
  if (!other.trajectory.empty())
    return validateMotion(scenario, other.trajectory, from_file ? &torques : nullptr, external);
  if (from_file) return validateExternal(scenario, torques, external);
  ValidationOptions validation;
  validation.time_limit = options.time_limit;
  validation.thorough = options.thorough;
  if (progress) validation.progress = [&progress](double share, const char* now) { progress->at(share, now); };
  if (!other.solver.command.empty()) return judgeCommand(scenario, other, validation);
  validation.threads = options.jobs;
  return validate(scenario, validation);
}

/// Judges a member of either kind.
ValidationResult judge(const SuiteMember& member, const ValidateOptions& options) {
  if (member.scenario) return judge(*member.scenario, options);
  MechanismOptions validation;
  validation.time_limit = options.time_limit;
  validation.thorough = options.thorough;
  std::optional<Progress> progress;
  if (!options.quiet) progress.emplace(member.name);
  if (progress) validation.progress = [&progress](double share, const char* now) { progress->at(share, now); };
  return judgeMechanism(*member.mechanism, options.other, validation);
}

/// Prints findings in a form for CI.
void printFindings(const std::string& format, const std::vector<JudgedFile>& judged) {
  writeOutput("-", format == "github" ? githubText(judged) : sarifText(judged));
}

/// Prints results in the form that was asked for, by `print` if that is no form for CI, and what changed since an
/// earlier run. The folders of `entries` are below `dir`.
void printAll(const std::vector<SuiteMember>& members, const std::vector<SuiteEntry>& entries,
              const std::filesystem::path& dir, const ValidateOptions& options, const std::vector<std::string>& older,
              const std::function<void()>& print) {
  std::vector<JudgedFile> judged;
  for (std::size_t k = 0; k < members.size(); ++k) {
    const SuiteEntry& entry = entries[k];
    judged.push_back(
        {members[k].file.string(),
         entry.error.empty() ? summaryIn(dir / entry.folder) : report::errorJson(members[k].name, entry.error),
         entry.cause});
  }
  options.format.empty() ? print() : printFindings(options.format, judged);
  if (options.against.empty()) return;
  std::string changes;
  for (std::size_t k = 0; k < members.size(); ++k)
    changes += fmt::format("{}, since {}:\n{}", members[k].name, shownPath(options.against),
                           changesSince(older[k], judged[k].summary));
  const bool data_alone = options.json || !options.format.empty();
  data_alone ? sayText(changes) : writeOutput("-", changes);
}

int validateOne(const SuiteMember& member, const ValidateOptions& options, const std::filesystem::path& dir) {
  OutputFolder out(dir, report::resultsIn);
  requireResults(out, "");
  const std::vector<std::string> older = {options.against.empty() ? "" : summaryIn(options.against)};
  const Stopwatch watch;
  ValidationResult result = judge(member, options);
  result.blind = blindSpotsOf(member.scenario ? &*member.scenario : nullptr, member.mechanism.get());
  addResults(result, out, "", watch.time(), Place::alone);
  out.commit();
  printAll({member}, {suiteEntry(result, "")}, dir, options, older, [&] { printResult(result, dir, options.form()); });
  return exitCode(result.verdict);
}

/// Shows a bar over all scenarios, or a line per scenario.
class SuiteProgress {
 public:
  explicit SuiteProgress(std::size_t total) : total_(total), bar_("validate", Progress::Lines::none) {}

  void finished(const SuiteEntry& entry, std::size_t done) {
    const bool passed = entry.error.empty() && entry.verdict == Verdict::pass;
    not_passed_ += passed ? 0 : 1;
    const std::string missed = not_passed_ > 0 ? fmt::format(", {} not passed", not_passed_) : "";
    bar_.at(static_cast<double>(done) / static_cast<double>(total_), fmt::format("{} of {}{}", done, total_, missed));
    if (!bar_.onTerminal())
      say("[{}/{}] {} {}, {:.1f} s\n", done, total_, entry.error.empty() ? name(entry.verdict) : "error",
          entry.scenario, entry.time.seconds);
  }

 private:
  std::size_t total_, not_passed_ = 0;
  Progress bar_;
};

/// Judges the efforts beside a scenario, or what the options name.
ValidationResult judgeInSuite(const SuiteMember& member, const ValidateOptions& options,
                              const ValidationOptions& validation) {
  const bool from_file = !member.torques.empty() && options.other.solver.command.empty();
  if (member.mechanism) {
    MechanismOptions of_mechanism;
    of_mechanism.time_limit = validation.time_limit;
    of_mechanism.thorough = validation.thorough;
    OtherSubject other = options.other;
    if (from_file) {
      other.torques = member.torques.string();
      other.map = member.mechanism->mapped;
    }
    return judgeMechanism(*member.mechanism, other, of_mechanism);
  }
  const Scenario& scenario = *member.scenario;
  if (from_file)
    return validateExternal(scenario, readTorqueFile(member.torques, {}, scenario.manipulator->motors()),
                            validation.time_limit);
  return options.other.solver.command.empty() ? validate(scenario, validation)
                                              : judgeCommand(scenario, options.other, validation);
}

int validateSuite(const std::vector<SuiteMember>& members, const ValidateOptions& options,
                  const std::filesystem::path& dir) {
  for (const SuiteMember& member : members)
    if (!member.error.empty()) say("{}\n", member.at_length.empty() ? member.error : member.at_length);
  SuiteOptions suite;
  suite.jobs = options.jobs;
  ValidationOptions validation;
  validation.time_limit = options.time_limit > 0 ? options.time_limit : suite_time_limit;
  validation.thorough = options.thorough;
  suite.judge = [validation, &options](const SuiteMember& member) {
    if (!options.quiet && member.scenario && member.torques.empty()) sayWork(*member.scenario, options);
    ValidationResult result = judgeInSuite(member, options, validation);
    result.blind = blindSpotsOf(member.scenario ? &*member.scenario : nullptr, member.mechanism.get());
    return result;
  };
  std::optional<SuiteProgress> progress;
  if (!options.quiet) progress.emplace(members.size());
  suite.finished = [&progress](const SuiteEntry& entry, std::size_t done) {
    if (progress) progress->finished(entry, done);
  };
  std::vector<std::string> older;
  for (const SuiteMember& member : members)
    older.push_back(options.against.empty() ? "" : summaryIn(std::filesystem::path(options.against) / member.name));
  const std::vector<SuiteEntry> entries = runSuite(members, dir, suite);
  progress.reset();
  printAll(members, entries, dir, options, older, [&] { printSuite(entries, dir, options.form()); });
  return exitCode(entries);
}

std::shared_ptr<const MechanismScenario> withTolerance(const EffortTolerance& users, MechanismScenario scenario) {
  setTolerance(users, scenario.tolerance);
  return std::make_shared<const MechanismScenario>(std::move(scenario));
}

/// Judges all; `refused` gets the scenarios for whose errors it throws.
int judgeAll(const ValidateOptions& options, std::vector<JudgedFile>& refused) {
  if (std::count(options.scenarios.begin(), options.scenarios.end(), "-") > 1)
    throw UsageError("standard input can be read once, expected one -");
  std::error_code ignored;
  if (!options.against.empty() && !std::filesystem::is_directory(options.against, ignored))
    throw UsageError(fmt::format("--against {}: no such folder, expected that of an earlier run's results",
                                 shownPath(options.against)));
  std::vector<SuiteMember> members = readSuite({options.scenarios.begin(), options.scenarios.end()}, options.other.map);
  for (const SuiteMember& member : members) {
    if (member.scenario) sayWarnings(*member.scenario);
    if (member.mechanism && !member.mechanism->motion_read_as.empty()) say("{}\n", member.mechanism->motion_read_as);
  }
  const bool none_good =
      std::none_of(members.begin(), members.end(), [](const auto& each) { return each.error.empty(); });
  if (options.strict || none_good) {
    for (const SuiteMember& member : members)
      if (!member.error.empty())
        refused.push_back({member.file.string(), report::errorJson(member.name, member.error)});
    members = allOrNothing(std::move(members));
  }
  requireConsistent(options, members);
  for (SuiteMember& member : members) {
    if (member.scenario) setTolerance(options.tolerance, *member.scenario);
    if (member.mechanism) member.mechanism = withTolerance(options.tolerance, *member.mechanism);
  }
  const std::filesystem::path dir = folderOf(options, members);
  if (const auto input = report::replacedInput(inputsOf(options, members), dir); !input.empty())
    refuseToReplace(dir.string(), input);
  return isSuite(options, members) ? validateSuite(members, options, dir) : validateOne(members.front(), options, dir);
}

}  // namespace

int validateAll(const ValidateOptions& options) {
  std::vector<JudgedFile> refused;
  try {
    return judgeAll(options, refused);
  } catch (const std::exception& error) {
    const std::string& first = options.scenarios.front();
    if (refused.empty()) refused.push_back({first, report::errorJson(first, error.what())});
    if (!options.format.empty()) printFindings(options.format, refused);
    throw;
  }
}

}  // namespace ursula
