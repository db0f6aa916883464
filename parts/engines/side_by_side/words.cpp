// Texts of the comparison for people and programs.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/json_text.h"
#include "parts/engines/side_by_side/side_by_side.h"
#include "report/text/quantity.h"

namespace ursula {
namespace {

using nlohmann::ordered_json;
using report::plainNumber, report::quantity;

/// A smaller deviation is rounding, not a mistake.
constexpr double as_good = 1e-10;

/// "mj_inverse, read at the motors," without its aside.
std::string beforeComma(const std::string& call) { return call.substr(0, call.find(',')); }

std::string called(const EngineResult& engine) {
  return engine.version.empty() ? engine.kind->name : fmt::format("{} {}", engine.kind->name, engine.version);
}

ordered_json jsonOf(const RecipeResult& found) {
  if (!found.refused.empty()) return {{"recipe", name(found.recipe)}, {"refused", found.refused}};
  return {{"recipe", name(found.recipe)}, {"error", found.error},         {"at_s", found.at},
          {"motor", found.motor + 1},     {"deviation", found.deviation}, {"power_error", found.power},
          {"seconds", found.seconds}};
}

ordered_json jsonOf(const TimeSteppingResult& found) {
  ordered_json settings = ordered_json::object();
  for (const auto& [what, value] : found.rigidity.settings) settings[what] = value;
  return {{"rigidity", found.rigidity.name},
          {"step_s", found.rigidity.step},
          {"settings", settings},
          {"steps", found.steps},
          {"gap_m", found.gap},
          {"sag_m", found.sag},
          {"away_m", found.away},
          {"energy_J", found.energy},
          {"work_J", found.work},
          {"seconds_a_step", found.seconds},
          {"gave_up", found.gave_up.empty() ? ordered_json() : ordered_json(found.gave_up)}};
}

ordered_json jsonOf(const EngineResult& engine) {
  ordered_json efforts = ordered_json::array(), in_time = ordered_json::array();
  for (const RecipeResult& found : engine.recipes) efforts.push_back(jsonOf(found));
  for (const TimeSteppingResult& found : engine.in_time) in_time.push_back(jsonOf(found));
  return {{"name", engine.kind->name},
          {"version", engine.version},
          {"refused", engine.refused.empty() ? ordered_json() : ordered_json(engine.refused)},
          {"gap_m", engine.gap},
          {"cut", engine.cut},
          {"obvious", name(engine.kind->obvious)},
          {"sentence", sentence(engine)},
          {"efforts", efforts},
          {"in_time", in_time}};
}

std::string recipeRow(const RecipeResult& found, const SideBySide& in) {
  if (!found.refused.empty()) return fmt::format("  {:<30} no: {}\n", inWords(found.recipe), found.refused);
  return fmt::format("  {:<30} {:>10.2g} {:>10.2g} {:>10.3g}  {}\n", inWords(found.recipe), found.error, found.power,
                     1e6 * found.seconds, worstText(found, in));
}

std::string timeSteppingRow(const TimeSteppingResult& found) {
  std::string settings;
  for (const auto& [what, value] : found.rigidity.settings)
    settings += fmt::format("{}{} {:g}", settings.empty() ? "" : ", ", what, value);
  return fmt::format(
      "  {:<30} {:>10.2g} {:>10.2g} {:>10.2g} {:>10.2g} {:>10.3g}  {}{}\n", found.rigidity.name, found.gap, found.sag,
      found.away, found.energy, 1e6 * found.seconds, settings,
      found.gave_up.empty() ? "" : fmt::format("; gave up after {} steps: {}", found.steps, found.gave_up));
}

}  // namespace

const char* exactCall(const EngineResult& engine) {
  return engine.of_mechanism ? engine.kind->loop_call : engine.kind->exact_call;
}

std::string worstText(const RecipeResult& found, const SideBySide& in) {
  const SideBySide::Motor& motor = in.motors.at(found.motor);
  return fmt::format("{} by {} at {:.4g}\u00a0s", motor.name, quantity(found.deviation, motor.unit), found.at);
}

const char* inWords(Recipe recipe) {
  constexpr std::array words = {"exact recipe",  "loops left open",        "rate of J left out",
                                "least squares", "its own closures, soft", "its own closures, hard"};
  return words.at(static_cast<std::size_t>(recipe));
}

std::string largestText(const SideBySide& found) {
  return quantity(found.largest_effort, found.unit) +
         (found.largest_force > 0 ? " and " + quantity(found.largest_force, "N") : "");
}

std::string errorText(double error) {
  if (error >= 10) return plainNumber(error, 3) + " times";
  return error < 1e-6 ? plainNumber(error, 2) : plainNumber(100 * error, 3) + " %";
}

std::string cutText(const EngineResult& engine, const char* before) {
  const bool is_tree = engine.kind->in_tree && !engine.cut.empty();
  return is_tree ? fmt::format("{}its tree is cut at {}", before, fmt::join(engine.cut, ", ")) : "";
}

std::vector<std::string> remarks(const SideBySide& found) {
  if (found.model.empty()) return {};
  std::string motors;
  for (const SideBySide::Motor& each : found.motors)
    motors +=
        fmt::format("{}{} up to {}", motors.empty() ? "Motors: " : ", ", each.name, quantity(each.largest, each.unit));
  return {motors + ".", fmt::format("Each engine builds the machine from the numbers that this program read in {}. "
                                    "The check model.reading of a validation compares that reading with MuJoCo's own.",
                                    found.model)};
}

std::string sentence(const EngineResult& engine) {
  if (!engine.refused.empty()) return fmt::format("{} cannot be asked: {}.", called(engine), engine.refused);
  const LoopEngineKind& kind = *engine.kind;
  const double exact = engine.of(Recipe::exact).error;
  const std::string right = fmt::format("{}: {}; that is off by {} of the largest effort", called(engine),
                                        exactCall(engine), errorText(exact));
  if (const std::string& refused = engine.of(kind.obvious).refused; !refused.empty())
    return fmt::format("{}. There is no answer by {}: {}.", right, beforeComma(kind.obvious_call), refused);
  const double obvious = engine.of(kind.obvious).error;
  if (obvious < as_good) return fmt::format("{}. On this motion {} is as good.", right, kind.obvious_call);
  const std::string hard =
      kind.has_own_inverse && engine.of(Recipe::own_inverse_hard).refused.empty()
          ? fmt::format(", with the loops at their hardest by {}", errorText(engine.of(Recipe::own_inverse_hard).error))
          : "";
  return fmt::format("{}, {} by {}{}.", right, kind.obvious_call, errorText(obvious), hard);
}

std::string sentence(const SideBySide& found) {
  double exact = 0, least = std::numeric_limits<double>::infinity(), most = 0;
  int asked = 0;
  std::vector<std::string> with_users;
  for (const EngineResult& engine : found.engines) {
    if (!engine.refused.empty()) continue;
    exact = larger(exact, engine.of(Recipe::exact).error);
    ++asked;
    if (engine.version.empty()) continue;  // this program's own formulation has no version
    if (!engine.of(engine.kind->obvious).refused.empty()) continue;
    const double obvious = engine.of(engine.kind->obvious).error;
    least = std::min(least, obvious);
    most = larger(most, obvious);
    with_users.emplace_back(engine.kind->name);
  }
  if (asked == 0) return "No engine could be asked about this machine.";
  std::string out = fmt::format("By the exact recipe {} off by at most {} of the largest effort",
                                asked == 1 ? std::string("the engine is") : report::inWords(asked) + " engines are",
                                errorText(exact));
  if (with_users.empty()) return out + ".";
  const std::string last = with_users.back();
  with_users.pop_back();
  return fmt::format("{}; what users of {}{}{} call first is off by {}{}.", out, fmt::join(with_users, ", "),
                     with_users.empty() ? "" : " and ", last, errorText(least),
                     errorText(least) == errorText(most) ? "" : " to " + errorText(most));
}

std::string sentenceOfMissing(const LoopEngineKind& kind) {
  return fmt::format(
      "{0} is not in this build, which was made without Debian's {1}. To have it: apt install {1}, then in the clone "
      "cmake build and ./dev build.",
      kind.name, kind.package);
}

std::string sideBySideText(const SideBySide& found) {
  std::string out = fmt::format("{}: {} instants, largest effort {}\n{}\n", found.scenario, found.instants,
                                largestText(found), sentence(found));
  for (const std::string& remark : remarks(found)) out += remark + "\n";
  for (const EngineResult& engine : found.engines) {
    out += fmt::format("\n{}{}\n", called(engine), cutText(engine, "; "));
    if (engine.recipes.empty()) continue;
    out += fmt::format("  {:<30} {:>10} {:>10} {:>10}\n", "efforts", "off by", "power by", "µs a pose  the worst");
    for (const RecipeResult& each : engine.recipes) out += recipeRow(each, found);
    if (engine.in_time.empty()) continue;
    out += fmt::format("  {:<30} {:>10} {:>10} {:>10} {:>10} {:>10}\n", fmt::format("moved for {:.3g} s", found.moved),
                       "gap, m", "sag, m", "away, m", "energy, J", "µs a step");
    for (const TimeSteppingResult& each : engine.in_time) out += timeSteppingRow(each);
  }
  out += "\n";
  for (const EngineResult& engine : found.engines) out += sentence(engine) + "\n";
  for (const LoopEngineKind* kind : found.missing) out += sentenceOfMissing(*kind) + "\n";
  return out;
}

std::string sideBySideJson(const SideBySide& found) {
  ordered_json engines = ordered_json::array(), missing = ordered_json::array();
  for (const EngineResult& engine : found.engines) engines.push_back(jsonOf(engine));
  for (const LoopEngineKind* kind : found.missing)
    missing.push_back({{"name", kind->name}, {"package", kind->package}});
  ordered_json motors = ordered_json::array();
  for (const SideBySide::Motor& each : found.motors)
    motors.push_back({{"name", each.name}, {"unit", each.unit == "N" ? "N" : "Nm"}, {"largest", each.largest}});
  const ordered_json document = {
      {"scenario", found.scenario},
      {"model", found.model.empty() ? ordered_json() : ordered_json(found.model)},
      {"instants", found.instants},
      {"motors", motors},
      {"largest_effort", found.largest_effort},
      {"unit", found.unit},
      {"largest_force_N", found.largest_force > 0 ? ordered_json(found.largest_force) : ordered_json()},
      {"moved_s", found.moved},
      {"sentence", sentence(found)},
      {"engines", engines},
      {"missing", missing}};
  return jsonText(document, 2) + "\n";
}

std::string sideBySideCsv(const SideBySide& found) {
  std::string out = "engine,version,what,error,power_error,step_s,gap_m,sag_m,away_m,energy_J,work_J,seconds\n";
  for (const EngineResult& engine : found.engines) {
    const std::string head = fmt::format("{},{},", engine.kind->name, engine.version);
    for (const RecipeResult& each : engine.recipes) {
      if (!each.refused.empty()) continue;
      out += fmt::format("{}{},{},{},,{},,,,,{}\n", head, name(each.recipe), each.error, each.power, engine.gap,
                         each.seconds);
    }
    for (const TimeSteppingResult& each : engine.in_time)
      out += fmt::format("{}\"{}\",,,{},{},{},{},{},{},{}\n", head, each.rigidity.name, each.rigidity.step, each.gap,
                         each.sag, each.away, each.energy, each.work, each.seconds);
  }
  return out;
}

std::string effortsCsv(const SideBySide& found) {
  std::string head = "t_s";
  std::vector<const Eigen::MatrixXd*> blocks;
  const auto add = [&](const std::string& by, const Eigen::MatrixXd& efforts) {
    for (std::size_t m = 0; m < found.motors.size(); ++m)
      head += fmt::format(",{}tau_{}_{}", by, m + 1, found.motors[m].unit == "N" ? "N" : "Nm");
    blocks.push_back(&efforts);
  };
  add("", found.efforts);
  for (const EngineResult& engine : found.engines)
    for (const RecipeResult& each : engine.recipes) {
      if (!each.refused.empty()) continue;
      std::string by = fmt::format("{}_{}_", engine.kind->name, name(each.recipe));
      for (char& c : by) c = c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      add(by, each.efforts);
    }
  std::string out = head + "\n";
  for (std::size_t k = 0; k < found.t.size(); ++k) {
    out += fmt::format("{}", found.t[k]);
    for (const Eigen::MatrixXd* block : blocks)
      for (const double effort : block->row(static_cast<Eigen::Index>(k))) out += fmt::format(",{}", effort);
    out += "\n";
  }
  return out;
}

}  // namespace ursula
