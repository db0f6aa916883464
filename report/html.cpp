#include "report/written_files.h"

#include <fmt/format.h>

#include <filesystem>

#include "base/text.h"
#include "report/page.h"
#include "report/picture.h"
#include "report/plots.h"
#include "report/quantity.h"
#include "report/result_facts.h"
#include "report/sections.h"
#include "report/text.h"
#include "validation/verdict/effort_words.h"

namespace ursula::report {
namespace {

std::string section(const std::string& id, const std::string& title, const std::string& content) {
  if (content.empty()) return "";
  return fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}\n</section>\n", id, title, content);
}

std::string factsTable(const char* caption, const std::vector<std::pair<std::string, std::string>>& facts) {
  if (facts.empty()) return "";
  std::string rows;
  for (const auto& [key, text] : facts) {
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", escaped(key), escaped(text));
  }
  return fmt::format("<table class=\"facts\">\n<caption>{}</caption>\n<tbody>\n{}</tbody>\n</table>", caption, rows);
}

std::vector<std::pair<std::string, std::string>> printed(std::vector<std::pair<std::string, std::string>> facts) {
  for (auto& [key, text] : facts) text = formulaInPrint(text);
  return facts;
}

constexpr const char* suite_link = "<a class=\"up\" href=\"../index.html\">← The suite</a>\n";

/// The command that repeats the run in the folder of its files; a function in C++ or Python has none.
std::string command(const ValidationResult& result) {
  const auto given = [&result](const char* key) { return fact(result.provenance, key); };
  const std::string file = given("scenario file"), subject = given("subject"), process = given("solver process");
  const bool from_file = std::filesystem::path(subject).extension() == ".csv";
  if (file.empty() || (result.formulation == "external" && process.empty() && !from_file)) return "";
  std::string out = "ursula validate " + shellWord(file);
  const auto add = [&out](const char* option, const std::string& value) {
    if (!value.empty()) out += fmt::format(" {} {}", option, shellWord(value));
  };
  if (from_file) add("--torques", subject);
  if (const std::string map = given("columns named"); !map.empty()) out += " --map " + map;
  add("--solver", process);
  add("--rtol", given("relative tolerance of efforts"));
  add("--atol", given("absolute tolerance of efforts"));
  if (!given("any tolerance").empty()) out += " --any-tolerance";
  return fmt::format("<p>To do it again: <code>{}</code></p>", escaped(out));
}

std::string keyFiguresHtml(const ValidationResult& result) {
  std::string out;
  for (const KeyFigure& figure : keyFigures(result))
    out += fmt::format("<div><dt>{}</dt><dd><b>{}</b> <span>{}</span></dd></div>", escaped(figure.what),
                       escaped(figure.value), escaped(figure.remark));
  return out;
}

/// The figure of the error's sources for the first screen.
std::string sources(const std::vector<Plot>& plots) {
  for (std::size_t i = 0; i < plots.size(); ++i)
    if (plots[i].group == PlotGroup::sources) return figureHtml(plots[i], i, "h2");
  return "";
}

std::string stage(const Picture* picture) {
  return picture == nullptr ? "" : "<div class=\"stage\" id=\"stage\">" + svgMachine(*picture) + "</div>";
}

/// Which motors are off; else the reason in detail.
std::string detailHtml(const ValidationResult& result) {
  const std::string motors = motorsTable(result), why = motors.empty() ? detail(result) : "";
  return why.empty() ? motors : "<p class=\"why\">" + escaped(why) + "</p>";
}

struct Part {
  const char *id, *title;
  std::string content;
};

std::vector<Part> parts(const ValidationResult& result, const Picture* picture, const std::vector<Plot>& plots) {
  return {{"checks", "Checks", checksList(result.checks, result.cause_words.cause)},
          {"errors", "Errors along the motion", figuresHtml(plots, PlotGroup::errors)},
          {"efforts", "Efforts", figuresHtml(plots, PlotGroup::efforts)},
          {"motion", "Motion", figuresHtml(plots, PlotGroup::motion)},
          {"reactions", "Reactions", figuresHtml(plots, PlotGroup::reactions)},
          {"numerics", "Numerics", figuresHtml(plots, PlotGroup::numerics)},
          {"statistics", "Error statistics", statisticsTable(result)},
          {"input", "Input", picture == nullptr ? "" : inputCard(*picture)},
          {"findings", "Findings", factsTable("Facts that are not judged", printed(findingTexts(result)))},
          {"provenance", "Provenance", factsTable("The sources of this result", result.provenance) + command(result)}};
}

}  // namespace

std::string reportHtml(const ValidationResult& result, Place place) {
  const std::vector<Plot> charts = plots(result);
  const std::shared_ptr<const Picture> picture = pictureOf(result);
  std::string sections, links;
  for (const Part& part : parts(result, picture.get(), charts)) {
    sections += section(part.id, part.title, part.content);
    if (!part.content.empty()) links += fmt::format("<a href=\"#{}\">{}</a>\n", part.id, part.title);
  }
  const auto inWords = [&result](const std::string& text) { return inEffortWords(effortNoun(result), text); };
  return filled(report_template, {{"scenario", escaped(result.scenario)},
                                  {"style", std::string(report_style)},
                                  {"verdict", name(result.verdict)},
                                  {"badge", verdictBadge(result.verdict)},
                                  {"sentence", escaped(sentence(result))},
                                  {"detail", inWords(detailHtml(result))},
                                  {"machine", picture == nullptr ? "" : escaped(machineLine(*picture))},
                                  {"figures", inWords(keyFiguresHtml(result))},
                                  {"reason", escaped(powersInPrint(reason(result.verdict, result.checks)))},
                                  {"sources", inWords(sources(charts))},
                                  {"stage", stage(picture.get())},
                                  {"suite", place == Place::in_suite ? suite_link : ""},
                                  {"links", inWords(links)},
                                  {"sections", inWords(sections)},
                                  {"data", pageData(result, picture.get(), charts)},
                                  {"script", std::string(report_script)}});
}

}  // namespace ursula::report
