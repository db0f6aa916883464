#include "model/torque_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <regex>

#include "model/effort_units.h"

namespace ursula {
namespace {

std::optional<int> timePower(const std::string& unit) {
  if (unit == "ms") return -3;
  if (unit == "us" || unit == "µs") return -6;
  if (unit == "ns") return -9;
  return 0;
}

}  // namespace

double EffortUnit::inSI() const { return multiplier * std::pow(10.0, power); }

/// One pound-force is 0.45359237 kgf, one ounce-force a sixteenth, one inch 0.0254 m, one kgf 9.80665 N (NIST SP 811,
/// appendix B).
const std::vector<EffortUnit>& effortUnits() {
  constexpr double kgf = 9.80665, lbf = 0.45359237 * kgf, inch = 0.0254;
  constexpr auto moment = EffortKind::moment, force = EffortKind::force;
  static const std::vector<EffortUnit> units = {
      {{"Nm", "nm"}, moment, 0, 1},
      {{"kNm", "knm", "KNm"}, moment, 3, 1},
      {{"mNm", "mnm", "Nmm", "nmm"}, moment, -3, 1},
      {{"Ncm", "ncm"}, moment, -2, 1},
      {{"N", "n"}, force, 0, 1},
      {{"kN", "kn", "KN"}, force, 3, 1},
      {{"mN"}, force, -3, 1},
      {{"kgfm", "kgm"}, moment, 0, kgf, "kgf m"},
      {{"kgfcm", "kgcm"}, moment, -2, kgf, "kgf cm"},
      {{"lbfin", "lbin", "inlbf", "inlb"}, moment, 0, lbf * inch, "lbf in"},
      {{"lbfft", "lbft", "ftlbf", "ftlb"}, moment, 0, lbf * 12 * inch, "lbf ft"},
      {{"ozfin", "ozin", "inozf", "inoz"}, moment, 0, lbf / 16 * inch, "ozf in"},
      {{"kgf"}, force, 0, kgf, "kgf"},
      {{"lbf"}, force, 0, lbf, "lbf"},
      {{"ozf"}, force, 0, lbf / 16, "ozf"}};
  return units;
}

namespace {

std::string lowered(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// Interprets "Nm", "kN·m", "N mm", "mN.m", "kN", "kgf cm"; nullopt for mega, which in lower case looks like milli.
std::optional<ColumnMeaning> effortOf(int motor, std::string unit) {
  for (const char* between : {" ", ".", "*", "·", "_", "-"})
    for (auto at = unit.find(between); at != std::string::npos; at = unit.find(between))
      unit.erase(at, std::string(between).size());
  if (unit.empty()) return ColumnMeaning{motor};
  const std::string small = lowered(unit);
  const bool of_newton = small.find('n') != std::string::npos && small.find("in") == std::string::npos;
  for (const EffortUnit& each : effortUnits())
    for (const char* spelling : each.spellings)
      if ((of_newton ? unit : small) == spelling) return ColumnMeaning{motor, each.kind, each.power, each.multiplier};
  return std::nullopt;
}

/// "force 2" is a force even without a unit; people use "torque 2" less strictly.
EffortKind kindOfWord(const std::string& name) {
  return lowered(name).find("force") != std::string::npos ? EffortKind::force : EffortKind::untold;
}

/// Patterns of parts of a column's name: a unit with what leads to it and ends it, and the word for an effort.
const char* const unit_pattern =
    R"((?:[km]?N(?:[ .*·_\-]*[cm]?m)?|(?:kgf?|lbf?|ozf?)[ .*·_\-]*(?:c?m|in|ft)|(?:in|ft)[ .*·_\-]*(?:lbf?|ozf?)|kgf|lbf|ozf))";
const char *const word_pattern = "(?:tau|τ|torque|trq|force|effort)", *const gap_pattern = R"([ _.\-]*)";

std::string orUnit(const std::string& units) { return R"((?:[ _]*[\[(/_ ,][ ]*()" + units + R"()[ ]*[\])]?)?)"; }

std::regex patternOf(const std::string& text) { return std::regex(text, std::regex::icase); }

std::optional<ColumnMeaning> meaningOfEffort(int motor, const std::string& unit, const std::string& words) {
  std::optional<ColumnMeaning> meaning = effortOf(motor, unit);
  if (meaning && meaning->kind == EffortKind::untold) meaning->kind = kindOfWord(words);
  return meaning;
}

}  // namespace

std::optional<ColumnMeaning> meaningOf(const std::string& name) {
  static const std::string owner = "(?:motor|actuator|joint|leg)", gap = gap_pattern, word = word_pattern;
  static const std::string number = R"([\[({]?([0-9]{1,3})[\])}]?)", unit = orUnit(unit_pattern);
  static const std::regex time = patternOf("(?:t|time)" + orUnit("s|sec|seconds?|ms|us|µs|ns"));
  static const std::regex effort = patternOf("(?:" + owner + gap + ")?" + word + gap + number + unit);
  static const std::regex by_owner = patternOf(owner + gap + number + gap + word + unit);
  std::smatch found;
  if (std::regex_match(name, found, time))
    return ColumnMeaning{-1, EffortKind::untold, timePower(lowered(found[1])).value_or(0)};
  if (!std::regex_match(name, found, effort) && !std::regex_match(name, found, by_owner)) return std::nullopt;
  return meaningOfEffort(std::stoi(found[1]), found[2], name);
}

std::optional<ColumnMeaning> meaningByJoint(const std::string& name, const EffortAxes& motors) {
  static const std::string gap = gap_pattern, word = word_pattern;
  static const std::regex leading = patternOf(word + gap), unit = patternOf(orUnit(unit_pattern)),
                          words = patternOf(gap + word + orUnit(unit_pattern));
  std::optional<ColumnMeaning> out;
  for (int k = 0; k < motors.count(); ++k) {
    const std::string& joint = motors[k].joint;
    if (joint.empty()) continue;
    for (std::size_t at = name.find(joint); at != std::string::npos; at = name.find(joint, at + 1)) {
      const std::string before = name.substr(0, at), after = name.substr(at + joint.size());
      const bool is_led = std::regex_match(before, leading);
      if (!is_led && !before.empty()) continue;
      std::smatch found;
      const bool is_unit = std::regex_match(after, found, unit) && (is_led || found[1].matched);
      if (!is_unit && (is_led || !std::regex_match(after, found, words))) continue;
      if (const auto meaning = meaningOfEffort(k, found[1], before + (is_unit ? "" : after))) out = meaning;
    }
  }
  return out;
}

std::string unitOfColumn(const std::string& name, const EffortAxes& motors, int k) {
  static const std::string open = R"(.*[\[(/_ ,] *)", close = R"( *[\])]?)";
  static const std::regex time = patternOf(open + "(ms|us|µs|ns)" + close),
                          effort = patternOf(open + "(" + unit_pattern + ")" + close),
                          unknown = patternOf(open + "(?:kg|g|lbs?|oz)" + close + R"(|.*[\[(].*[\])])");
  std::smatch found;
  if (k < 0) return std::regex_match(name, found, time) ? found[1] == "µs" ? "us" : lowered(found[1]) : "s";
  if (!std::regex_match(name, found, effort))
    return std::regex_match(name, unknown) ? "" : motors[k].slides ? "N" : "Nm";
  const auto meaning = effortOf(k, found[1]);
  if (!meaning || !meaning->fits(motors, k)) return "";
  std::string out;
  for (const char c : found[1].str())
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) out += c;
  return out;
}

std::optional<ColumnMeaning> meaningOfTarget(const std::string& name, const EffortAxes& motors) {
  static const std::regex target(R"(t_(?:s|ms|us|ns)|tau_([1-9][0-9]{0,2})_[A-Za-z_.·\-]+)");
  std::smatch found;
  if (!std::regex_match(name, found, target)) return std::nullopt;
  std::optional<ColumnMeaning> meaning = meaningOf(name);
  if (!meaning || meaning->motor > motors.count()) return std::nullopt;
  if (meaning->motor >= 0) --meaning->motor;
  return meaning;
}

EffortAxes::EffortAxes(const Motors& motors) {
  for (const Motor& motor : motors) axes.push_back({motor.slides()});
}

EffortAxes::EffortAxes(const Mechanism& mechanism) {
  for (std::size_t k = 0; k < mechanism.motorCount(); ++k)
    axes.push_back({mechanism.motor(k).slides(), mechanism.motor(k).name});
}

std::string targetName(const EffortAxes& motors, int k) {
  return k < 0 ? "t_s" : fmt::format("tau_{}_{}", k + 1, motors[k].slides ? "N" : "Nm");
}

std::vector<std::string> targetNames(const EffortAxes& motors) {
  std::vector<std::string> out;
  for (int k = -1; k < motors.count(); ++k) out.push_back(targetName(motors, k));
  return out;
}

std::string whatItTakes(const EffortAxes& motors, int k) {
  return fmt::format("motor {} {}, expected '{}' in {}", k + 1,
                     motors[k].slides ? "slides and has a force" : "turns and has a torque", targetName(motors, k),
                     motors[k].slides ? "N" : "N·m");
}

}  // namespace ursula
