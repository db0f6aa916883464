#include <fmt/format.h>

#include <functional>
#include <memory>

#include "apps/validate_call.h"
#include "apps/verbs.h"
#include "apps/watch.h"

namespace ursula {
namespace {

void addOutputOptions(CLI::App& verb, ValidateOptions& options) {
  verb.add_option("--out", options.out,
                  "Folder of the results; default results/NAME, for several scenarios or a folder results/suite");
  CLI::Option* json = verb.add_flag("--json", options.json,
                                    "Prints only the summary on standard output, as in summary.json; for several "
                                    "scenarios or a folder an array of them.\n"
                                    "A scenario in error then has scenario, verdict \"error\" and error");
  CLI::Option* quiet = verb.add_flag("--quiet", options.quiet,
                                     "Prints one line for each scenario: verdict, reason, likely cause; no progress");
  quiet->excludes(json);
  verb.add_flag("--verbose", options.verbose, "Prints every check with value, limit and share of the limit")
      ->excludes(json)
      ->excludes(quiet);
  verb.add_option("--format", options.format,
                  "Prints findings for CI on standard output instead: github (workflow commands), sarif (SARIF 2.1.0)")
      ->check(CLI::IsMember({"github", "sarif"}))
      ->excludes(json);
  verb.add_option("--against", options.against,
                  "Folder of an earlier run's results: also prints what changed since. May be that of --out");
}

void addOtherSolvers(CLI::App& verb, ValidateOptions& options) {
  CLI::Option* torques =
      verb.add_option("--torques", options.other.torques,
                      "Judges the torques or forces of this CSV file instead: t_s and tau_1_Nm … tau_6_Nm,\n"
                      "tau_1_N … for motors that slide");
  CLI::Option* solver = verb.add_option(
      "--solver", options.other.solver.command,
      "Judges this command instead. sh starts it once for each scenario. It reads the motion line by line on its "
      "standard input\n"
      "(t,p,q,v,w,a,alpha: 20 values, separated by commas) and answers each line with six torques or forces");
  const auto a_command = [](const std::string& command) {
    return command.empty() ? std::string("expected a command") : std::string();
  };
  solver->excludes(torques)->check(a_command);
  CLI::Option* simulator = verb.add_option_function<std::string>(
      "--simulator",
      [&options](const std::string& command) {
        options.other.solver.command = command;
        options.other.simulates = true;
      },
      "Judges this command's direct dynamics instead. It reads t,p,q,v,w and six efforts and answers each line with\n"
      "the platform's acceleration, a_x,a_y,a_z,alpha_x,alpha_y,alpha_z");
  simulator->excludes(torques)->excludes(solver)->check(a_command);
  verb.add_option("--trajectory", options.other.trajectory,
                  "Judges the motion of this CSV file instead, made under the efforts of --torques or the right ones:\n"
                  "t_s and poses, or the coordinates of a mechanism's motors")
      ->excludes(solver)
      ->excludes(simulator);
  verb.add_option("--solver-timeout", options.other.solver.timeout, "Longest wait for an answer of that command, s")
      ->check(finitePositive())
      ->check(CLI::Range(1e-3, 1e6))
      ->capture_default_str()
      ->check([&options](const std::string&) {
        return options.other.solver.command.empty() ? std::string("expected also --solver or --simulator") : "";
      });
  verb.add_flag("--thorough", options.thorough,
                "Asks that command at every instant that an integrator wants, some 20,000; else at most 2,000 times")
      ->needs(solver);
  addMapOption(verb, options.other.map);
}

}  // namespace

void addValidate(CLI::App& app, std::function<int()>& run) {
  const auto options = std::make_shared<ValidateOptions>();
  CLI::App* verb = app.add_subcommand("validate", "Judges motor efforts by comparison with Simbody, and says why");
  verb->group(judging);
  verb->add_option("scenario", options->scenarios,
                   "Scenario files (TOML), or folders: each *.toml in it, sorted; - for standard input")
      ->required();
  addOutputOptions(*verb, *options);
  verb->add_option("--jobs", options->jobs,
                   "Scenarios judged at a time; for one scenario, threads. Results do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  verb->add_option(
          "--time-limit", options->time_limit,
          "Wall time for each scenario, s. Unfinished checks are inconclusive (exit 3); the report is written.\n"
          "Default: no limit for one scenario, 600 for each of several")
      ->check(finitePositive());
  verb->add_flag("--strict", options->strict,
                 "Computes and writes nothing unless every scenario can be read and has a valid motion");
  addOtherSolvers(*verb, *options);
  verb->add_option(
          "--rtol", options->tolerance.relative,
          "Largest error of torques or forces that passes, relative to the largest effort of the motion, also as 1%;\n"
          "takes precedence over [acceptance] torque")
      ->check(finitePositive())
      ->transform(withoutPercent);  // runs first, because transforms run in reverse order
  verb->add_option("--atol", options->tolerance.absolute,
                   "Largest error that passes, N·m or N; added to that of --rtol")
      ->check(finitePositive());
  verb->add_flag("--any-tolerance", options->tolerance.any, "Accepts even a tolerance at which zeros would pass");
  verb->footer(
      "Example: ursula validate my.toml --torques mine.csv\n"
      "Several scenarios: each gets a folder under DIR, and all share index.html and junit.xml. A folder with one\n"
      "scenario is treated alike. A scenario that cannot be read, is out of reach or is singular counts as an error,\n"
      "and the others are judged. Nothing is written (exit 2) if all are in error, if two share a name, or if any is\n"
      "in error with --strict.\n"
      "Exit code: 1 if any failed or was in error, else 3 if any was inconclusive, else 0.");
  verb->add_flag("--watch", options->watch,
                 "Judges again when a scenario, a file that it names, or the judged file changes, until Ctrl-C");
  verb->callback([options, &run] {
    run = [options] {
      const auto judge = [options] { return validateAll(*options); };
      return options->watch ? watched(judge, [options] { return watchedFiles(*options); }) : judge();
    };
  });
}

}  // namespace ursula
