#include "validation/mistakes/tried_causes.h"

#include <fmt/format.h>

#include <cmath>
#include <tuple>
#include <utility>

#include "validation/mistakes/machine_collector.h"
#include "validation/mistakes/tied_parameters.h"

namespace ursula {
namespace {

using Machine = ManipulatorParameters;

/// The tensor about the mass centre with m (r² 1 − r rᵀ) added or subtracted.
Matrix3d moved(const Matrix3d& inertia, double mass, const Vector3d& r, double sign) {
  return inertia + sign * mass * (r.squaredNorm() * Matrix3d::Identity() - r * r.transpose());
}

void addInertias(MachineCauses& out) {
  const NamedCause platform_inertia{CauseKind::reference_point, "inertia", "platform"};
  const auto link = [](double sign, bool from_end) {
    return [sign, from_end](Link& one) {
      const double r = from_end ? one.length - one.center_of_mass : one.center_of_mass;
      one.inertia = moved(one.inertia, one.mass, Vector3d(0, 0, r), sign);
    };
  };
  out.addLinks("inertias of ", " about the first joint used as about the mass centre", CauseKind::reference_point,
               "inertia", link(1, false));
  out.addLinks("inertias of ", ", about the mass centre, taken for such about the first joint",
               CauseKind::reference_point, "inertia", link(-1, false));
  out.addFixed({"inertia of the platform about P used as about its mass centre", platform_inertia},
               [](Machine& machine) {
                 Platform& one = machine.platform;
                 one.inertia = moved(one.inertia, one.mass, one.center_of_mass, 1);
               });
  out.addFixed({"inertia of the platform, about its mass centre, taken for such about P", platform_inertia},
               [](Machine& machine) {
                 Platform& one = machine.platform;
                 one.inertia = moved(one.inertia, one.mass, one.center_of_mass, -1);
               });
  for (const auto& [words, sign] : {std::pair("added to", 1), {"taken off", -1}})
    out.addFixed({fmt::format("m |rho|^2 {} every moment of inertia of the platform, without the outer product", words),
                  platform_inertia},
                 [sign = sign](Machine& machine) {
                   Platform& one = machine.platform;
                   one.inertia += sign * one.mass * one.center_of_mass.squaredNorm() * Matrix3d::Identity();
                 });
  const auto add_order = [&](const char* order, const std::function<void(Matrix3d&)>& change) {
    const std::string words = fmt::format(" read in the order {}", order);
    out.addLinks("inertias of ", words, CauseKind::frame, "inertia", [change](Link& one) { change(one.inertia); });
    out.addFixed({"inertia of the platform" + words, NamedCause{CauseKind::frame, "inertia", "platform"}},
                 [change](Machine& machine) { change(machine.platform.inertia); });
  };
  for (const auto& [order, from] : {std::pair("xx, yy, zz, xz, xy, yz", Vector3d(1, 0, 2)),
                                    {"xx, yy, zz, yz, xz, xy", Vector3d(2, 1, 0)},
                                    {"xx, yy, zz, xy, yz, xz", Vector3d(0, 2, 1)},
                                    {"xx, yy, zz, yz, xy, xz", Vector3d(2, 0, 1)}})
    add_order(order, [from = from](Matrix3d& I) {
      const Vector3d products(I(0, 1), I(0, 2), I(1, 2));
      const auto at = [&](int k) { return products(static_cast<int>(from(k))); };
      I(0, 1) = I(1, 0) = at(0), I(0, 2) = I(2, 0) = at(1), I(1, 2) = I(2, 1) = at(2);
    });
  for (const int first : {1, 2})
    add_order(first == 1 ? "yy, zz, xx" : "zz, xx, yy", [first](Matrix3d& I) {
      const Matrix3d before = I;
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) I(i, k) = before((i + first) % 3, (k + first) % 3);
    });
  const std::tuple<const char*, int, int> exchanged[] = {{"x and y", 0, 1}, {"x and z", 0, 2}, {"y and z", 1, 2}};
  for (const auto& [axes, i, k] : exchanged) {
    const auto exchange = [i = i, k = k](Matrix3d& inertia) {
      inertia.row(i).swap(inertia.row(k));
      inertia.col(i).swap(inertia.col(k));
    };
    const std::string words = fmt::format(" with {} exchanged", axes);
    out.addLinks("inertias of ", words, CauseKind::frame, "inertia", [exchange](Link& one) { exchange(one.inertia); });
    out.addFixed({"inertia of the platform" + words, NamedCause{CauseKind::frame, "inertia", "platform"}},
                 [exchange](Machine& machine) { exchange(machine.platform.inertia); });
  }
  out.addFixed({"inertia of the platform without products of inertia",
                NamedCause{CauseKind::parameter, "", "platform", "manipulator.platform.inertia"}},
               [](Machine& machine) {
                 Matrix3d& inertia = machine.platform.inertia;
                 inertia = inertia.diagonal().asDiagonal().toDenseMatrix();
               });
  out.addLinks("inertias of ", " without products of inertia", CauseKind::missing_term, "inertia",
               [](Link& one) { one.inertia = one.inertia.diagonal().asDiagonal().toDenseMatrix(); });
  out.addLinks("products of inertia of ", " with the wrong sign", CauseKind::sign, "inertia",
               [](Link& one) { one.inertia = 2 * one.inertia.diagonal().asDiagonal().toDenseMatrix() - one.inertia; });
}

/// One link alone.
void addOtherEnds(int legs, MachineCauses& out) {
  for (int i = 0; i < legs; ++i)
    for (const auto& [name, link] : {std::pair("proximal", &Leg::proximal), std::pair("distal", &Leg::distal)}) {
      NamedCause named{CauseKind::reference_point, "", name};
      named.leg = i + 1;
      out.addFixed(
          {fmt::format("mass centre of the {} link of leg {} measured from the other end", name, i + 1), named},
          [i, link = link](Machine& machine) {
            Link& one = machine.legs[static_cast<std::size_t>(i)].*link;
            one.center_of_mass = one.length - one.center_of_mass;
          });
    }
}

void addExchanged(MachineCauses& out) {
  const NamedCause platform_centre{CauseKind::reference_point, "", "platform"};
  out.addLinks("mass centres of ", " measured from the other end", CauseKind::reference_point, "",
               [](Link& one) { one.center_of_mass = one.length - one.center_of_mass; });
  out.addLinks("mass centres of ", " taken at the middle", CauseKind::reference_point, "",
               [](Link& one) { one.center_of_mass = one.length / 2; });
  out.addLinks("mass centres of ", " at their first joints", CauseKind::reference_point, "",
               [](Link& one) { one.center_of_mass = 0; });
  out.addLinks("mass centres of ", " put on their lines", CauseKind::reference_point, "",
               [](Link& one) { one.off_line.setZero(); });
  out.addFixed({"mass centre of the platform taken at P", platform_centre},
               [](Machine& machine) { machine.platform.center_of_mass.setZero(); });
  out.addFixed({"mass centre of the platform on the other side of P", platform_centre},
               [](Machine& machine) { machine.platform.center_of_mass *= -1; });
  const NamedCause of_links{CauseKind::parameter, "", "legs", "manipulator.leg_defaults"};
  out.addFixed({"proximal and distal links exchanged, but for their lengths", of_links}, [](Machine& machine) {
    for (Leg& leg : machine.legs) {
      std::swap(leg.proximal, leg.distal);
      std::swap(leg.proximal.length, leg.distal.length);
    }
  });
  out.addFixed({"proximal and distal links exchanged, with their lengths", of_links}, [](Machine& machine) {
    for (Leg& leg : machine.legs) std::swap(leg.proximal, leg.distal);
  });
  out.addFixed({"proximal and distal inertias exchanged", of_links}, [](Machine& machine) {
    for (Leg& leg : machine.legs) std::swap(leg.proximal.inertia, leg.distal.inertia);
  });
}

/// The links of one leg exchanged.
void addExchangedOf(int legs, MachineCauses& out) {
  for (int i = 0; i < legs; ++i) {
    NamedCause named{CauseKind::parameter, "", "legs", fmt::format("manipulator.leg.{}", i + 1)};
    named.leg = i + 1;
    out.addFixed({fmt::format("proximal and distal link of leg {} exchanged, but for their lengths", i + 1), named},
                 [i](Machine& machine) {
                   Leg& leg = machine.legs[static_cast<std::size_t>(i)];
                   std::swap(leg.proximal, leg.distal);
                   std::swap(leg.proximal.length, leg.distal.length);
                 });
  }
}

/// Links that spin freely, held at the universal joint.
void addHeld(const Machine& given, MachineCauses& out) {
  out.addFixed({"links that spin freely taken as held by their universal joints",
                NamedCause{CauseKind::missing_term, "spin", "legs"}},
               [given](Machine& machine) {
                 machine = given;
                 for (Leg& leg : machine.legs) leg.spins = false;
               });
}

/// Legs with a knee.
std::vector<std::size_t> bentLegs(const Manipulator& machine) {
  std::vector<std::size_t> out;
  for (int i = 0; i < machine.legCount(); ++i)
    if (rowOf(machine.leg(i).kind).knee != nullptr) out.push_back(static_cast<std::size_t>(i));
  return out;
}

void addKnees(const Manipulator& machine, MachineCauses& out) {
  const std::vector<std::size_t> bent = bentLegs(machine);
  const int all = static_cast<int>(bent.size());
  for (int legs = 1; legs < 1 << all; ++legs) {
    std::string names;
    int count = 0;
    for (int i = 0; i < all; ++i)
      if (legs >> i & 1) names += fmt::format("{}{}", count++ == 0 ? "" : ", ", bent[static_cast<std::size_t>(i)] + 1);
    std::optional<NamedCause> named = NamedCause{CauseKind::parameter, "", "legs", "manipulator.leg_defaults.knee"};
    if (count == 1) {
      named->leg = std::stoi(names);
      named->parameter = "manipulator.leg." + names + ".knee";
    } else if (count < machine.legCount()) {
      named.reset();  // the contract has no name for some legs
    }
    out.addFixed({count == machine.legCount() ? std::string("the other knee on every leg")
                                              : fmt::format("the other knee on leg{} {}", count == 1 ? "" : "s", names),
                  named},
                 [legs, bent](Machine& changed) {
                   for (std::size_t i = 0; i < bent.size(); ++i) {
                     Knee& knee = changed.legs[bent[i]].knee;
                     if (legs >> i & 1) knee = knee == Knee::positive ? Knee::negative : Knee::positive;
                   }
                 });
  }
}

void addRotors(const Scenario& scenario, MachineCauses& out) {
  if (hasRotors(*scenario.manipulator))
    for (const auto& [words, kind, times] :
         {std::tuple("left out", CauseKind::missing_term, 1), {"with the wrong sign", CauseKind::sign, 2}})
      out.addFixed(
          {fmt::format("the rotors' inertia {}", words), NamedCause{kind, "rotor_inertia", "all"}},
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

void addPlatform(MachineCauses& out) {
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
        one.inertia = moved(moved(one.inertia, one.mass, to_old, 1), x * one.mass, to_load, 1);
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

std::vector<Cause> machineCauses(const Scenario& scenario) {
  MachineCauses out(scenario);
  addPlatform(out);
  for (const TiedParameters& tied : tiedParameters(*scenario.manipulator)) out.addTied(tied);
  addInertias(out);
  addExchanged(out);
  addOtherEnds(scenario.manipulator->legCount(), out);
  addExchangedOf(scenario.manipulator->legCount(), out);
  addHeld(scenario.manipulator->given(), out);
  addKnees(*scenario.manipulator, out);
  addRotors(scenario, out);
  addPointCauses(*scenario.manipulator, out);
  addFrictionCauses(*scenario.manipulator, out);
  return std::move(out.causes);
}

}  // namespace ursula
