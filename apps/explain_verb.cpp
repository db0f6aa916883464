#include <memory>
#include <stdexcept>

#include "apps/verbs.h"
#include "report/text/result_facts.h"

namespace ursula {
namespace {

std::string explained(const std::string& check) {
  try {
    return report::explanation(check);
  } catch (const std::invalid_argument& unknown) {
    throw UsageError(std::string(unknown.what()) + " (ursula explain lists all)");
  }
}

}  // namespace

void addExplain(CLI::App& app, std::function<int()>& run) {
  const auto check = std::make_shared<std::string>();
  CLI::App* verb = app.add_subcommand(
      "explain", "Explains what a check proves, where its limit comes from and what to do when it fails");
  verb->group(reading)->footer("Example: ursula explain torque.pointwise");
  verb->add_option("check", *check, "Name of a check, such as torque.pointwise; without it all are listed");
  verb->callback([check, &run] {
    run = [check] {
      writeOutput("-", check->empty() ? report::explanations() : explained(*check));
      return exit_passed;
    };
  });
}

}  // namespace ursula
