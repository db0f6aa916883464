#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>

#include "apps/verbs.h"
#include "model/csv.h"
#include "model/errors.h"
#include "model/scenario.h"
#include "nocsolver/errors.h"
#include "validation/findings/provenance.h"

namespace {

int complain(const std::string& what) {
  fmt::print(stderr, "{}\n", what);
  return ursula::exit_bad_input;
}

int runVerb(const std::function<int()>& run) {
  try {
    return run();
  } catch (const ursula::ScenarioError& error) {
    return complain(error.what());  // begins with file:line:column
  } catch (const ursula::CsvError& error) {
    return complain(error.what());  // likewise
  } catch (const ursula::PoseError& error) {
    return complain(fmt::format("error: the motion cannot be made: {}", error.what()));
  } catch (const std::exception& error) {
    return complain(fmt::format("error: {}", error.what()));
  }
}

int runProgram(int argc, char** argv) {
  CLI::App app("ursula: are the closed-form dynamics of a six-legged U-R-S parallel manipulator right, and why");
  app.set_version_flag("--version", ursula::buildProvenance().version + " (" + ursula::buildProvenance().commit + ")");
  app.require_subcommand(1);
  app.failure_message(CLI::FailureMessage::help);
  std::function<int()> run;
  ursula::addValidate(app, run);
  ursula::addInverse(app, run);
  ursula::addInit(app, run);
  ursula::addCheck(app, run);
  ursula::addCompare(app, run);
  ursula::addDirect(app, run);
  ursula::addProve(app, run);
  ursula::addSimulate(app, run);
  ursula::addAudit(app, run);
  ursula::addPoses(app, run);
  ursula::addDocs(app, run);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? ursula::exit_passed : ursula::exit_bad_input;
  }
  return runVerb(run);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return runProgram(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());  // the last resort is not to throw itself
    return ursula::exit_bad_input;
  }
}
