#include "report/files/written_files.h"

#include <fmt/format.h>

#include "base/text.h"
#include "model/scenario.h"
#include "report/page/html_template.h"
#include "report/page/page.h"
#include "report/page/page_data.h"
#include "report/page/picture.h"
#include "report/page/plots.h"
#include "report/page/sections.h"
#include "report/text/quantity.h"
#include "report/text/result_facts.h"
#include "report/text/text.h"
#include "validation/verdict/effort_words.h"

namespace ursula::report {

extern const std::string_view facts_html, report_html;  // of web/

namespace {

/// The command that repeats the run in the folder of its files; a function in C++ or Python has none.
std::string command(const ValidationResult& result) {
  const JudgedSubject& subject = result.subject;
  const bool is_function = subject.formulation == Formulation::external && subject.called_by == CalledBy::program;
  if (result.asked == nullptr || result.asked->file.empty() || is_function) return "";
  std::string out = "ursula validate " + shellWord(result.asked->file.filename().string());
  if (subject.called_by == CalledBy::torques) out += " --torques " + shellWord(subject.name);
  if (!subject.map.empty()) out += " --map " + subject.map;
  if (subject.called_by == CalledBy::solver) out += " --solver " + shellWord(subject.name);
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

Facts printed(Facts facts) {
  for (auto& [key, text] : facts) text = formulaInPrint(text);
  return facts;
}

/// The figure of the error's sources for the first screen.
std::string sources(const std::vector<Plot>& plots) {
  for (std::size_t i = 0; i < plots.size(); ++i)
    if (plots[i].group == PlotGroup::sources) return figureHtml(plots[i], i, "h2");
  return "";
}

std::vector<PageSection> parts(const ValidationResult& result, const Picture* picture, const std::vector<Plot>& plots) {
  return {{"checks", "Checks", checksList(result.checks)},
          {"errors", "Errors along the motion", figuresHtml(plots, PlotGroup::errors)},
          {"efforts", "Efforts", figuresHtml(plots, PlotGroup::efforts)},
          {"motion", "Motion", figuresHtml(plots, PlotGroup::motion)},
          {"reactions", "Reactions", figuresHtml(plots, PlotGroup::reactions)},
          {"numerics", "Numerics", figuresHtml(plots, PlotGroup::numerics)},
          {"statistics", "Error statistics", statisticsTable(result)},
          {"input", "Input", picture == nullptr ? "" : inputCard(*picture)},
          {"findings", "Findings", factsTable("Facts that are not judged", printed(findingTexts(result)))},
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
                                {"machine", picture == nullptr ? "" : machineLine(*picture)},
                                {"figures", inWords(keyFiguresHtml(keyFigures(result)))},
                                {"reason", powersInPrint(reason(result.verdict, result.checks))},
                                {"sources", inWords(sources(charts))},
                                {"stage", picture == nullptr ? "" : svgMachine(*picture)},
                                {"in_suite", place == Place::in_suite},
                                {"links", linksHtml(sections)},
                                {"sections", sectionsHtml(sections)},
                                {"data", pageData(result, picture.get(), charts)},
                                {"script", std::string(report_script)}}) +
         "\n";
}

}  // namespace ursula::report
