#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.h"
#include "model/check_catalogue.h"
#include "parts/sweep/report/sweep_outputs.h"
#include "report/text/quantity.h"
#include "report/text/text.h"

namespace ursula {
namespace {

constexpr std::array<std::array<const char*, 2>, 6> verdict_words = {{{"pass", "passed"},
                                                                      {"fail", "failed"},
                                                                      {"error", "ended in an error"},
                                                                      {"inconclusive", "inconclusive"},
                                                                      {"out_of_reach", "out of reach"},
                                                                      {"singular", "singular"}}};

std::string percent(double share) {
  const double hundredths = 100 * share;
  return hundredths > 99.5 && hundredths < 100 ? "> 99\u00a0%" : fmt::format("{:.0f}\u00a0%", hundredths);
}

/// The number in words without its unit, for a sentence.
std::string bareWords(const std::string& key) {
  const std::string words = keyWords(key);
  return words.substr(0, words.rfind(" ("));
}

/// The motor and point of a group's largest value, or only the point.
std::string whereOf(const SweepSummary& summary, const SweepOutput& output) {
  const std::string point = fmt::format("at point\u00a0{}", output.worst_point);
  for (const SweepOutput& each : summary.outputs)
    if (output.kind == OutputKind::largest_effort && each.kind == OutputKind::effort && each.unit == output.unit &&
        each.spread.max == output.spread.max)
      return fmt::format("of motor\u00a0{} {}", each.motor + 1, point);
  return point;
}

/// "2,000 points, all passed", "3 points: 2 passed, 1 failed".
std::string countsOf(const SweepSummary& summary) {
  const std::string points = grouped(summary.points_done) + (summary.points_done == 1 ? " point" : " points");
  const bool judges = summary.identity.what == "validate";  // else "pass" says only that the motion can be made
  if (summary.verdicts.size() == 1)
    return points + (summary.points_done == 1 ? ": " : ", all ") +
           verdictWords(summary.verdicts.begin()->first, judges);
  std::string out;
  for (const auto& [verdict, of_judged] : verdict_words) {
    const auto at = summary.verdicts.find(verdict);
    if (at != summary.verdicts.end())
      out += fmt::format("{}{} {}", out.empty() ? "" : ", ", grouped(at->second), verdictWords(verdict, judges));
  }
  return points + ": " + out;
}

std::string primarySentence(const SweepSummary& summary) {
  if (summary.primary >= summary.outputs.size()) return "No point has a result.";
  const SweepOutput& output = summary.outputs[summary.primary];
  const std::string most = saidOf(output, output.spread.max), where = whereOf(summary, output);
  if (output.kind == OutputKind::check_share)
    return fmt::format("The check {} its limit is “{}”: {} {}. It is {}.",
                       output.spread.max > 1 ? "farthest beyond" : "nearest to", titleOf(output), most, where,
                       drivenBy(summary, output));
  return fmt::format("{}: up to {}, {}. It is {}.", titleOf(output), most, where, drivenBy(summary, output));
}

std::string legsThatRefused(const SweepSummary& summary) {
  std::string out;
  for (std::size_t k = 0; k < summary.refused_by_leg.size(); ++k)
    if (const std::int64_t count = summary.refused_by_leg[k]; count > 0)
      out += fmt::format("{}leg {} at {}", out.empty() ? "" : ", ", k + 1, grouped(count));
  return out.empty() ? ""
                     : "Motions that cannot be made end at the first pose that a leg cannot take: " + out + " points.";
}

}  // namespace

std::string grouped(std::int64_t count) {
  std::string out = std::to_string(count);
  for (std::size_t k = out.size(); k > 3 + (count < 0 ? 1U : 0U); k -= 3) out.insert(k - 3, ",");
  return out;
}

std::string verdictWords(const std::string& verdict, bool judges) {
  if (!judges && verdict == "pass") return "computed";
  for (const auto& [name, words] : verdict_words)
    if (verdict == name) return words;
  return verdict;
}

std::string titleOf(const SweepOutput& output) {
  switch (output.kind) {
    case OutputKind::largest_effort:
      return output.unit == "N" ? "Largest force of a motor" : "Largest torque of a motor";
    case OutputKind::effort:
      return fmt::format("{} of motor {}", output.unit == "N" ? "Force" : "Torque", output.motor + 1);
    case OutputKind::kappa:
      return "Condition number κ(B)";
    case OutputKind::sine:
      return output.name == "sin_theta"   ? "Least |sin θ|"
             : output.name == "sin_psi"   ? "Least |sin ψ|"
             : output.name == "cos_theta" ? "Least |cos θ|"
                                          : "Least margin of a leg";
    case OutputKind::largest_share:
      return "Largest share of a limit";
    case OutputKind::check_share:
      return checkTitle(output.name);
    case OutputKind::not_passed:
      return "Not passed (0 or 1)";
    case OutputKind::other:
      break;
  }
  return output.name;
}

std::string valueOf(const SweepOutput& output, double value) {
  if (std::isnan(value)) return "–";
  return report::quantity(value, output.unit, report::digitsToTell(output.spread.min, output.spread.max));
}

std::string saidOf(const SweepOutput& output, double value) {
  const bool share = output.kind == OutputKind::check_share || output.kind == OutputKind::largest_share;
  if (share && value < 1) return report::percentText(value) + " of its limit";
  return valueOf(output, value) + (share ? " times its limit" : "");
}

std::string breakable(const std::string& name) {
  std::string out = report::escaped(name);
  for (std::size_t at = 0; (at = out.find_first_of("._", at)) != std::string::npos; at += 6)
    out.insert(at + 1, "<wbr>");
  return out;
}

std::string signedNumber(double value) {
  if (std::isnan(value)) return "–";
  const std::string digits = fmt::format("{:.2f}", std::abs(value));
  return (digits == "0.00" ? "" : value > 0 ? "+" : "−") + digits;
}

std::string shareNumber(double value) {
  if (std::isnan(value)) return "–";
  return fmt::format("{:.2f}", std::max(value, 0.0));
}

std::string drivenBy(const SweepSummary& summary, const SweepOutput& output) {
  if (output.spread.constant) return "the same at every point";
  const std::size_t p = driver(output);
  if (p == summary.parameters.size())
    return summary.identity.design == "grid" ? "not related to any single number"
                                             : "not related to any number more than by chance";
  const Relation& relation = output.relations[p];
  if (relation.acts)
    return fmt::format("driven by {}, which alone makes {} of its variance", bareWords(summary.parameters[p].key),
                       percent(relation.first_order));
  return fmt::format("tied most to {}, by a rank correlation of {}", bareWords(summary.parameters[p].key),
                     signedNumber(relation.spearman));
}

std::string reasonOf(NoIndex reason) {
  switch (reason) {
    case NoIndex::too_few:
      return "fewer than 200 points have a value";
    case NoIndex::grid_not_complete:
      return "not every point of the grid has a value, and its numbers are then not independent";
    case NoIndex::constant:
      return "it is the same at every point";
    case NoIndex::none:
      break;
  }
  return "";
}

std::string sweepSentence(const SweepSummary& summary) {
  const SweepIdentity& identity = summary.identity;
  if (summary.points_done == 0) return "This database holds no point yet: there is nothing to report.";
  std::string missing;
  if (identity.shards > 1)
    missing = fmt::format("This is shard {} of {} alone, {} of {} points. ", identity.shard, identity.shards,
                          grouped(summary.points_done), grouped(identity.points));
  else if (summary.points_done < identity.points)
    missing = fmt::format("Only {} of {} points are there: the sweep has not ended. ", grouped(summary.points_done),
                          grouped(identity.points));
  return report::unbroken(fmt::format("{}{}. {}", missing, countsOf(summary), primarySentence(summary)));
}

std::vector<std::string> sweepRemarks(const SweepSummary& summary) {
  std::vector<std::string> out;
  if (const std::string legs = legsThatRefused(summary); !legs.empty()) out.push_back(legs);
  return out;
}

std::string showCommand(const SweepSummary& summary, std::int64_t id) {
  return fmt::format("ursula sweep show {} {} > point-{}.toml", shellWord(summary.identity.file), id, id);
}

std::string markdownOf(const SweepSummary& summary) {
  const auto cell = [](std::string text) {
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, "\\");
    return text;
  };
  std::string out = fmt::format("| Sweep of {} | Points |\n| --- | ---: |\n", cell(summary.identity.name));
  out += fmt::format("| in all | {} |\n", grouped(summary.identity.points));
  for (const auto& [verdict, count] : summary.verdicts)
    out +=
        fmt::format("| {} | {} |\n", cell(verdictWords(verdict, summary.identity.what == "validate")), grouped(count));
  if (summary.outputs.empty()) return out;
  out += "\n| Output | Min | Median | 95 % | Max | at point | Driven most by |\n";
  out += "| --- | ---: | ---: | ---: | ---: | ---: | --- |\n";
  for (const SweepOutput& output : summary.outputs) {
    const std::size_t p = driver(output);
    out += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", cell(titleOf(output)),
                       valueOf(output, output.spread.min), valueOf(output, output.spread.median),
                       valueOf(output, output.spread.high), valueOf(output, output.spread.max), output.worst_point,
                       p < summary.parameters.size() ? cell(keyWords(summary.parameters[p].key)) : "–");
  }
  return out;
}

}  // namespace ursula
