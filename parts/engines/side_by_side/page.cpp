#include <fmt/format.h>

#include "parts/engines/side_by_side/side_by_side.h"
#include "report/page/html_template.h"
#include "report/page/page.h"
#include "report/text/quantity.h"

namespace ursula {

extern const std::string_view engines_efforts_html, engines_in_time_html, engines_sentences_html, engines_code_html;
extern const std::string_view closing_recipe_code;

namespace {

using report::HtmlValue, report::quantity, report::rendered;

std::string nameOf(const EngineResult& engine) {
  return engine.version.empty() ? engine.kind->name : fmt::format("{} {}", engine.kind->name, engine.version);
}

HtmlValue effortRow(const SideBySide& found, const EngineResult& engine, const RecipeResult& each) {
  const bool has_answer = each.refused.empty();
  const auto only = [has_answer](const std::string& text) { return has_answer ? text : std::string(); };
  return {{"engine", nameOf(engine)},
          {"recipe", inWords(each.recipe)},
          {"obvious", each.recipe == engine.kind->obvious},
          {"refused", each.refused},
          {"effort", only(errorText(each.error))},
          {"worst", only(worstText(each, found))},
          {"power", only(errorText(each.power))},
          {"gap", only(quantity(engine.gap, "m"))},
          {"time", only(quantity(each.seconds, "s"))}};
}

std::string effortsTable(const SideBySide& found) {
  std::vector<HtmlValue> rows;
  for (const EngineResult& engine : found.engines)
    for (const RecipeResult& each : engine.recipes) rows.push_back(effortRow(found, engine, each));
  if (rows.empty()) return "";
  const std::string caption = fmt::format(
      "Efforts against the NOC's at {} instants, over the largest effort, {}; power of the motors, over the largest; "
      "gap of the loops as placed; time a pose, as measured here.",
      found.instants, largestText(found));
  return rendered(engines_efforts_html, {{"caption", caption}, {"rows", rows}}) + "\n";
}

std::string settingsText(const Rigidity& rigidity) {
  std::string out = fmt::format("step {}", quantity(rigidity.step, "s"));
  for (const auto& [what, value] : rigidity.settings) out += fmt::format(", {} {:g}", what, value);
  return out;
}

HtmlValue timeSteppingRow(const EngineResult& engine, const TimeSteppingResult& each) {
  return {{"engine", nameOf(engine)},
          {"rigidity", each.rigidity.name},
          {"settings", settingsText(each.rigidity)},
          {"gave_up", each.gave_up},
          {"steps", each.steps},
          {"gap", quantity(each.gap, "m")},
          {"sag", quantity(each.sag, "m")},
          {"away", quantity(each.away, "m")},
          {"energy", quantity(each.energy, "J")},
          {"work", quantity(each.work, "J")},
          {"time", quantity(each.seconds, "s")}};
}

std::string inTimeTable(const SideBySide& found) {
  std::vector<HtmlValue> rows;
  for (const EngineResult& engine : found.engines)
    for (const TimeSteppingResult& each : engine.in_time) rows.push_back(timeSteppingRow(engine, each));
  if (rows.empty()) return "";
  const std::string caption = fmt::format(
      "The first {} of the motion, moved by the engine with its own closures under the NOC's efforts. The largest gap "
      "of the loops; sag of {} with the motors where they are; how far {} leaves the motion, which grows where the "
      "motion is unstable; energy gained beside all work done; time a step, as measured here.",
      quantity(found.moved, "s"), found.model.empty() ? "the platform's joints" : "the output body",
      found.model.empty() ? "the platform" : "it");
  return rendered(engines_in_time_html, {{"caption", caption}, {"rows", rows}}) + "\n";
}

/// The engines' calls for a mechanism as they are compiled into this program.
std::string codeBlocks(const SideBySide& found) {
  if (found.model.empty()) return "";
  std::vector<HtmlValue> blocks;
  const auto add = [&](const std::string& title, std::string_view code) {
    if (!code.empty()) blocks.push_back({{"title", title}, {"code", std::string(code)}});
  };
  for (const EngineResult& engine : found.engines) {
    add(fmt::format("{}: forces on the speeds of its tree{}", nameOf(engine), cutText(engine, "; ")),
        engine.kind->code);
    add(fmt::format("{}: what its users call first", nameOf(engine)), engine.kind->own_code);
  }
  add("All: from these forces to the motors", closing_recipe_code);
  return rendered(engines_code_html, {{"blocks", blocks}}) + "\n";
}

std::string sentences(const SideBySide& found) {
  std::vector<std::string> out;
  for (const EngineResult& engine : found.engines) out.push_back(sentence(engine));
  for (const LoopEngineKind* kind : found.missing) out.push_back(sentenceOfMissing(*kind));
  return rendered(engines_sentences_html, {{"sentences", out}}) + "\n";
}

}  // namespace

std::string sideBySideHtml(const SideBySide& found) {
  report::Page page;
  page.kind = "Engines side by side";
  page.title = found.scenario;
  page.subtitle = found.model.empty() ? "efforts of the motors by each engine, against the closed form"
                                      : "efforts of the motors by each engine, against the complement of the loops";
  page.sentence = sentence(found);
  page.remarks = remarks(found);
  page.sections = {{"right", "How to get it right, and how wrong the obvious call is", sentences(found)},
                   {"efforts", "Efforts", effortsTable(found)},
                   {"code", "The exact recipe in each engine's own calls", codeBlocks(found)},
                   {"time", "The closed loop in time", inTimeTable(found)}};
  page.style = ".wide caption { max-width: calc(100vw - 2.5rem); }";  // it is read without scrolling a wide table
  page.footer =
      "<p>The same in numbers: <a href=\"engines.json\">engines.json</a>, <a href=\"engines.csv\">engines.csv</a>; "
      "all efforts: <a href=\"efforts.csv\">efforts.csv</a>. "
      "Times are of one machine and one run.</p>";
  return report::pageHtml(page);
}

}  // namespace ursula
