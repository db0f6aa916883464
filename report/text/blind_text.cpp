#include <fmt/format.h>

#include <set>
#include <string>

#include "report/text/terminal.h"

namespace ursula::report {

std::string blindText(const std::vector<BlindSpot>& blind) {
  constexpr std::size_t most = 10;
  std::string out;
  std::set<std::string> said;
  for (const BlindSpot& one : blind) {
    const bool is_new = said.insert(one.cause.term.empty() ? name(one.cause.kind) : one.cause.term).second;
    if (is_new && said.size() <= most) out += "  - " + one.mistake + "\n";
  }
  if (out.empty()) return "";
  const std::size_t shown = std::min(most, said.size());
  if (shown < blind.size()) out += fmt::format("  - and {} more: --json lists all\n", blind.size() - shown);
  return "not shown by this machine and motion, if a solver makes the mistake:\n" + out;
}

}  // namespace ursula::report
