#include "model/torque_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <regex>

namespace ursula {
namespace {

std::optional<int> timePower(const std::string& unit) {
  if (unit == "ms") return -3;
  if (unit == "us" || unit == "µs") return -6;
  if (unit == "ns") return -9;
  return 0;
}

/// Interprets "Nm", "kN·m", "N mm", "mN.m", "kN"; nullopt for mega, which in lower case looks like milli.
std::optional<ColumnMeaning> effortOf(int motor, std::string unit) {
  for (const char* between : {" ", ".", "*", "·", "_", "-"})
    for (auto at = unit.find(between); at != std::string::npos; at = unit.find(between))
      unit.erase(at, std::string(between).size());
  const auto is = [&unit](std::initializer_list<const char*> spellings) {
    return std::any_of(spellings.begin(), spellings.end(), [&](const char* each) { return unit == each; });
  };
  if (unit.empty()) return ColumnMeaning{motor, 0, EffortKind::untold};
  if (is({"Nm", "nm"})) return ColumnMeaning{motor, 0, EffortKind::moment};
  if (is({"kNm", "knm", "KNm"})) return ColumnMeaning{motor, 3, EffortKind::moment};
  if (is({"mNm", "mnm", "Nmm", "nmm"})) return ColumnMeaning{motor, -3, EffortKind::moment};
  if (is({"N", "n"})) return ColumnMeaning{motor, 0, EffortKind::force};
  if (is({"kN", "kn", "KN"})) return ColumnMeaning{motor, 3, EffortKind::force};
  if (is({"mN"})) return ColumnMeaning{motor, -3, EffortKind::force};
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
  static const std::regex time("(?:t|time)" + open + "s|sec|seconds?|ms|us|µs|ns" + close, std::regex::icase);
  static const std::regex effort(
      R"((?:tau|τ|torque|trq|force|effort|(?:motor|actuator|joint|leg)[ _]?(?:torque|force|effort))[ _.\-]*[\[({]?([0-6])[\])}]?)" +
          open + R"([km]?N(?:[ .*·_\-]*m?m)?)" + close,
      std::regex::icase);
  std::smatch found;
  if (std::regex_match(name, found, time)) {
    std::string unit = found[1];
    std::transform(unit.begin(), unit.end(), unit.begin(), [](unsigned char c) { return std::tolower(c); });
    return ColumnMeaning{-1, timePower(unit).value_or(0)};
  }
  if (!std::regex_match(name, found, effort)) return std::nullopt;
  std::optional<ColumnMeaning> meaning = effortOf(found[1].str()[0] - '0', found[2]);
  if (meaning && meaning->kind == EffortKind::untold) meaning->kind = kindOfWord(name);
  return meaning;
}

std::optional<ColumnMeaning> meaningOfTarget(const std::string& name) {
  static const std::regex target(R"(t_(s|ms|us|ns)|tau_([1-6])_(k?Nm|mNm|Nmm|[km]?N))");
  if (!std::regex_match(name, target)) return std::nullopt;
  std::optional<ColumnMeaning> meaning = meaningOf(name);
  if (meaning && meaning->motor >= 0) --meaning->motor;
  return meaning;
}

std::string targetName(const Motors& motors, int k) { return k < 0 ? "t_s" : effortColumn(motors, k); }

std::vector<std::string> targetNames(const Motors& motors) {
  std::vector<std::string> out;
  for (int k = -1; k < motor_count; ++k) out.push_back(targetName(motors, k));
  return out;
}

std::string whatItTakes(const Motors& motors, int k) {
  const bool slides = motors[static_cast<std::size_t>(k)].slides();
  return fmt::format("motor {} {}, expected '{}' in {}", k + 1,
                     slides ? "slides and has a force" : "turns and has a torque", effortColumn(motors, k),
                     slides ? "N" : "N m");
}

}  // namespace ursula
