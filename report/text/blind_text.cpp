#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "report/text/quantity.h"
#include "report/text/terminal.h"

namespace ursula::report {
namespace {

/// Mistakes with one sentence but for the body's or joint's name.
struct SameMistake {
  std::string without;              ///< the sentence without " of 'crank'", of a number without its values
  std::vector<std::string> owners;  ///< bodies or joints; empty for one of the whole machine
  std::size_t at = 0, count = 0;
};

/// " of 'a', 'b', 'c', and 4 more"; several bodies together are not named again after each of them.
std::string ofOwners(std::vector<std::string> owners) {
  constexpr std::size_t most_named = 3;
  const auto isTogether = [](const std::string& owner) { return owner.find(", ") != std::string::npos; };
  if (!std::all_of(owners.begin(), owners.end(), isTogether))
    owners.erase(std::remove_if(owners.begin(), owners.end(), isTogether), owners.end());
  std::string out;
  for (std::size_t k = 0; k < owners.size() && k < most_named; ++k)
    out += fmt::format("{}'{}'", out.empty() ? " of " : ", ", owners[k]);
  return owners.size() > most_named ? out + fmt::format(", and {} more", owners.size() - most_named) : out;
}

SameMistake sameMistake(const BlindSpot& one) {
  const std::string& name = one.cause.joint.empty() ? one.cause.body : one.cause.joint;
  const std::string owner = " of '" + name + "'";
  const std::size_t at = one.mistake.find(owner);
  if (at == std::string::npos) return {one.mistake, {}, at, 1};
  const bool has_values = one.cause.kind == CauseKind::parameter;
  return {one.mistake.substr(0, at) + (has_values ? "" : one.mistake.substr(at + owner.size())), {name}, at, 1};
}

}  // namespace

std::vector<BlindSpot> alikeAsOne(const std::vector<BlindSpot>& blind) {
  std::vector<BlindSpot> out;
  std::vector<SameMistake> same;
  for (const BlindSpot& one : blind) {
    SameMistake mistake = sameMistake(one);
    const auto known = std::find_if(same.begin(), same.end(),
                                    [&](const SameMistake& each) { return each.without == mistake.without; });
    if (known == same.end() || mistake.owners.empty()) {
      same.push_back(std::move(mistake));
      out.push_back(one);
    } else {
      known->owners.push_back(mistake.owners.front());
      ++known->count;
    }
  }
  for (std::size_t k = 0; k < out.size(); ++k) {
    const SameMistake& all = same[k];
    if (all.count == 1) continue;
    out[k].mistake = all.at == std::string::npos
                         ? all.without + " (also that" + ofOwners(all.owners) + " alone)"
                         : all.without.substr(0, all.at) + ofOwners(all.owners) + all.without.substr(all.at);
  }
  return out;
}

std::string blindText(const std::vector<BlindSpot>& all) {
  constexpr std::size_t most = 10;
  const std::vector<BlindSpot> blind = alikeAsOne(all);
  std::string out;
  std::set<std::string> said;
  for (const BlindSpot& one : blind) {
    const bool is_new = said.insert(one.cause.term.empty() ? name(one.cause.kind) : one.cause.term).second;
    if (is_new && said.size() <= most) out += "  - " + prettyUnit(one.mistake) + "\n";
  }
  if (out.empty()) return "";
  const std::size_t shown = std::min(most, said.size());
  if (shown < blind.size()) out += fmt::format("  - and {} more: --json lists all\n", blind.size() - shown);
  return "not shown by this machine and motion, if a solver makes the mistake:\n" + out;
}

}  // namespace ursula::report
