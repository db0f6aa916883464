#include "apps/ci_findings.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>

#include "base/json_text.h"

namespace ursula {
namespace {

using Json = nlohmann::ordered_json;

Json parsed(const std::string& text) {
  Json out = Json::parse(text, nullptr, false);
  return out.is_object() ? out : Json::object();
}

std::string textAt(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

/// The place that an error's text begins with.
struct FilePlace {
  std::string file;
  int line = 1, column = 1;
};

FilePlace placeOf(const JudgedFile& judged, const std::string& error) {
  static const std::regex begins(R"(^([^\n:]+):(\d{1,7})(?::(\d{1,7}))?: )");
  std::smatch found;
  if (!std::regex_search(error, found, begins)) return {judged.file};
  return {found[1], std::stoi(found[2]), found[3].matched ? std::stoi(found[3]) : 1};
}

/// What is said of a scenario in one sentence or two.
std::string messageOf(const Json& summary, const std::string& cause) {
  const std::string error = textAt(summary, "error");
  if (!error.empty()) return error;
  return fmt::format("{}: {}{}{}", textAt(summary, "scenario"), textAt(summary, "reason"), cause.empty() ? "" : "; ",
                     cause);
}

/// Escapes a workflow command's text, and its properties.
std::string escaped(const std::string& text, bool property) {
  std::string out;
  for (const char c : text)
    if (c == '%' || c == '\r' || c == '\n' || (property && (c == ':' || c == ',')))
      out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    else
      out += c;
  return out;
}

const char* levelOf(const std::string& verdict, const char* of_pass) {
  return verdict == "pass" ? of_pass : verdict == "inconclusive" ? "warning" : "error";
}

Json locationOf(const FilePlace& place) {
  return {{"physicalLocation",
           {{"artifactLocation", {{"uri", place.file}}},
            {"region", {{"startLine", place.line}, {"startColumn", place.column}}}}}};
}

void addResult(const std::string& rule, const std::string& level, const std::string& text, const FilePlace& place,
               Json& results) {
  results.push_back({{"ruleId", rule},
                     {"level", level},
                     {"message", {{"text", text}}},
                     {"locations", Json::array({locationOf(place)})}});
}

std::map<std::string, std::string> verdictsOf(const Json& summary) {
  std::map<std::string, std::string> out;
  if (summary.contains("checks"))
    for (const Json& check : summary["checks"]) out[textAt(check, "name")] = textAt(check, "verdict");
  return out;
}

double deviationOf(const Json& summary) {
  const Json::json_pointer at("/deviation/relative");
  return summary.contains(at) && summary[at].is_number() ? summary[at].get<double>() : std::nan("");
}

}  // namespace

std::string githubText(const std::vector<JudgedFile>& judged) {
  std::string out;
  for (const JudgedFile& each : judged) {
    const Json summary = parsed(each.summary);
    const FilePlace place = placeOf(each, textAt(summary, "error"));
    out += fmt::format("::{} file={},line={},col={},title={}::{}\n", levelOf(textAt(summary, "verdict"), "notice"),
                       escaped(place.file, true), place.line, place.column,
                       escaped("ursula: " + textAt(summary, "verdict"), true),
                       escaped(messageOf(summary, each.cause), false));
  }
  return out;
}

std::string sarifText(const std::vector<JudgedFile>& judged) {
  Json results = Json::array();
  std::string version;
  for (const JudgedFile& each : judged) {
    const Json summary = parsed(each.summary);
    const std::string error = textAt(summary, "error");
    const FilePlace place = placeOf(each, error);
    if (!error.empty()) addResult("scenario", "error", error, place, results);
    if (summary.contains("provenance")) version = textAt(summary["provenance"], "ursula");
    if (!summary.contains("checks")) continue;
    for (const Json& check : summary["checks"]) {
      const std::string verdict = textAt(check, "verdict");
      if (verdict != "fail" && verdict != "inconclusive") continue;
      addResult(textAt(check, "name"), levelOf(verdict, "note"),
                fmt::format("{}: {}", textAt(summary, "scenario"), textAt(check, "why")), place, results);
    }
  }
  const Json driver = {{"name", "ursula"}, {"version", version}, {"rules", Json::array()}};
  const Json log = {{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                    {"version", "2.1.0"},
                    {"runs", Json::array({{{"tool", {{"driver", driver}}}, {"results", results}}})}};
  return jsonText(log, 2) + "\n";
}

std::string changesSince(const std::string& older, const std::string& newer) {
  const Json before = parsed(older), now = parsed(newer);
  if (before.empty()) return "no earlier summary.json to compare with\n";
  std::string out;
  const auto differ = [&out](const std::string& what, const std::string& was, const std::string& is) {
    if (was != is)
      out += fmt::format("  {}: {} before, {} now\n", what, was.empty() ? "none" : was, is.empty() ? "none" : is);
  };
  differ("verdict", textAt(before, "verdict"), textAt(now, "verdict"));
  const auto old_checks = verdictsOf(before);
  auto new_checks = verdictsOf(now);
  for (const auto& [name, verdict] : old_checks) differ(name, verdict, new_checks[name]);
  for (const auto& [name, verdict] : new_checks)
    if (old_checks.count(name) == 0) differ(name, "", verdict);
  const double was = deviationOf(before), is = deviationOf(now);
  if (std::isfinite(was) && std::isfinite(is) && was != is)
    out += fmt::format("  largest deviation: {:.3g} of the largest effort before, {:.3g} now\n", was, is);
  for (const char* key : {"scenario sha1", "ursula", "commit", "compiler", "Simbody", "MuJoCo"})
    differ(key, before.contains("provenance") ? textAt(before["provenance"], key) : "",
           now.contains("provenance") ? textAt(now["provenance"], key) : "");
  return out.empty() ? "  nothing changed\n" : out;
}

std::string summaryIn(const std::filesystem::path& folder) {
  std::ifstream file(folder / "summary.json", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace ursula
