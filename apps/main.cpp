#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <new>

#include "apps/files_apart.h"
#include "apps/output.h"
#include "apps/part_verbs.h"
#include "apps/usage.h"
#include "apps/verbs.h"
#include "base/errors.h"
#include "base/provenance.h"
#include "model/scenario_excerpt.h"
#include "nocsolver/errors.h"

namespace {

int complain(const std::string& what) {
  ursula::say("{}\n", what);
  return ursula::exit_bad_input;
}

int runVerb(const CLI::App& app, const std::function<int()>& run) {
  try {
    return run();
  } catch (const ursula::ScenarioError& error) {
    return complain(ursula::atLength(error));  // starts with file:line:column
  } catch (const ursula::InputError& error) {
    return complain(error.what());
  } catch (const ursula::PoseError& error) {
    return complain(fmt::format("error: the motion cannot be made: {}", error.what()));
  } catch (const std::bad_alloc&) {
    return complain("error: " + ursula::outOfMemory(app));
  } catch (const std::filesystem::filesystem_error& error) {
    std::error_code gone;
    static_cast<void>(std::filesystem::current_path(gone));
    return complain(fmt::format("error: {}{}{}", error.path1().empty() ? "" : error.path1().string() + ": ",
                                error.code().message(), gone ? ", as the working folder has been removed" : ""));
  } catch (const std::exception& error) {
    return complain(fmt::format("error: {}", error.what()));
  }
}

int runProgram(int argc, char** argv) {
  CLI::App app("ursula: judges the dynamics of machines with closed loops: hexapods, four-bars, legs, deltas",
               "ursula");
  app.set_version_flag("--version", ursula::buildProvenance().version + " (" + ursula::buildProvenance().commit + ")");
  app.require_subcommand(1);
  std::function<int()> run;
  for (ursula::AddVerb* add : {ursula::addValidate, ursula::addInverse, ursula::addInit, ursula::addCheck,
                               ursula::addExplain, ursula::addOpen})
    add(app, run);
  for (ursula::AddVerb* add : ursula::partVerbs()) add(app, run);
  ursula::refuseFlagValues(app);
  if (argc < 2) return complain(app.help());
  if (const std::string unknown = ursula::unknownVerb(app, argc, argv); !unknown.empty()) return complain(unknown);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return error.get_exit_code() == 0 ? app.exit(error) : complain(ursula::misuse(app, error));
  }
  if (const std::string empty = ursula::emptyValue(app); !empty.empty()) return complain(empty);
  if (const std::string odd = ursula::oddNumber(app); !odd.empty()) return complain(odd);
  if (const std::string twice = ursula::namedTwice(app); !twice.empty()) return complain("error: " + twice);
  return runVerb(app, run);
}

/// A pass counts only if its data reached the reader.
int finished(int code) {
  const std::string lost = code == ursula::exit_bad_input ? "" : ursula::lostOutput();
  return lost.empty() ? code : complain("error: " + lost);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    ursula::secureStreams();
    ursula::loadUnwinder();
    ursula::shareArenaInBoundedMemory();
    return finished(runProgram(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());  // the last resort must not throw
    return ursula::exit_bad_input;
  }
}
