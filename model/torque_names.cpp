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

/// Interprets "Nm", "kN·m", "N mm", "mN.m", "kN", "kgf cm"; nullopt for mega, which in lower case looks like milli.
std::optional<ColumnMeaning> effortOf(int motor, std::string unit) {
  for (const char* between : {" ", ".", "*", "·", "_", "-"})
    for (auto at = unit.find(between); at != std::string::npos; at = unit.find(between))
      unit.erase(at, std::string(between).size());
  if (unit.empty()) return ColumnMeaning{motor};
  std::string small = unit;
  std::transform(small.begin(), small.end(), small.begin(), [](unsigned char c) { return std::tolower(c); });
  const bool of_newton = small.find('n') != std::string::npos && small.find("in") == std::string::npos;
  for (const EffortUnit& each : effortUnits())
    for (const char* spelling : each.spellings)
      if ((of_newton ? unit : small) == spelling) return ColumnMeaning{motor, each.kind, each.power, each.multiplier};
  return std::nullopt;
}

/// "force 2" is a force even without a unit; people use "torque 2" less strictly.
EffortKind kindOfWord(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  return name.find("force") != std::string::npos ? EffortKind::force : EffortKind::untold;
}

}  // namespace

std::optional<ColumnMeaning> meaningOf(const std::string& name) {
  static const std::string open = R"((?:[ _]*[\[(/_ ,][ ]*()", close = R"()[ ]*[\])]?)?)";
  static const std::string effort_unit =
      R"((?:[km]?N(?:[ .*·_\-]*[cm]?m)?|(?:kgf?|lbf?|ozf?)[ .*·_\-]*(?:c?m|in|ft)|(?:in|ft)[ .*·_\-]*(?:lbf?|ozf?)|kgf|lbf|ozf))";
  static const std::regex time("(?:t|time)" + open + "s|sec|seconds?|ms|us|µs|ns" + close, std::regex::icase);
  static const std::regex effort(
      R"((?:tau|τ|torque|trq|force|effort|(?:motor|actuator|joint|leg)[ _]?(?:torque|force|effort))[ _.\-]*[\[({]?([0-6])[\])}]?)" +
          open + effort_unit + close,
      std::regex::icase);
  std::smatch found;
  if (std::regex_match(name, found, time)) {
    std::string unit = found[1];
    std::transform(unit.begin(), unit.end(), unit.begin(), [](unsigned char c) { return std::tolower(c); });
    return ColumnMeaning{-1, EffortKind::untold, timePower(unit).value_or(0)};
  }
  if (!std::regex_match(name, found, effort)) return std::nullopt;
  std::optional<ColumnMeaning> meaning = effortOf(std::stoi(found[1]), found[2]);
  if (meaning && meaning->kind == EffortKind::untold) meaning->kind = kindOfWord(name);
  return meaning;
}

std::optional<ColumnMeaning> meaningByJoint(const std::string& name, const EffortAxes& motors) {
  std::optional<ColumnMeaning> out;
  for (int k = 0; k < motors.count(); ++k)
    for (const std::string& head : {"tau_" + motors[k].joint + "_", motors[k].joint + "_"}) {
      if (motors[k].joint.empty() || name.compare(0, head.size(), head) != 0 || name.size() == head.size()) continue;
      if (const auto found = effortOf(k, name.substr(head.size()))) out = found;
    }
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
