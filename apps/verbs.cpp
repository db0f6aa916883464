#include "apps/verbs.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>

#include "apps/files_apart.h"
#include "apps/output.h"
#include "apps/suite/no_model.h"
#include "base/text.h"
#include "model/scenario_files.h"
#include "report/files/run.h"
#include "validation/check_scenario/check_scenario.h"

namespace ursula {
namespace {

CLI::Validator finite(const char* what, bool (*fits)(double)) {
  const auto check = [what, fits](const std::string& text) {
    const LeadingNumber read = leadingNumber(text);
    const bool is_number = !text.empty() && read.length == text.size() && std::isfinite(read.value);
    return is_number && fits(read.value) ? std::string() : "'" + text + "' is not a " + what;
  };
  return CLI::Validator(check, "POSITIVE");
}

}  // namespace

CLI::Validator finitePositive() {
  return finite("finite number above 0", [](double value) { return value > 0; });
}

std::string withoutPercent(std::string text) {
  const std::optional<double> share = percentage(text);
  return share ? fmt::format("{}", *share) : text;
}

CLI::Validator finiteNotNegative() {
  return finite("finite number of 0 or more", [](double value) { return value >= 0; }).description("NONNEGATIVE");
}

CLI::Validator wholeNumber() {
  const auto check = [](const std::string& text) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_whole = error == std::errc() && end == text.data() + text.size();
    return is_whole ? std::string() : fmt::format("'{}' is not an integer from 0 to {}", text, UINT64_MAX);
  };
  return CLI::Validator(check, "UINT64");
}

void sayWarnings(const Scenario& scenario) {
  for (const std::string& line : readAs(scenario)) say("{}\n", line);
  for (const std::string& line : warnings(scenario)) say("{}\n", line);
}

Scenario openScenario(const std::string& file, std::initializer_list<std::string> written) {
  Scenario scenario = parseScenario(scenarioNotModel(file), namedInput(file));
  requireApart(scenario, written);
  sayWarnings(scenario);
  return scenario;
}

void writeOutput(const std::string& file, const std::string& content) {
  Output out(file);
  out.write(content);
  out.commit();
}

void refuseFile(const std::string& out) {
  if (std::filesystem::exists(out) && !std::filesystem::is_directory(out))
    throw UsageError("--out " + out + ": is a file, expected a folder");
}

void refuseResults(const std::filesystem::path& out) {
  if (!report::resultsIn(out).empty())
    throw UsageError("--out " + out.string() + ": has the results of a validation, expected another folder");
}

}  // namespace ursula
