#include "validation/external/tied_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/scalar.h"
#include "validation/external/cause.h"

namespace ursula {
namespace {

struct Quantity {
  std::string words, unit;
};

/// Of the last parts of a parameter's name.
Quantity quantityOf(const std::string& name) {
  static const std::map<std::string, Quantity> known{
      {"gravity", {"gravity", "m/s^2"}},
      {"mass", {"mass", "kg"}},
      {"center_of_mass", {"mass centre", "m"}},
      {"inertia", {"inertia", "kg m^2"}},
      {"length", {"length", "m"}},
      {"base_point", {"base point", "m"}},
      {"platform_point", {"platform point", "m"}},
      {"base_axis", {"base axis", "rad"}},
      {"friction.phi", {"viscous friction on phi", "N m s/rad"}},
      {"friction.psi", {"viscous friction on psi", "N m s/rad"}},
      {"friction.theta", {"viscous friction on theta", "N m s/rad"}},
      {"friction.d", {"viscous friction on d", "N s/m"}},
      {"coulomb.d", {"Coulomb friction on d", "N"}},
      {"coulomb.sliding_speed", {"smoothing speed of the Coulomb friction on d", "m/s"}},
      {"coulomb.phi", {"Coulomb friction on phi", "N m"}},
      {"coulomb.psi", {"Coulomb friction on psi", "N m"}},
      {"coulomb.theta", {"Coulomb friction on theta", "N m"}},
      {"coulomb.smoothing_speed", {"smoothing speed of the Coulomb friction", "rad/s"}}};
  const auto found = known.find(name);
  if (found != known.end()) return found->second;
  const auto point = name.rfind('.');
  const Quantity whole = point == std::string::npos ? Quantity{name, ""} : quantityOf(name.substr(0, point));
  const std::string part = point == std::string::npos ? "" : name.substr(point + 1);
  return {part == "across" || part == "along"
              ? fmt::format("{} (turned {})", whole.words, part == "across" ? "one way" : "the other way")
              : whole.words + " " + part,
          whole.unit};
}

/// "leg[2].proximal.mass" in its parts.
struct Name {
  std::string leg, link, quantity;  ///< "2", "proximal", "mass"; the first two may be empty

  explicit Name(const std::string& name) : quantity(name) {
    if (name.rfind("leg[", 0) == 0) {
      leg = name.substr(4, 1);
      quantity = name.substr(name.find('.') + 1);
    }
    for (const char* part : {"proximal.", "distal.", "platform."})
      if (quantity.rfind(part, 0) == 0) {
        link = std::string(part).substr(0, std::string(part).size() - 1);
        quantity = quantity.substr(link.size() + 1);
      }
  }
};

std::string ownerOf(const Name& name) {
  if (name.leg.empty()) return name.link;
  return name.link.empty() ? "of leg " + name.leg : fmt::format("of the {} link of leg {}", name.link, name.leg);
}

bool isEqual(double a, double b) { return std::abs(a - b) <= 1e-12 * std::max(std::abs(a), std::abs(b)); }

}  // namespace

void TiedParameters::disturb(ManipulatorParameters& machine, double relative) const {
  for (const Parameter& member : members) member.disturb(machine, relative);
}

std::string TiedParameters::text(const ManipulatorParameters& machine, double relative, double deviation) const {
  if (!members.front().value) {
    constexpr double degrees = 57.29577951308232;
    return fmt::format("{} by {} deg", words, withDeviation(degrees * relative, degrees * deviation));
  }
  ManipulatorParameters changed = machine, further = machine;
  disturb(changed, relative);
  disturb(further, relative + deviation);
  bool same_before = true, same_change = true;
  const auto value = [](const Parameter& one, const ManipulatorParameters& of) { return one.value(of); };
  const double before = value(members.front(), machine), after = value(members.front(), changed);
  for (const Parameter& member : members) {
    same_before = same_before && isEqual(value(member, machine), before);
    same_change = same_change && isEqual(value(member, changed) - value(member, machine), after - before);
  }
  const double spread = std::abs(value(members.front(), further) - after);
  if (same_before) return fmt::format("{} {} {} instead of {:.9g}", words, withDeviation(after, spread), unit, before);
  if (same_change) return fmt::format("{} off by {} {}", words, withDeviation(after - before, spread), unit);
  return fmt::format("{} off by a relative {}", words, withDeviation(relative, deviation));
}

std::vector<TiedParameters> tiedParameters(const Manipulator& machine) {
  std::vector<TiedParameters> all_legs, all_links, both_links, single;
  const auto add = [](std::vector<TiedParameters>& list, const std::string& words, const std::string& unit,
                      const Parameter& member) {
    const auto found = std::find_if(list.begin(), list.end(), [&](const auto& one) { return one.words == words; });
    (found == list.end() ? list.emplace_back(TiedParameters{words, unit, {}}) : *found).members.push_back(member);
  };
  for (const Parameter& parameter : allParameters(machine)) {
    const Name name(parameter.name);
    const Quantity quantity = quantityOf(name.quantity);
    const std::string owner = ownerOf(name);
    add(single,
        owner.empty()      ? quantity.words
        : name.leg.empty() ? "platform " + quantity.words
                           : quantity.words + " " + owner,
        quantity.unit, parameter);
    if (name.leg.empty()) continue;
    const bool is_link = !name.link.empty();
    add(all_legs, fmt::format("{} of {}", quantity.words, is_link ? "the " + name.link + " links" : "every leg"),
        quantity.unit, parameter);
    if (!is_link) continue;
    add(all_links, quantity.words + " of all links", quantity.unit, parameter);
    if (name.quantity == "inertia.xx" || name.quantity == "inertia.yy") {
      add(all_legs, fmt::format("inertia xx and yy of the {} links", name.link), quantity.unit, parameter);
      add(both_links, fmt::format("inertia xx and yy of the {} link of leg {}", name.link, name.leg), quantity.unit,
          parameter);
    }
    add(both_links, fmt::format("{} of both links of leg {}", quantity.words, name.leg), quantity.unit, parameter);
  }
  std::vector<TiedParameters> out = single;
  const auto legless = std::stable_partition(
      out.begin(), out.end(), [](const TiedParameters& one) { return one.members.front().name.rfind("leg[", 0) != 0; });
  std::vector<TiedParameters> ordered(out.begin(), legless);
  for (const auto* list : {&all_legs, &all_links}) ordered.insert(ordered.end(), list->begin(), list->end());
  ordered.insert(ordered.end(), legless, out.end());
  ordered.insert(ordered.end(), both_links.begin(), both_links.end());
  return ordered;
}

}  // namespace ursula
