#include "report/files/written_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "model/scenario.h"
#include "report/page/html_template.h"
#include "report/page/page.h"
#include "report/page/page_data.h"
#include "report/page/picture.h"
#include "report/page/plots.h"
#include "report/page/sections.h"
#include "report/text/mechanism_words.h"
#include "report/text/quantity.h"
#include "report/text/result_facts.h"
#include "report/text/terminal.h"
#include "report/text/text.h"
#include "validation/verdict/effort_words.h"

namespace ursula::report {

extern const std::string_view facts_html, report_html;  // of web/

namespace {

/// The command that repeats the run in the folder of its files; a function in C++ or Python has none.
std::string command(const ValidationResult& result) {
  const JudgedSubject& subject = result.subject;
  const bool is_function = subject.formulation == Formulation::external && subject.called_by == CalledBy::program;
  const std::string file = result.asked != nullptr       ? result.asked->file.filename().string()
                           : result.mechanism != nullptr ? result.mechanism->scenario_file
                                                         : "";
  if (file.empty() || is_function) return "";
  std::string out = "ursula validate " + shellWord(file);
  if (subject.called_by == CalledBy::torques) out += " --torques " + shellWord(subject.name);
  if (subject.called_by == CalledBy::simulator) out += " --simulator " + shellWord(subject.name);
  if (subject.called_by == CalledBy::trajectory) out += " --trajectory " + shellWord(subject.name);
  if (!subject.torques.empty()) out += " --torques " + shellWord(subject.torques);
  if (!subject.map.empty()) out += " --map " + subject.map;
  if (subject.called_by == CalledBy::solver) out += " --solver " + shellWord(subject.name);
  if (result.mechanism != nullptr) return out + result.mechanism->options;
  const EffortTolerance tolerance = result.asked->tolerance.value_or(EffortTolerance{});
  if (tolerance.relative > 0) out += fmt::format(" --rtol {}", tolerance.relative);
  if (tolerance.absolute > 0) out += fmt::format(" --atol {}", tolerance.absolute);
  return tolerance.any ? out + " --any-tolerance" : out;
}

using Facts = std::vector<std::pair<std::string, std::string>>;

std::string factsTable(const char* caption, const Facts& facts, const std::string& command = "") {
  if (facts.empty()) return "";
  const auto row = [](const auto& fact) { return HtmlValue{{"key", fact.first}, {"text", fact.second}}; };
  return rendered(facts_html, {{"caption", caption}, {"facts", listOf(facts, row)}, {"command", command}});
}

/// The mistakes of each kind and term in one row.
Facts blindFacts(const ValidationResult& result) {
  Facts out;
  if (!result.blind) return out;
  for (const BlindSpot& one : alikeAsOne(*result.blind)) {
    std::string key = name(one.cause.kind);
    if (!one.cause.term.empty()) key += ": " + one.cause.term;
    std::replace(key.begin(), key.end(), '_', ' ');
    const auto same = std::find_if(out.begin(), out.end(), [&](const auto& fact) { return fact.first == key; });
    if (same == out.end())
      out.emplace_back(key, unbroken(one.mistake));
    else
      same->second += "; " + unbroken(one.mistake);
  }
  return out;
}

/// A list of many names begins with the first ones; `summary.json` has all.
std::string shortened(const std::string& text) {
  constexpr std::ptrdiff_t most = 12, shown = 8;
  const std::ptrdiff_t commas = std::count(text.begin(), text.end(), ',');
  if (commas < most || std::count(text.begin(), text.end(), ' ') != commas) return text;
  std::size_t at = 0;
  for (std::ptrdiff_t k = 0; k < shown; ++k) at = text.find(',', at + 1);
  return text.substr(0, at) + fmt::format(" and {} more", commas + 1 - shown);
}

Facts printed(Facts facts) {
  for (auto& [key, text] : facts) text = unbroken(formulaInPrint(shortened(text)));
  return facts;
}

/// The first screen's figures: the motor that is most off, or else the sources of the replay's error.
PlotGroup firstGroup(const std::vector<Plot>& plots) {
  return plots.empty() ? PlotGroup::sources : std::min(plots.front().group, PlotGroup::sources);
}

std::string cardOf(const ValidationResult& result, const Picture* picture) {
  if (picture != nullptr) return inputCard(*picture);
  return result.mechanism != nullptr ? inputCard(*result.mechanism) : "";
}

std::string stageOf(const ValidationResult& result, const Picture* picture) {
  std::vector<int> marked = markedOf(motorsOff(result));
  if (picture == nullptr) return result.mechanism != nullptr ? svgMachine(*result.mechanism, marked) : "";
  for (int& motor : marked) motor = legOf(result, motor);
  return svgMachine(*picture, marked);
}

std::string lineOf(const ValidationResult& result, const Picture* picture) {
  if (picture != nullptr) return machineLine(*picture);
  return result.mechanism != nullptr ? mechanismLine(*result.mechanism) : "";
}

std::vector<PageSection> parts(const ValidationResult& result, const Picture* picture, const std::vector<Plot>& plots) {
  const bool on_top = firstGroup(plots) == PlotGroup::sources;
  return {{"checks", "Checks", checksList(result.checks, result.kind)},
          {"errors", "Errors along the motion",
           figuresHtml(plots,
                       on_top ? std::vector{PlotGroup::errors} : std::vector{PlotGroup::errors, PlotGroup::sources})},
          {"efforts", "Efforts", figuresHtml(plots, {PlotGroup::efforts})},
          {"motion", "Motion", figuresHtml(plots, {PlotGroup::motion})},
          {"reactions", "Reactions", figuresHtml(plots, {PlotGroup::reactions})},
          {"numerics", "Numerics", figuresHtml(plots, {PlotGroup::numerics})},
          {"statistics", "Error statistics", statisticsTable(result)},
          {"input", "Input", cardOf(result, picture)},
          {"findings", "Findings", factsTable("Facts that are not judged", printed(findingTexts(result)))},
          {"blind", "What this scenario cannot show",
           factsTable("Mistakes that machine and motion would let pass", blindFacts(result))},
          {"provenance", "Provenance", factsTable("The sources of this result", result.provenance, command(result))}};
}

}  // namespace

std::string reportHtml(const ValidationResult& result, Place place) {
  const auto inWords = [&noun = result.effort](const std::string& text) { return inEffortWords(noun, text); };
  const std::vector<Plot> charts = plots(result);
  const std::shared_ptr<const Picture> picture = pictureOf(result);
  std::vector<PageSection> sections = parts(result, picture.get(), charts);
  for (auto& [id, title, html] : sections)
    if (id != "provenance") title = inWords(title), html = inWords(html);  // which quotes the user's own command
  const std::string motors = motorsTable(result);
  return rendered(report_html, {{"scenario", result.scenario},
                                {"style", std::string(report_style)},
                                {"verdict", name(result.verdict)},
                                {"badge", verdictBadge(result.verdict)},
                                {"sentence", sentence(result)},
                                {"motors", inWords(motors)},
                                {"why", motors.empty() ? inWords(detail(result)) : ""},
                                {"wide", firstGroup(charts) == PlotGroup::worst},
                                {"machine", lineOf(result, picture.get())},
                                {"figures", inWords(keyFiguresHtml(keyFigures(result)))},
                                {"reason", inWords(unbroken(reason(result.verdict, result.checks,
                                                                   [&result](const std::string& check) {
                                                                     return checkWords(check, result.kind).title;
                                                                   })))},
                                {"sources", inWords(figuresHtml(charts, {firstGroup(charts)}, "h2"))},
                                {"stage", stageOf(result, picture.get())},
                                {"in_suite", place == Place::in_suite},
                                {"links", linksHtml(sections)},
                                {"sections", sectionsHtml(sections)},
                                {"data", pageData(result, picture.get(), charts)},
                                {"script", std::string(report_script)}}) +
         "\n";
}

}  // namespace ursula::report
