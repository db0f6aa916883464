#include "report/page/sections.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <set>

#include "report/page/html_template.h"
#include "report/text/quantity.h"
#include "report/text/text.h"

namespace ursula::report {

extern const std::string_view input_html;  // of web/

namespace {

std::string digits(double value) { return fmt::format("{:.6g}", value); }

std::string vectorText(const Vector3d& v) { return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", v.x(), v.y(), v.z()); }

std::string inertiaText(const Matrix3d& I) {
  const std::string diagonal = fmt::format("[{:.6g}, {:.6g}, {:.6g}", I(0, 0), I(1, 1), I(2, 2));
  if (I(0, 1) == 0 && I(0, 2) == 0 && I(1, 2) == 0) return diagonal + "]";
  return diagonal + fmt::format(", {:.6g}, {:.6g}, {:.6g}]", I(0, 1), I(0, 2), I(1, 2));
}

HtmlValue fact(const std::string& what, const std::string& value) { return {{"what", what}, {"value", value}}; }

std::string linkText(const Link& link) {
  const std::string length = link.length > 0 ? fmt::format("length {} m, ", digits(link.length)) : "";
  const std::string off = link.off_line.isZero(0) ? "" : fmt::format(" and {} m across", vectorText(link.off_line));
  return length + fmt::format("mass {} kg, mass centre at {} m{}, inertia {} kg·m²", digits(link.mass),
                              digits(link.center_of_mass), off, inertiaText(link.inertia));
}

constexpr std::array<const char*, coordinate_count> symbols = {"φ", "ψ", "θ", "d"};  // in the order of Coordinate

const char* symbol(Coordinate coordinate) { return symbols[static_cast<std::size_t>(coordinate)]; }

/// The coefficients of the leg's coordinates; rotating and sliding ones have their own unit.
std::string frictionText(const JointFriction& friction, LegKind kind, const char* turning, const char* sliding) {
  if (!friction.any()) return "none";
  const auto list = [&](bool slide, const char* unit) {
    std::string out;
    for (const Coordinate each : rowOf(kind).coordinates)
      if (slides(each) == slide)
        out += fmt::format("{}{} {}", out.empty() ? "" : ", ", symbol(each), digits(friction.on(each)));
    return out.empty() ? out : out + " " + unit;
  };
  const std::string turned = list(false, turning), slid = list(true, sliding);
  return turned + (turned.empty() || slid.empty() ? "" : ", ") + slid;
}

/// The legs in words: the kind, then the driven coordinates.
std::string kindText(const Leg& leg) {
  const LegKindRow& kind = rowOf(leg.kind);
  // The paper's kind has a name of its own.
  const std::string words = leg.kind == LegKind::URS ? kind.joints : fmt::format("{}, {}", kind.words, kind.joints);
  std::string driven;
  for (std::size_t j = 0; j < 3; ++j)
    if (leg.actuated[j])
      driven += (driven.empty() ? "" : " and ") + std::string(symbol(rowOf(leg.kind).coordinates[j]));
  return fmt::format("{}: {}; {}", kind.name, words, driven.empty() ? "no motor" : "a motor on " + driven);
}

std::string loadText(const Load* load) {
  if (load == nullptr) return "none";
  if (load->history) return fmt::format("a table of {} rows", load->history->rows().size());
  return fmt::format("force {} N, moment {} N·m, at {} m of M", vectorText(load->force), vectorText(load->moment),
                     vectorText(load->point));
}

/// Legs with the same text share a row.
template <class Text>
void addByLegs(const char* what, const Manipulator& machine, const Text& text, std::vector<HtmlValue>& facts) {
  std::set<std::string> done;
  for (int i = 0; i < machine.legCount(); ++i) {
    const std::string mine = text(machine.leg(i));
    if (!done.insert(mine).second) continue;
    std::string legs;
    bool all = true;
    for (int k = 0; k < machine.legCount(); ++k) {
      const bool shared = text(machine.leg(k)) == mine;
      all = all && shared;
      if (shared) legs += (legs.empty() ? "" : ", ") + std::to_string(k + 1);
    }
    facts.push_back(fact(all ? std::string(what) + ", every leg" : fmt::format("{}, leg {}", what, legs), mine));
  }
}

std::vector<HtmlValue> legsOf(const Manipulator& machine) {
  std::vector<HtmlValue> out;
  for (int i = 0; i < machine.legCount(); ++i) {
    const Leg& leg = machine.leg(i);
    out.push_back({{"leg", i + 1},
                   {"base_point", vectorText(leg.base_point)},
                   {"base_axis", vectorText(leg.base_axis)},
                   {"platform_point", vectorText(leg.platform_point)},
                   {"knee", rowOf(leg.kind).knee == nullptr ? "–"
                            : leg.knee == Knee::positive    ? "positive"
                                                            : "negative"}});
  }
  return out;
}

}  // namespace

std::string machineLine(const Picture& picture) {
  const Scenario& scenario = picture.scenario;
  std::set<std::string> kinds;
  for (const Picture::Leg& leg : picture.legs) kinds.insert(leg.kind);
  std::string kind;
  for (const std::string& each : kinds) kind += (kind.empty() ? "" : " and ") + each;
  std::string line = fmt::format("{} {} legs carry a platform of {} kg", inWords(static_cast<int>(picture.legs.size())),
                                 kind, digits(scenario.manipulator->platform().mass));
  line[0] = static_cast<char>(line[0] - 'a' + 'A');
  return line + fmt::format(" · {}, {}", scenario.trajectory->kind(), quantity(scenario.trajectory->duration(), "s")) +
         (scenario.load ? " · under a load" : "");
}

std::string inputCard(const Picture& picture) {
  const Scenario& scenario = picture.scenario;
  const Manipulator& machine = *scenario.manipulator;
  const Platform& platform = machine.platform();
  std::vector<HtmlValue> facts = {
      fact("Gravity", vectorText(machine.gravity()) + " m/s²"),
      fact("Platform", fmt::format("mass {} kg, mass centre {} m in M, inertia {} kg·m²", digits(platform.mass),
                                   vectorText(platform.center_of_mass), inertiaText(platform.inertia)))};
  const auto add = [&](const char* what, const auto& text) { addByLegs(what, machine, text, facts); };
  add("Kind", kindText);
  add("Proximal link", [](const Leg& leg) { return linkText(leg.proximal); });
  add("Distal link", [](const Leg& leg) { return linkText(leg.distal); });
  add("Viscous friction", [](const Leg& leg) { return frictionText(leg.friction, leg.kind, "N·m·s/rad", "N·s/m"); });
  add("Coulomb friction", [](const Leg& leg) { return frictionText(leg.coulomb, leg.kind, "N·m", "N"); });
  if (hasRotors(machine))
    add("Rotor inertia", [](const Leg& leg) { return frictionText(leg.rotor_inertia, leg.kind, "kg·m²", "kg"); });
  const auto& legs = machine.parameters().legs;
  if (std::any_of(legs.begin(), legs.end(), [](const Leg& leg) { return leg.spins; }))
    add("Spin", [](const Leg& leg) { return std::string(leg.spins ? "free" : "held"); });
  facts.push_back(fact("Load", loadText(scenario.load.get())));
  facts.push_back(fact("Motion", fmt::format("{}, {} s, judged at {} instants", scenario.trajectory->kind(),
                                             digits(scenario.trajectory->duration()), scenario.simulation.samples)));
  return rendered(input_html, {{"facts", facts}, {"legs", legsOf(machine)}});
}

}  // namespace ursula::report
