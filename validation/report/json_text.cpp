#include "validation/report/json_text.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

namespace ursula::report {

void addNumber(double value, std::string& out) {
  if (std::isfinite(value))
    fmt::format_to(std::back_inserter(out), "{:.6g}", value);
  else
    out += "null";
}

std::string jsonNumbers(const std::vector<double>& values) { return jsonList(values, addNumber); }

std::string jsonText(const std::string& words) {
  std::string out;
  for (const char c : nlohmann::json(words).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace))
    out += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return out;
}

}  // namespace ursula::report
