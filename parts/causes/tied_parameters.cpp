#include "parts/causes/tied_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/scalar.h"
#include "parts/causes/tried_causes.h"

namespace ursula {
namespace {

bool isEqual(double a, double b) { return std::abs(a - b) <= 1e-12 * std::max(std::abs(a), std::abs(b)); }

/// The start of all members' paths: "manipulator.leg_defaults.distal.inertia".
std::string sharedPath(const std::vector<Parameter>& members) {
  const Parameter& first = members.front();
  const bool of_one_leg =
      std::all_of(members.begin(), members.end(), [&](const Parameter& each) { return each.leg == first.leg; });
  const auto pathOf = [&](const Parameter& member) {
    if (of_one_leg) return member.path;
    return "manipulator.leg_defaults" + member.path.substr(member.path.find('.', sizeof("manipulator.leg.") - 1));
  };
  std::string shared = pathOf(first);
  for (const Parameter& member : members)
    while ((pathOf(member) + ".").rfind(shared + ".", 0) != 0) shared.erase(shared.rfind('.'));
  return shared;
}

/// Whether a value is the same for all members.
template <class F>
bool areAlike(const std::vector<Parameter>& members, F&& value) {
  return std::all_of(members.begin(), members.end(),
                     [&](const Parameter& each) { return isEqual(value(each), value(members.front())); });
}
bool areEqual(const ManipulatorParameters& machine, const std::vector<Parameter>& members) {
  return areAlike(members, [&](const Parameter& each) { return each.get(machine); });
}

/// Points move together. So may unequal lengths and mass centres, which otherwise change in proportion.
void addTogether(const ManipulatorParameters& machine, std::vector<TiedParameters>& list) {
  const std::size_t count = list.size();
  for (std::size_t k = 0; k < count; ++k) {
    const Parameter& first = list[k].members.front();
    if (first.group() == NumberGroup::point) list[k].together = true;
    if ((first.group() != NumberGroup::length && first.group() != NumberGroup::center) || first.leg < 0 ||
        areEqual(machine, list[k].members))
      continue;
    list.push_back(list[k]);
    list.back().together = true;
  }
}

}  // namespace

std::string bodyInCauses(const MachineNumber& number) {
  return number.leg >= 0 && number.body == NumberBody::none ? "legs" : name(number.body);
}

void TiedParameters::disturb(ManipulatorParameters& machine, double relative) const {
  ManipulatorParameters first = machine;
  members.front().disturb(first, relative);
  const double change = members.front().get(first) - members.front().get(machine);
  for (const Parameter& member : members)
    if (together)
      member.set(machine, member.get(machine) + change);
    else
      member.disturb(machine, relative);
}

std::string TiedParameters::text(const ManipulatorParameters& machine, double relative, double deviation) const {
  const Parameter& first = members.front();
  ManipulatorParameters changed = machine, further = machine;
  disturb(changed, relative);
  disturb(further, relative + deviation);
  const std::string unit = first.unit.empty() ? "" : " " + first.unit;
  const double before = first.get(machine), after = first.get(changed), spread = std::abs(first.get(further) - after);
  const auto change = [&](const Parameter& each) { return each.get(changed) - each.get(machine); };
  if (areEqual(machine, members))
    return fmt::format("{} {}{} instead of {:.9g}", words, withDeviation(after, spread, std::abs(before)), unit,
                       before);
  if (together || areAlike(members, change))
    return fmt::format("{} off by {}{}", words, withDeviation(after - before, spread), unit);
  const std::string amount = withDeviation(relative, deviation);
  if (first.entries == 1) return fmt::format("{} off by a relative {}", words, amount);
  return fmt::format("{} off by {} of each {}", words, amount,
                     first.group() == NumberGroup::inertia ? "tensor's largest moment" : "vector's length");
}

bool TiedParameters::isOneNumber() const {
  const Parameter& first = members.front();
  return std::all_of(members.begin(), members.end(), [&](const Parameter& each) {
    return each.body == first.body && each.quantity == first.quantity && each.entry == first.entry;
  });
}

bool TiedParameters::isPossible(const ManipulatorParameters& machine, double relative) const {
  const Parameter& first = members.front();
  const NumberGroup group = first.group();
  const bool is_size =
      group == NumberGroup::mass || group == NumberGroup::length || (group == NumberGroup::inertia && first.entry < 3);
  if (!is_size) return true;
  ManipulatorParameters changed = machine;
  disturb(changed, relative);
  return std::all_of(members.begin(), members.end(), [&](const Parameter& member) { return member.get(changed) > 0; });
}

std::optional<NamedCause> TiedParameters::named(const ManipulatorParameters& machine, double relative,
                                                double deviation) const {
  const Parameter& first = members.front();
  ManipulatorParameters changed = machine, further = machine;
  disturb(changed, relative);
  disturb(further, relative + deviation);
  const double before = first.get(machine), after = first.get(changed);
  if (!isPossible(machine, relative)) return std::nullopt;
  NamedCause out{CauseKind::parameter, "", bodyInCauses(first)};
  const auto all = [this](auto&& same) { return std::all_of(members.begin(), members.end(), same); };
  if (all([&](const Parameter& each) { return each.leg == first.leg; })) out.leg = first.leg + 1;
  out.parameter = sharedPath(members);
  if (!isOneNumber() || !areEqual(machine, members) || !areEqual(changed, members)) return out;
  out.unit = first.unit;
  out.expected = before;
  out.found = after;
  out.uncertainty = std::abs(first.get(further) - after);
  return out;
}

std::vector<TiedParameters> tiedParameters(const Manipulator& machine) {
  std::vector<TiedParameters> out, all_legs, all_links, of_legs, both_links;
  const auto add = [](std::vector<TiedParameters>& list, const std::string& words, const Parameter& member) {
    const auto found = std::find_if(list.begin(), list.end(), [&](const auto& one) { return one.words == words; });
    (found == list.end() ? list.emplace_back(TiedParameters{words, {}}) : *found).members.push_back(member);
  };
  for (const MachineNumber& number : machineNumbers(machine.parameters())) {
    const Parameter one{number};
    const std::string &words = one.words, link = name(one.body), leg = std::to_string(one.leg + 1);
    if (one.leg < 0) {
      add(out, link.empty() ? words : link + " " + words, one);
      continue;
    }
    const bool is_link = !link.empty();
    add(of_legs, fmt::format("{} of {}leg {}", words, is_link ? "the " + link + " link of " : "", leg), one);
    add(all_legs, fmt::format("{} of {}", words, is_link ? "the " + link + " links" : "every leg"), one);
    // A sliding rod's length has an effect only through its mass centre's distance from the outer end. A cylinder's
    // length has none.
    const bool is_sliding = one.body == NumberBody::distal && one.quantity == Quantity::length &&
                            rowOf(machine.leg(one.leg).kind).isTelescopic();
    if (!is_link || is_sliding) continue;
    add(all_links, words + " of all links", one);
    if (one.quantity == Quantity::inertia && one.entry < 2) {
      add(all_legs, fmt::format("inertia xx and yy of the {} links", link), one);
      add(both_links, fmt::format("inertia xx and yy of the {} link of leg {}", link, leg), one);
    }
    add(both_links, fmt::format("{} of both links of leg {}", words, leg), one);
  }
  addTogether(machine.parameters(), all_legs);
  addTogether(machine.parameters(), all_links);
  for (const auto* list : {&all_legs, &all_links, &of_legs, &both_links})
    out.insert(out.end(), list->begin(), list->end());
  return out;
}

}  // namespace ursula
