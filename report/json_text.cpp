#include "report/json_text.h"

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

/// Escapes text that could end a script, and characters that HTML does not have.
std::string jsonText(const std::string& words) {
  std::string out = nlohmann::json(words).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  for (const auto& [odd, escape] :
       {std::pair<std::string, const char*>{"<", "\\u003c"}, {"\xEF\xBF\xBE", "\\ufffe"}, {"\xEF\xBF\xBF", "\\uffff"}})
    for (std::size_t at = out.find(odd); at != std::string::npos; at = out.find(odd, at))
      out.replace(at, odd.size(), escape);
  return out;
}

}  // namespace ursula::report
