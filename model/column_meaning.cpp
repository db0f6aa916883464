#include "model/column_meaning.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <regex>
#include <vector>

#include "base/scalar.h"
#include "model/torque_names.h"

namespace ursula {
namespace {

constexpr const char* unit_tail = R"((?:[ _]*[\[(/_ ,][ ]*(rad|deg|degrees|°|mm|m|mA|A|kN|N|kNm|Nm)?[ ]*[\])]?)?)";

double factorOf(const std::string& unit) {
  if (unit == "deg" || unit == "degrees" || unit == "°") return degree;
  if (unit == "mm" || unit == "mA") return 1e-3;
  return unit == "kN" || unit == "kNm" ? 1e3 : 1;
}

std::optional<Coordinate> coordinateOf(const std::string& name) {
  for (const Coordinate each : {Coordinate::phi, Coordinate::psi, Coordinate::theta, Coordinate::d})
    if (name == nameOf(each)) return each;
  return std::nullopt;
}

/// Angles have a unit: roll alone may be in either.
std::optional<Column> namedAxis(std::string name, const std::string& unit) {
  static const std::vector<std::string> names = {"surge", "sway", "heave", "roll", "pitch", "yaw"};
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  const int k = static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
  const bool is_length = unit.empty() || unit == "m" || unit == "mm";
  const bool is_angle = unit == "rad" || factorOf(unit) == degree;
  if (k < 3 ? !is_length : !is_angle) return std::nullopt;
  return Column{k < 3 ? ColumnQuantity::position : ColumnQuantity::angle, k % 3, factorOf(unit)};
}

}  // namespace

std::optional<Column> meaningOfColumn(const std::string& name) {
  static const std::string tail = unit_tail;
  static const std::regex of_leg("(phi|psi|theta|d)_?([0-6])" + tail);
  static const std::regex of_motor(
      "(?:q|pos|position|enc|encoder|angle|length|joint|joint[ _]pos(?:ition)?)[ _]?([0-6])" + tail, std::regex::icase);
  static const std::regex current("(?:i|current|motor[ _]?current)[ _]?([0-6])" + tail, std::regex::icase);
  static const std::regex vector("([pqfm])_?([wxyz])" + tail);
  static const std::regex named("(surge|sway|heave|roll|pitch|yaw)" + tail, std::regex::icase);
  std::smatch found;
  if (const auto torque = meaningOf(name); torque && torque->motor <= motor_count)
    return Column{torque->motor < 0 ? ColumnQuantity::time : ColumnQuantity::effort, torque->motor,
                  std::pow(10.0, torque->power) * torque->multiplier};
  const auto digit = [&](std::size_t group) { return found[group].str()[0] - '0'; };
  if (std::regex_match(name, found, of_leg))
    return Column{ColumnQuantity::driven, digit(2), factorOf(found[3]), 0, name, coordinateOf(found[1])};
  if (std::regex_match(name, found, of_motor)) return Column{ColumnQuantity::driven, digit(1), factorOf(found[2])};
  if (std::regex_match(name, found, current)) return Column{ColumnQuantity::current, digit(1), factorOf(found[2])};
  if (std::regex_match(name, found, named)) return namedAxis(found[1], found[2]);
  if (!std::regex_match(name, found, vector)) return std::nullopt;
  const std::string unit = found[3];
  const auto vectorOf = [&](ColumnQuantity quantity, const char* axes, std::initializer_list<const char*> units) {
    const auto axis = std::string(axes).find(found[2]);
    const bool fits = unit.empty() || std::find(units.begin(), units.end(), unit) != units.end();
    if (axis == std::string::npos || !fits) return std::optional<Column>();
    return std::optional(Column{quantity, static_cast<int>(axis), factorOf(unit)});
  };
  switch (found[1].str()[0]) {
    case 'p':
      return vectorOf(ColumnQuantity::position, "xyz", {"m", "mm"});
    case 'q':
      return vectorOf(ColumnQuantity::quaternion, "wxyz", {});
    case 'f':
      return vectorOf(ColumnQuantity::force, "xyz", {"N", "kN"});
    default:
      return vectorOf(ColumnQuantity::moment, "xyz", {"Nm", "kNm"});
  }
}

std::string drivenName(const Motor& motor) {
  return fmt::format("{}_{}_{}", nameOf(motor.coordinate), motor.leg + 1, motor.slides() ? "m" : "rad");
}

std::string contractName(ColumnQuantity quantity, int k, const Motors& motors) {
  const auto of = [k](const char* form, const char* axes) { return fmt::format(fmt::runtime(form), axes[k]); };
  static constexpr const char* angles[] = {"roll_rad", "pitch_rad", "yaw_rad"};
  switch (quantity) {
    case ColumnQuantity::time:
      return "t_s";
    case ColumnQuantity::driven:
      return drivenName(motors[k]);
    case ColumnQuantity::position:
      return of("p_{}_m", "xyz");
    case ColumnQuantity::quaternion:
      return of("q_{}", "wxyz");
    case ColumnQuantity::angle:
      return angles[k];
    case ColumnQuantity::effort:
      return effortColumn(motors, k);
    case ColumnQuantity::current:
      return fmt::format("i_{}_A", k + 1);
    case ColumnQuantity::force:
      return of("f_{}_N", "xyz");
    case ColumnQuantity::moment:
      return of("m_{}_Nm", "xyz");
  }
  return "";
}

}  // namespace ursula
