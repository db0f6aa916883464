#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <thread>

#include "apps/suite_progress.h"
#include "apps/torque_option.h"
#include "apps/verbs.h"
#include "model/scenario.h"
#include "validation/outside/external_solver.h"
#include "validation/report/report.h"
#include "validation/suite/suite.h"
#include "validation/validate.h"
#include "validation/validate_external.h"

namespace ursula {
namespace {

struct ValidateOptions {
  std::vector<std::string> scenarios, map;
  std::string torques, out;
  ExternalSolverOptions solver;  ///< with a command, it is judged
  double rtol = 0, atol = 0;     ///< 0: not given
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
};

int exitCode(Verdict verdict) {
  switch (verdict) {
    case Verdict::pass:
      return exit_passed;
    case Verdict::inconclusive:
      return exit_inconclusive;
    case Verdict::fail:
    case Verdict::not_applicable:
      break;
  }
  return exit_failed;
}

void printChecks(const ValidationResult& result) {
  fmt::print("{}: {}\n", result.scenario, name(result.verdict));
  for (const Check& check : result.checks)
    if (check.verdict != Verdict::not_applicable)
      fmt::print("  {:<12} {:<32} {:>10.3g} of {:>10.3g} {}\n", name(check.verdict), check.name, check.value,
                 check.limit, check.unit);
  for (const Check& check : result.checks)
    if (check.reason == Reason::reported)
      fmt::print("  {:<12} {:<32} {:>10.3g} {}\n", "not judged", check.name, check.value, check.unit);
  std::map<std::string, std::vector<std::string>> not_applicable;  // by reason
  for (const Check& check : result.checks)
    if (check.reason == Reason::not_applicable) not_applicable[check.why].push_back(check.name);
  for (const auto& [why, checks] : not_applicable)
    fmt::print("  not applicable, since {}: {}\n", why, fmt::join(checks, ", "));
}

std::string text(const SourceOfError& source) {
  return fmt::format("{:.3g} m +- {:.2g} m", source.error, source.uncertainty);
}

/// What moved the replay off the path, and what is known of torques that are wrong. A clean pass needs neither.
void printReasons(const ValidationResult& result) {
  if (result.replay_error && result.verdict != Verdict::pass) {
    const ReplayError& found = *result.replay_error;
    fmt::print("dominant error: {}", found.dominant);
    if (found.measured)
      fmt::print(
          "; replay off by {:.3g} m at t = {:.6g} s; of it by rounding {}, integration {}, gaps {}, torques {}; "
          "deviations grow {:.4g}-fold",
          found.observed, found.t, text(found.rounding), text(found.integration), text(found.closure),
          text(found.model), found.amplification);
    fmt::print("\n");
  }
  if (result.likely_cause)
    fmt::print("torques that are off: {}\nlikely cause: {}\n", result.likely_cause->off, result.likely_cause->cause);
}

/// Judges this program's solver, somebody else's, or the torques of a file.
ValidationResult judge(const Scenario& scenario, const ValidateOptions& options) {
  if (!options.solver.command.empty()) return validateExternalSolver(scenario, options.solver);
  if (options.torques.empty()) return validate(scenario);
  return validateExternal(scenario, readTorquesAloud(options.torques, options.map));
}

int validateOne(const Scenario& scenario, const ValidateOptions& options, const std::filesystem::path& dir) {
  const ValidationResult result = judge(scenario, options);
  writeResults(result, dir);
  printChecks(result);
  printReasons(result);
  fmt::print("verdict: {} — {}\n", name(result.verdict), reason(result.verdict, result.checks));
  if (result.deviation) fmt::print("{}\n", sentence(*result.deviation));
  fmt::print("report: {}\n", (dir / "report.html").string());
  return exitCode(result.verdict);
}

/// A line for each scenario in the order given, then the totals.
void printSuite(const std::vector<SuiteEntry>& entries, const std::filesystem::path& dir) {
  std::size_t width = 0;
  for (const SuiteEntry& entry : entries) width = std::max(width, entry.scenario.size());
  for (const SuiteEntry& entry : entries) {
    const Check* worst = worstCheck(entry.checks);
    const std::string why = worst == nullptr ? entry.error : worst->name + " " + standing(*worst);
    const std::string report = entry.error.empty() ? (dir / entry.folder / "report.html").string() : "no report";
    fmt::print("{:<12}  {:<{}}  {}  {}\n", name(entry.verdict), entry.scenario, width, why, report);
  }
  const auto count = [&entries](Verdict verdict) {
    return std::count_if(entries.begin(), entries.end(),
                         [verdict](const SuiteEntry& entry) { return entry.verdict == verdict; });
  };
  fmt::print("{} passed, {} failed, {} inconclusive\nindex: {}\n", count(Verdict::pass), count(Verdict::fail),
             count(Verdict::inconclusive), (dir / "index.html").string());
}

int exitCode(const std::vector<SuiteEntry>& entries) {
  const auto any = [&entries](Verdict verdict) {
    return std::any_of(entries.begin(), entries.end(),
                       [verdict](const SuiteEntry& entry) { return entry.verdict == verdict; });
  };
  if (any(Verdict::fail)) return exit_failed;
  return any(Verdict::inconclusive) ? exit_inconclusive : exit_passed;
}

int validateSuite(const std::vector<Scenario>& scenarios, int jobs, const std::filesystem::path& dir) {
  SuiteOptions suite;
  suite.jobs = jobs;
  suite.judge = [](const Scenario& scenario) { return validate(scenario); };
  std::optional<SuiteProgress> progress(scenarios.size());
  suite.finished = [&progress](const SuiteEntry& entry, std::size_t done) { progress->finished(entry, done); };
  const std::vector<SuiteEntry> entries = runSuite(scenarios, dir, suite);
  progress.reset();
  printSuite(entries, dir);
  return exitCode(entries);
}

/// Everything that can be refused is refused here, before anything is computed or written.
int validateAll(const ValidateOptions& options) {
  std::vector<Scenario> scenarios = readSuite({options.scenarios.begin(), options.scenarios.end()});
  if (options.rtol > 0 || options.atol > 0)
    for (Scenario& scenario : scenarios) scenario.tolerance = EffortTolerance{options.rtol, options.atol};
  const bool is_suite = scenarios.size() > 1;
  for (const auto& [option, value] : {std::pair("--torques", options.torques), {"--solver", options.solver.command}})
    if (is_suite && !value.empty())
      throw UsageError(fmt::format("{} judges one motion, expected one scenario, not {}", option, scenarios.size()));
  if (!options.map.empty() && options.torques.empty())
    throw UsageError("--map names columns, expected --torques FILE.csv");
  const std::filesystem::path by_name = is_suite ? "suite" : scenarios.front().name;
  const std::filesystem::path dir = options.out.empty() ? "results" / by_name : std::filesystem::path(options.out);
  refuseFile(dir.string());
  return is_suite ? validateSuite(scenarios, options.jobs, dir) : validateOne(scenarios.front(), options, dir);
}

}  // namespace

void addValidate(CLI::App& app, std::function<int()>& run) {
  const auto options = std::make_shared<ValidateOptions>();
  CLI::App* verb = app.add_subcommand("validate", "Judge the torques of a scenario against Simbody, with reasons");
  verb->add_option("scenario", options->scenarios, "Scenario files (TOML), or folders: each *.toml in it, sorted")
      ->required();
  verb->add_option("--out", options->out,
                   "Folder of the results; default results/NAME, for several scenarios results/suite");
  verb->add_option("--jobs", options->jobs, "Scenarios judged at a time; results are the same for any number")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  CLI::Option* torques = verb->add_option(
      "--torques", options->torques, "CSV of somebody else's torques to judge instead: t_s and tau_1_Nm … tau_6_Nm");
  CLI::Option* solver = verb->add_option(
      "--solver", options->solver.command,
      "Command to judge instead: started once by sh, it answers each line of a motion on its standard\n"
      "input (t,p,q,v,w,a,alpha: 20 values with commas) with a line of six torques");
  solver->excludes(torques)->check(
      [](const std::string& command) { return command.empty() ? std::string("expected a command") : std::string(); });
  verb->add_option("--solver-timeout", options->solver.timeout, "For an answer of that command, s")
      ->check(CLI::Range(1e-3, 1e6))
      ->capture_default_str()
      ->needs(solver);
  addMapOption(*verb, options->map);
  verb->add_option("--rtol", options->rtol,
                   "Torques pass that are off by no more, relative to the largest effort of the motion; wins over\n"
                   "[acceptance] torque")
      ->check(CLI::PositiveNumber);
  verb->add_option("--atol", options->atol, "The same in N m; both are added")->check(CLI::PositiveNumber);
  verb->footer(
      "Several scenarios: one folder each under DIR, with index.html and one junit.xml over all. All are read and\n"
      "their motions tried before anything is computed or written: if one is wrong, out of reach or singular, or two\n"
      "share a name, nothing is written (exit 2). One that turns out impossible only later counts as failed.\n"
      "Exit: 1 if any failed, else 3 if any was inconclusive, else 0.");
  verb->callback([options, &run] { run = [options] { return validateAll(*options); }; });
}

}  // namespace ursula
