#include "report/files/written_files.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/json_text.h"
#include "report/files/report.h"
#include "report/text/result_facts.h"

namespace ursula::report {
namespace {

using Json = nlohmann::ordered_json;

// nlohmann::json writes null for numbers that are not finite.
Json checkJson(const Check& check) {
  return {{"name", check.name},
          {"value", check.value},
          {"limit", check.limit},
          {"unit", check.unit},
          {"verdict", name(check.verdict)},
          {"basis", check.basis},
          {"why", whyInFull(check)},
          {"reason", name(check.reason)},
          {"limit_by", name(check.limit_by)},
          {"could_have_missed", check.missed},
          {"largest", {{"value", check.largest.value}, {"t_s", check.largest.t}, {"where", check.largest.where}}}};
}

Json deviationJson(const EffortDeviation& deviation) {
  return {{"largest", deviation.largest},
          {"relative", deviation.relative()},
          {"t_s", deviation.t},
          {"where", deviation.where},
          {"largest_effort", deviation.largest_effort},
          {"smallest_rtol", deviation.smallestRelative()},
          {"drift_m", deviation.drift},
          {"would_have_been_seen", deviation.seen},
          {"if_longer_than_s", deviation.seen_for},
          {"allowed", deviation.allowed}};
}

Json sizeJson(const FailureSize& size, const std::optional<EffortDeviation>& deviation) {
  Json out = {{"grade", name(size.grade)}, {"limits", size.limits}, {"rounding", size.rounding}};
  if (!size.least_term.empty()) out["least_term"] = {{"term", size.least_term}, {"share", size.least_share}};
  if (deviation && deviation->smallestRelative() < 1) out["rtol"] = deviation->smallestRelative();
  out["remedy"] = Json::array();
  for (const ScenarioChange& change : size.remedy)
    out["remedy"].push_back({{"key", change.key}, {"value", change.value}});
  return out;
}

// A repeated key keeps both texts.
Json object(const std::vector<std::pair<std::string, std::string>>& facts) {
  Json json = Json::object();
  for (const auto& [key, text] : facts) {
    json[key] = json.contains(key) ? json[key].get<std::string>() + "; " + text : text;
  }
  return json;
}

// Fields that do not apply are omitted.
Json causeJson(const NamedCause& cause) {
  Json json = {{"kind", name(cause.kind)}};
  const auto addText = [&](const char* key, const std::string& text) {
    if (!text.empty()) json[key] = text;
  };
  const auto addNumber = [&](const char* key, const std::optional<double>& number) {
    if (number) json[key] = *number;
  };
  addText("term", cause.term);
  addText("body", cause.body);
  addText("joint", cause.joint);
  if (cause.leg > 0) json["leg"] = cause.leg;
  if (cause.motor > 0) json["motor"] = cause.motor;
  if (!cause.legs.empty()) json["legs"] = cause.legs;
  if (!cause.signs.empty()) json["signs"] = cause.signs;
  addText("parameter", cause.parameter);
  addNumber("expected", cause.expected);
  addNumber("found", cause.found);
  addNumber("uncertainty", cause.uncertainty);
  addText("unit", cause.unit);
  addNumber("from_s", cause.from_s);
  addNumber("to_s", cause.to_s);
  if (std::isfinite(cause.explained)) json["explained"] = cause.explained;
  return json;
}

Json blindJson(const std::vector<BlindSpot>& blind) {
  Json out = Json::array();
  for (const BlindSpot& one : blind) {
    out.push_back({{"mistake", one.mistake}, {"cause", causeJson(one.cause)}, {"largest", one.largest}});
    if (!one.alike.empty()) out.back()["alike"] = one.alike;
  }
  return out;
}

Json checkedObject(const CheckedScenario& checked) {
  Json out = {{"file", checked.file}, {"valid", checked.error.empty()}};
  if (!checked.error.empty()) {
    out["error"] = checked.error;
    return out;
  }
  out["scenario"] = checked.name;
  out["warnings"] = checked.warnings;
  out["assumptions"] = checked.assumptions;
  if (checked.blind) out["blind"] = blindJson(*checked.blind);
  return out;
}

void addCauses(const ValidationResult& result, Json& summary) {
  summary["cause"] = result.cause ? causeJson(*result.cause) : Json();
  summary["causes"] = Json::array();
  for (const NamedCause& other : result.causes) summary["causes"].push_back(causeJson(other));
  summary["causes_together"] = Json::array();
  for (const NamedCause& each : result.causes_together) summary["causes_together"].push_back(causeJson(each));
  summary["terms"] = Json::array();
  for (const TermError& each : result.terms) summary["terms"].push_back({{"term", each.term}, {"error", each.error}});
}

}  // namespace

std::string summaryJson(const ValidationResult& result) {
  Json checks = Json::array();
  for (const Check& check : result.checks) checks.push_back(checkJson(check));
  const std::string deviation = deviationSentence(result);
  Json summary = {{"scenario", result.scenario},
                  {"kind", result.kind},
                  {"verdict", name(result.verdict)},
                  {"formulation", name(result.subject.formulation)},
                  {"limits", name(result.limits)},
                  {"reason", reason(result.verdict, result.checks) + (deviation.empty() ? "" : " ") + deviation},
                  {"checks", checks},
                  {"findings", object(findingTexts(result))},
                  {"provenance", object(result.provenance)}};
  if (result.deviation) summary["deviation"] = deviationJson(*result.deviation);
  if (result.needed) summary["needed"] = {{"rows", result.needed->rows}, {"given", result.needed->given}};
  if (result.size) summary["size"] = sizeJson(*result.size, result.deviation);
  addCauses(result, summary);
  if (result.blind) summary["blind"] = blindJson(*result.blind);
  return jsonText(summary, 2) + "\n";
}

std::string checkedJson(const std::vector<CheckedScenario>& checked) {
  if (checked.size() == 1) return jsonText(checkedObject(checked.front()), 2) + "\n";
  Json all = Json::array();
  for (const CheckedScenario& each : checked) all.push_back(checkedObject(each));
  return jsonText(all, 2) + "\n";
}

std::string blindJsonText(const std::vector<BlindSpot>& blind) { return jsonText(blindJson(blind), 0); }

std::string errorJson(const std::string& scenario, const std::string& error) {
  const Json json = {{"scenario", scenario}, {"verdict", "error"}, {"error", error}};
  return jsonText(json, 2) + "\n";
}

}  // namespace ursula::report
