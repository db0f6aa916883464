#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "base/text.h"
#include "parts/exchange/recognise/chains.h"

namespace ursula::exchange {
namespace {

constexpr double most_gap = 1e-3;  ///< of the machine's size, or rad
constexpr std::size_t most_assumptions = 500, most_bytes = 1000;

std::string cut(const std::string& text) { return text.size() <= most_bytes ? text : shown(text, most_bytes); }

}  // namespace

std::string inWords(const Assumption& assumption) {
  const std::string unit = assumption.unit == "1" ? "" : " " + assumption.unit;
  return fmt::format("{}{}: {} ({:.4g}{})", assumption.warning ? "warning: " : "", shown(assumption.where, 200),
                     shown(assumption.what, 300), assumption.size, unit);
}

std::string listed(const std::vector<std::string>& words) {
  constexpr std::size_t most = 12;
  const std::vector<std::string> first(words.begin(),
                                       words.begin() + static_cast<std::ptrdiff_t>(std::min(words.size(), most)));
  return fmt::format("{}{}", fmt::join(first, ", "),
                     words.size() > most ? fmt::format(", … {} more", words.size() - most) : "");
}

void sayGaps(const ModelGraph& graph, Assumptions more, double size, Assumptions& assumptions) {
  for (const GraphJoint& joint : graph.joints) {
    if (!joint.closure || joint.kind == JointKind::free) continue;
    const char* what = "This joint is open at the file's initial pose";
    more.push_back({what, joint.name, (joint.centre - joint.centre_of_child).norm(), "m"});
    more.push_back({what, joint.name, Eigen::AngleAxisd(joint.turn).angle(), "rad"});
  }
  for (Assumption& each : more) {
    const double share = each.unit == "m" ? each.size / size : each.size;
    if (!(share > (each.unit == "m" ? 1e-12 : 1e-9))) continue;
    each.warning = share > most_gap;
    assumptions.push_back(std::move(each));
  }
}

Assumptions inOrder(Assumptions assumptions) {
  std::map<std::pair<std::string, std::string>, std::pair<std::size_t, int>> known;
  Assumptions out;
  for (Assumption& each : assumptions) {
    const auto [found, is_new] = known.emplace(std::pair(each.what, each.where), std::pair(out.size(), 0));
    if (is_new || each.unit != out[found->second.first].unit)
      out.push_back(std::move(each));
    else if (++found->second.second)
      out[found->second.first].size = std::max(out[found->second.first].size, each.size);
  }
  for (const auto& [key, at] : known)
    if (at.second > 0) out[at.first].what += fmt::format(" (said {} times)", at.second + 1);
  std::stable_partition(out.begin(), out.end(), [](const Assumption& each) { return each.warning; });
  const std::size_t more = out.size() - std::min(out.size(), most_assumptions);
  out.resize(out.size() - more);
  for (Assumption& each : out) each.what = cut(each.what), each.where = cut(each.where);
  if (more > 0)
    out.push_back({"More assumptions than these are not listed", "the model", static_cast<double>(more), "1"});
  return out;
}

}  // namespace ursula::exchange
