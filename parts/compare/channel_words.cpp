#include <fmt/format.h>

#include <regex>

#include "parts/compare/compare_page.h"
#include "report/text/quantity.h"

namespace ursula {
namespace {

struct Quantity {
  const char *name, *words;
};

/// Quantities of a motor or leg, which a number follows, and of the platform, which an axis may follow.
constexpr Quantity quantities[] = {Quantity{"tau", "effort of motor"},
                                   {"noc_tau", "NOC's effort of motor"},
                                   {"simbody_tau", "Simbody's effort of motor"},
                                   {"error_tau", "largest deviation of the efforts"},
                                   {"limit_tau", "limit of the effort of motor"},
                                   {"phi", "angle φ of leg"},
                                   {"psi", "angle ψ of leg"},
                                   {"theta", "angle θ of leg"},
                                   {"d", "displacement of leg"},
                                   {"phidot", "rate of φ of leg"},
                                   {"psidot", "rate of ψ of leg"},
                                   {"thetadot", "rate of θ of leg"},
                                   {"ddot", "sliding speed of leg"},
                                   {"qdot", "rate of motor"},
                                   {"qddot", "acceleration of motor"},
                                   {"p", "position of P"},
                                   {"q", "orientation"},
                                   {"v", "velocity of P"},
                                   {"w", "angular velocity"},
                                   {"a", "acceleration of P"},
                                   {"alpha", "angular acceleration"},
                                   {"output", "position of the output"},
                                   {"error_acceleration", "error of Simbody's acceleration"},
                                   {"limit_acceleration", "limit of Simbody's acceleration"},
                                   {"error_p", "replay's error of position"},
                                   {"error_q", "replay's error of orientation"},
                                   {"closure_p", "gap of the loops"},
                                   {"closure_v", "speed of the loops' gap"},
                                   {"error_energy", "energy less work"},
                                   {"reaction_fA", "force at the base of leg"},
                                   {"reaction_fR", "force between the links of leg"},
                                   {"reaction_fB", "force at the platform of leg"},
                                   {"reaction_nA", "moment at the base of leg"},
                                   {"reaction_nR", "moment between the links of leg"}};

std::string wordsOf(const std::string& name) {
  for (const Quantity& each : quantities)
    if (name == each.name) return each.words;
  return "";
}

std::string replacedAll(std::string text, char from, char to) {
  for (char& c : text) c = c == from ? to : c;
  return text;
}

}  // namespace

std::string unitOf(const std::string& channel) {
  for (const std::string unit : {"rad_s2", "m_s2", "rad_s", "m_s", "Nm", "rad", "N", "m", "J", "W", "s"}) {
    const std::string ending = "_" + unit;
    if (channel.size() > ending.size() && channel.compare(channel.size() - ending.size(), ending.size(), ending) == 0)
      return unit;
  }
  return "";
}

std::string channelWords(const std::string& channel) {
  static const std::regex form("(sim_)?([A-Za-z]+(?:_[A-Za-z]+)*?)(?:_([wxyz]))?(?:_([0-9]+))?");
  const std::string unit = unitOf(channel);
  const std::string bare = unit.empty() ? channel : channel.substr(0, channel.size() - unit.size() - 1);
  std::smatch part;
  if (!std::regex_match(bare, part, form)) return replacedAll(bare, '_', ' ');
  std::string words = wordsOf(part[2]);
  if (part[2] == "q" && part[4].matched) words = "coordinate of motor";
  if (words.empty()) return replacedAll(bare, '_', ' ');
  for (const auto& [of_unit, noun] : {std::pair<std::string, std::string>{"N", "force"}, {"Nm", "torque"}})
    if (const std::size_t at = words.find("effort"); unit == of_unit && at != std::string::npos)
      words.replace(at, 6, noun);
  if (!part[4].matched && words.size() > 9 && words.substr(words.size() - 9) == " of motor") words += "s";
  if (part[1].matched) words = "simulated " + words;
  if (part[4].matched) words += " " + part[4].str();
  return part[3].matched ? words + ", " + part[3].str() : words;
}

bool isDerived(const std::string& channel) {
  static const std::regex form("(error|limit|closure|noc|simbody)_.*");
  return std::regex_match(channel, form);
}

}  // namespace ursula
