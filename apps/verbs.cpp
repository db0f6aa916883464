#include "apps/verbs.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "apps/output.h"

namespace ursula {
namespace {

CLI::Validator finite(const char* what, bool (*fits)(double)) {
  const auto check = [what, fits](const std::string& text) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    const bool is_number = !text.empty() && *end == '\0' && std::isfinite(value);
    return is_number && fits(value) ? std::string() : "'" + text + "' is no " + what;
  };
  return CLI::Validator(check, "POSITIVE");
}

}  // namespace

CLI::Validator finitePositive() {
  return finite("finite number above 0", [](double value) { return value > 0; });
}

CLI::Validator finiteNotNegative() {
  return finite("finite number of 0 or more", [](double value) { return value >= 0; }).description("NONNEGATIVE");
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

}  // namespace ursula
