#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "parts/causes/tied_parameters.h"
#include "parts/causes/tried_causes.h"

namespace ursula {
namespace {

using Machine = ManipulatorParameters;

void addInertiaPoints(TriedCauses& out) {
  const NamedCause of_platform{CauseKind::reference_point, "inertia", "platform"};
  for (const auto& [sign, text] : {std::pair(1, " about {} used as about the mass centre"),
                                   {-1, ", about the mass centre, taken for such about {}"}})
    out.addLinks(
        "inertias of ", fmt::format(fmt::runtime(text), "the first joint"), CauseKind::reference_point, "inertia",
        [sign = sign](Link& one) { one.inertia += sign * pointInertia(one.mass, Vector3d(0, 0, one.center_of_mass)); });
  for (const auto& [sign, text] : {std::pair(1, "inertia of the platform about P used as about its mass centre"),
                                   {-1, "inertia of the platform, about its mass centre, taken for such about P"}})
    out.addMachine({text, of_platform}, [sign = sign](Machine& machine) {
      machine.platform.inertia += sign * pointInertia(machine.platform.mass, machine.platform.center_of_mass);
    });
  for (const auto& [words, sign] : {std::pair("added to", 1), {"taken off", -1}})
    out.addMachine(
        {fmt::format("m |rho|^2 {} every moment of inertia of the platform, without the outer product", words),
         of_platform},
        [sign = sign](Machine& machine) {
          Platform& one = machine.platform;
          one.inertia += sign * one.mass * one.center_of_mass.squaredNorm() * Matrix3d::Identity();
        });
}

/// Entries read in another order, or axes exchanged.
void addInertiaOrders(TriedCauses& out) {
  const auto add = [&](const std::string& words, const std::function<void(Matrix3d&)>& change) {
    out.addLinks("inertias of ", words, CauseKind::frame, "inertia", [change](Link& one) { change(one.inertia); });
    out.addMachine({"inertia of the platform" + words, {CauseKind::frame, "inertia", "platform"}},
                   [change](Machine& machine) { change(machine.platform.inertia); });
  };
  for (const auto& [order, from] : {std::pair("xx, yy, zz, xz, xy, yz", Vector3d(1, 0, 2)),
                                    {"xx, yy, zz, yz, xz, xy", Vector3d(2, 1, 0)},
                                    {"xx, yy, zz, xy, yz, xz", Vector3d(0, 2, 1)},
                                    {"xx, yy, zz, yz, xy, xz", Vector3d(2, 0, 1)}})
    add(fmt::format(" read in the order {}", order), [from = from](Matrix3d& I) {
      const Vector3d products(I(0, 1), I(0, 2), I(1, 2));
      const auto at = [&](int k) { return products(static_cast<int>(from(k))); };
      I(0, 1) = I(1, 0) = at(0), I(0, 2) = I(2, 0) = at(1), I(1, 2) = I(2, 1) = at(2);
    });
  for (const auto& [words, axes] : {std::pair(" read in the order yy, zz, xx", Eigen::Vector3i(1, 2, 0)),
                                    {" read in the order zz, xx, yy", Eigen::Vector3i(2, 0, 1)},
                                    {" with x and y exchanged", Eigen::Vector3i(1, 0, 2)},
                                    {" with x and z exchanged", Eigen::Vector3i(2, 1, 0)},
                                    {" with y and z exchanged", Eigen::Vector3i(0, 2, 1)}})
    add(words, [axes = axes](Matrix3d& I) {
      const Matrix3d before = I;
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) I(i, k) = before(axes(i), axes(k));
    });
}

void addProducts(TriedCauses& out) {
  const auto moments = [](const Matrix3d& inertia) { return Matrix3d(inertia.diagonal().asDiagonal()); };
  const auto has = [&](const Matrix3d& inertia) { return inertia != moments(inertia); };
  const auto& legs = out.machine.parameters().legs;
  const bool links_have = std::any_of(
      legs.begin(), legs.end(), [&](const Leg& leg) { return has(leg.proximal.inertia) || has(leg.distal.inertia); });
  if (has(out.machine.platform().inertia))
    out.addMachine({"inertia of the platform without products of inertia",
                    {CauseKind::parameter, "", "platform", "manipulator.platform.inertia"}},
                   [=](Machine& machine) { machine.platform.inertia = moments(machine.platform.inertia); });
  if (!links_have) return;
  out.addLinks("inertias of ", " without products of inertia", CauseKind::missing_term, "inertia",
               [=](Link& one) { one.inertia = moments(one.inertia); });
  out.addLinks("products of inertia of ", " with the wrong sign", CauseKind::sign, "inertia",
               [=](Link& one) { one.inertia = 2 * moments(one.inertia) - one.inertia; });
}

void fromOtherEnd(Link& one) { one.center_of_mass = one.length - one.center_of_mass; }

void addMassCentres(TriedCauses& out) {
  const std::pair<const char*, void (*)(Link&)> of_links[] = {
      {" measured from the other end", fromOtherEnd},
      {" taken at the middle", [](Link& one) { one.center_of_mass = one.length / 2; }},
      {" at their first joints", [](Link& one) { one.center_of_mass = 0; }},
      {" put on their lines", [](Link& one) { one.off_line.setZero(); }}};
  for (const auto& [words, change] : of_links)
    out.addLinks("mass centres of ", words, CauseKind::reference_point, "", change);
  for (const auto& [words, factor] : {std::pair("taken at P", 0), {"on the other side of P", -1}})
    out.addMachine({fmt::format("mass centre of the platform {}", words), {CauseKind::reference_point, "", "platform"}},
                   [factor = factor](Machine& machine) { machine.platform.center_of_mass *= factor; });
}

void exchangeButForLengths(Leg& leg) {
  std::swap(leg.proximal, leg.distal);
  std::swap(leg.proximal.length, leg.distal.length);
}

void addExchanged(TriedCauses& out) {
  const std::pair<const char*, void (*)(Leg&)> of_all[] = {
      {"proximal and distal links exchanged, but for their lengths", exchangeButForLengths},
      {"proximal and distal links exchanged, with their lengths",
       [](Leg& leg) { std::swap(leg.proximal, leg.distal); }},
      {"proximal and distal inertias exchanged",
       [](Leg& leg) { std::swap(leg.proximal.inertia, leg.distal.inertia); }}};
  for (const auto& [text, change] : of_all)
    out.addMachine({text, {CauseKind::parameter, "", "legs", "manipulator.leg_defaults"}},
                   [change = change](Machine& machine) {
                     for (Leg& leg : machine.legs) change(leg);
                   });
}

/// Mistakes in one leg.
void addOfOneLeg(TriedCauses& out) {
  const auto add = [&out](int leg, const std::string& text, NamedCause named, const std::function<void(Leg&)>& change) {
    named.leg = leg;
    out.addMachine({text, named}, [leg, change](Machine& machine) { change(machine.legs[leg - 1]); });
  };
  for (int leg = 1; leg <= out.machine.legCount(); ++leg)
    for (const auto& [name, link] : {std::pair("proximal", &Leg::proximal), std::pair("distal", &Leg::distal)})
      add(leg, fmt::format("mass centre of the {} link of leg {} measured from the other end", name, leg),
          {CauseKind::reference_point, "", name}, [link = link](Leg& changed) { fromOtherEnd(changed.*link); });
  for (int leg = 1; leg <= out.machine.legCount(); ++leg)
    add(leg, fmt::format("proximal and distal link of leg {} exchanged, but for their lengths", leg),
        {CauseKind::parameter, "", "legs", fmt::format("manipulator.leg.{}", leg)}, exchangeButForLengths);
}

/// Links that spin freely, held at the universal joint.
void addHeld(TriedCauses& out) {
  const std::vector<Leg>& legs = out.machine.given().legs;
  if (std::none_of(legs.begin(), legs.end(), [](const Leg& leg) { return leg.spins; })) return;
  out.addMachine(
      {"links that spin freely taken as held by their universal joints", {CauseKind::missing_term, "spin", "legs"}},
      [given = out.machine.given()](Machine& machine) {
        machine = given;
        for (Leg& leg : machine.legs) leg.spins = false;
      });
}

void addKnees(TriedCauses& out) {
  std::vector<std::size_t> bent;
  for (int i = 0; i < out.machine.legCount(); ++i)
    if (rowOf(out.machine.leg(i).kind).knee != nullptr) bent.push_back(i);
  for (int which = 1; which < 1 << bent.size(); ++which) {
    std::vector<std::size_t> legs;
    std::string names;
    for (std::size_t i = 0; i < bent.size(); ++i) {
      if ((which >> i & 1) == 0) continue;
      names += fmt::format("{}{}", legs.empty() ? "" : ", ", bent[i] + 1);
      legs.push_back(bent[i]);
    }
    const bool all = static_cast<int>(legs.size()) == out.machine.legCount();
    CauseName name(all ? "the other knee on every leg"
                       : fmt::format("the other knee on leg{} {}", legs.size() == 1 ? "" : "s", names));
    if (all) name.named = NamedCause{CauseKind::parameter, "", "legs", "manipulator.leg_defaults.knee"};
    if (legs.size() == 1) {  // the contract has no name for some legs
      name.named = NamedCause{CauseKind::parameter, "", "legs", "manipulator.leg." + names + ".knee"};
      name.named->leg = static_cast<int>(legs.front()) + 1;
    }
    out.addMachine(name, [legs](Machine& changed) {
      for (const std::size_t i : legs) {
        Knee& knee = changed.legs[i].knee;
        knee = knee == Knee::positive ? Knee::negative : Knee::positive;
      }
    });
  }
}

void addRotors(TriedCauses& out) {
  if (!hasRotors(out.machine)) return;
  for (const auto& [words, kind, times] :
       {std::tuple("left out", CauseKind::missing_term, 1), {"with the wrong sign", CauseKind::sign, 2}})
    out.addMachine(
        {fmt::format("the rotors' inertia {}", words), {kind, "rotor_inertia", "all"}},
        [](Machine& machine) {
          for (Leg& leg : machine.legs) leg.rotor_inertia = {};
        },
        times);
}

/// The unit of a tensor that is this many times too large; null if it is none.
const char* unitOfInertia(double factor) {
  for (const auto& [value, unit] :
       {std::pair(1e4, "kg cm^2"), {1e6, "kg mm^2"}, {1e7, "g cm^2"}, {1e9, "g mm^2"}, {23.730360, "lb ft^2"}})
    if (std::abs(factor / value - 1) < 1e-6) return unit;
  return nullptr;
}

void addPlatform(TriedCauses& out) {
  out.addFitted([](Machine& machine, double x) { machine.platform.inertia *= 1 + x; },
                [](double x, double deviation) {
                  const char* unit = unitOfInertia(1 + x);
                  return fmt::format("platform inertia tensor scaled by {}{}", withDeviation(1 + x, deviation),
                                     unit != nullptr ? fmt::format(" ({} for kg m^2)", unit) : "");
                },
                [](double x, double deviation) {
                  const CauseKind kind = unitOfInertia(1 + x) != nullptr ? CauseKind::units : CauseKind::scale;
                  return NamedCause{kind, "inertia", "platform", "", "", 1, 1 + x, deviation};
                });
  out.addFitted(
      [](Machine& machine, double x) {  // in units of the platform's mass
        Platform& one = machine.platform;
        const Vector3d before = one.center_of_mass, after = before / (1 + x), to_load = after, to_old = before - after;
        one.inertia += pointInertia(one.mass, to_old);
        one.inertia += pointInertia(x * one.mass, to_load);
        one.mass *= 1 + x;
        one.center_of_mass = after;
      },
      [](double x, double deviation) {
        return fmt::format("a point mass at P of {} times the platform's mass", withDeviation(x, deviation));
      },
      [](double, double) {
        return NamedCause{CauseKind::parameter, "", "platform", "manipulator.platform"};
      });
}

}  // namespace

void addMachineCauses(TriedCauses& out) {
  addPlatform(out);
  for (const TiedParameters& tied : tiedParameters(out.machine))
    if (!out.one_by_one || tied.isOneNumber()) out.addTied(tied);
  addInertiaPoints(out);
  addInertiaOrders(out);
  addProducts(out);
  addMassCentres(out);
  addExchanged(out);
  addOfOneLeg(out);
  addHeld(out);
  addKnees(out);
  addRotors(out);
  addPointCauses(out);
  addFrictionCauses(out);
}

}  // namespace ursula
