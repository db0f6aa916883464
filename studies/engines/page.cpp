#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "report/page.h"
#include "report/quantity.h"
#include "report/text.h"
#include "studies/engines/side_by_side.h"

namespace ursula {
namespace {

using report::escaped, report::plainNumber, report::quantity;

std::string region(const std::string& label, const std::string& table) {
  return fmt::format("<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"{}\">{}</div>\n", label, table);
}

std::string head(const std::string& text, bool is_number = true) {
  return fmt::format("<th scope=\"col\"{}>{}</th>", is_number ? " class=\"number\"" : "", escaped(text));
}

std::string cell(const std::string& text) { return fmt::format("<td class=\"number\">{}</td>", escaped(text)); }

std::string table(const std::string& caption, const std::string& heads, const std::string& rows) {
  return region(caption, fmt::format("<table>\n<caption>{}</caption>\n<thead><tr>{}</tr></thead>\n<tbody>\n{}</tbody>"
                                     "</table>",
                                     escaped(caption), heads, rows));
}

std::string effortsTable(const SideBySide& found) {
  std::string rows;
  for (const EngineResult& engine : found.engines)
    for (const RecipeResult& each : engine.recipes)
      rows += fmt::format(
          "<tr><th scope=\"row\">{} {}</th><td>{}{}</td>{}{}{}{}</tr>\n", escaped(engine.kind->name),
          escaped(engine.version), escaped(inWords(each.recipe)),
          each.recipe == engine.kind->obvious ? " <span class=\"aside\">what its users call first</span>" : "",
          cell(errorText(each.error)), cell(errorText(each.power)), cell(quantity(engine.gap, "m")),
          cell(quantity(each.seconds, "s")));
  return rows.empty()
             ? ""
             : table(fmt::format("Efforts against the NOC's at {} instants, over the largest effort, {}; power "
                                 "of the motors, over the largest; gap of the loops as placed; time a pose, as "
                                 "measured here.",
                                 found.instants, largestText(found)),
                     head("Engine", false) + head("Recipe", false) + head("Effort off by") + head("Power off by") +
                         head("Gap") + head("Time"),
                     rows);
}

std::string settingsText(const Rigidity& rigidity) {
  std::string out = fmt::format("step {}", quantity(rigidity.step, "s"));
  for (const auto& [what, value] : rigidity.settings) out += fmt::format(", {} {:g}", what, value);
  return out;
}

std::string timeSteppingRow(const EngineResult& engine, const TimeSteppingResult& each) {
  const std::string stopped =
      each.gave_up.empty()
          ? ""
          : fmt::format(" <span class=\"aside\">gave up after {} steps: {}</span>", each.steps, escaped(each.gave_up));
  return fmt::format("<tr><th scope=\"row\">{} {}</th><td>{} <span class=\"aside\">{}</span>{}</td>{}{}{}{}{}{}</tr>\n",
                     escaped(engine.kind->name), escaped(engine.version), escaped(each.rigidity.name),
                     escaped(settingsText(each.rigidity)), stopped, cell(quantity(each.gap, "m")),
                     cell(quantity(each.sag, "m")), cell(quantity(each.away, "m")), cell(quantity(each.energy, "J")),
                     cell(quantity(each.work, "J")), cell(quantity(each.seconds, "s")));
}

std::string inTimeTable(const SideBySide& found) {
  std::string rows;
  for (const EngineResult& engine : found.engines)
    for (const TimeSteppingResult& each : engine.in_time) rows += timeSteppingRow(engine, each);
  return rows.empty() ? ""
                      : table(fmt::format("The first {} of the motion, moved by the engine with its own closures under "
                                          "the NOC's efforts. The "
                                          "largest gap of the loops; sag of the platform's joints with the motors "
                                          "where they are; how far the platform leaves the motion, which grows where "
                                          "the motion is unstable; energy gained beside all work done; time a step, as "
                                          "measured here.",
                                          quantity(found.moved, "s")),
                              head("Engine", false) + head("Rigidity", false) + head("Gap") + head("Sag") +
                                  head("Off the motion") + head("Energy gained") + head("Work") + head("Time"),
                              rows);
}

std::string sentences(const SideBySide& found) {
  std::string items;
  for (const EngineResult& engine : found.engines) items += fmt::format("<li>{}</li>\n", escaped(sentence(engine)));
  for (const LoopEngineKind* kind : found.missing)
    items += fmt::format("<li>{}</li>\n", escaped(sentenceOfMissing(*kind)));
  return "<ul>\n" + items + "</ul>\n";
}

}  // namespace

std::string sideBySideHtml(const SideBySide& found) {
  report::Page page;
  page.kind = "Engines side by side";
  page.title = found.scenario;
  page.subtitle = "efforts of the motors by each engine, against the closed form";
  page.sentence = sentence(found);
  page.sections = {{"right", "How to get it right, and how wrong the obvious call is", sentences(found)},
                   {"efforts", "Efforts", effortsTable(found)},
                   {"time", "The closed loop in time", inTimeTable(found)}};
  page.footer =
      "<p>The same in numbers: <a href=\"engines.json\">engines.json</a>, <a href=\"engines.csv\">engines.csv</a>. "
      "Times "
      "are of one machine and one run.</p>";
  return report::pageHtml(page);
}

}  // namespace ursula
