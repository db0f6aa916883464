#pragma once

// The machine's numbers by name, for derivatives. Internal to EffortDerivatives.

#include <string>
#include <vector>

#include "nocsolver/legs/leg_model.h"

namespace ursula {

/// A machine in the scalar S with its axes as they are written, not of length 1.
template <class S>
struct WrittenMachine {
  MachineParameters<S> parameters;
  std::array<Vector3<S>, leg_count> axis;
};

/// Which numbers are visited: all that efforts depend on as they are written, or those that efforts are linear in, at
/// bodies of mass 1 with nothing else.
enum class Numbers { parameters, regressor };

/// Calls f(name, places) for each number in turn; a product of inertia has two places, a smoothing speed several.
template <class S, class F>
class NumbersVisitor {
 public:
  NumbersVisitor(WrittenMachine<S>& machine, Numbers which, const F& f) : machine_(machine), which_(which), f_(f) {}

  void visit() {
    MachineParameters<S>& m = machine_.parameters;
    const bool as_written = which_ == Numbers::parameters;
    if (as_written) vector("gravity", m.gravity);
    f_("platform.mass", {&m.mass});
    vector(as_written ? "platform.center_of_mass" : "platform.first_moment", m.rho);
    tensor(as_written ? "platform.inertia" : "platform.inertia_at_P", m.I_M);
    for (int i = 0; i < m.legs_in_all; ++i) leg(i);
  }

 private:
  void leg(int i) {
    LegModel<S>& leg = machine_.parameters.legs[static_cast<std::size_t>(i)];
    const std::string name = "leg[" + std::to_string(i + 1) + "]";
    const bool as_written = which_ == Numbers::parameters, carriage = leg.kind == LegKind::PUS;
    if (as_written) {
      vector(name + ".base_point", leg.a);
      vector(name + ".platform_point", leg.b);
      vector(name + ".base_axis", machine_.axis[static_cast<std::size_t>(i)]);
    }
    if (carriage)
      f_(name + ".proximal.mass", {&leg.mass_1});
    else
      link(name + ".proximal", leg.kind == LegKind::UPS ? nullptr : &leg.l, leg.mass_1, leg.rho, leg.I_1);
    link(name + ".distal", &leg.s, leg.mass_2, leg.sigma, leg.I_2);
    friction(name, leg);
  }

  void link(const std::string& name, S* length, S& mass, S& center, Matrix3<S>& inertia) {
    const bool as_written = which_ == Numbers::parameters;
    if (as_written && length != nullptr) f_(name + ".length", {length});
    f_(name + ".mass", {&mass});
    f_(name + (as_written ? ".center_of_mass" : ".first_moment"), {&center});
    tensor(name + (as_written ? ".inertia" : ".inertia_at_end"), inertia);
  }

  void friction(const std::string& name, LegModel<S>& leg) {
    const auto& coordinates = rowOf(leg.kind).coordinates;
    std::vector<S*> turning, sliding;
    for (std::size_t j = 0; j < 3; ++j) {
      f_(name + ".friction." + nameOf(coordinates[j]), {&leg.viscous[j]});
      f_(name + ".coulomb." + nameOf(coordinates[j]), {&leg.coulomb[j]});
      (slides(coordinates[j]) ? sliding : turning).push_back(&leg.speed[j]);
    }
    if (which_ == Numbers::regressor) return;
    f_(name + ".coulomb.smoothing_speed", turning);
    if (!sliding.empty()) f_(name + ".coulomb.sliding_speed", sliding);
  }

  void vector(const std::string& name, Vector3<S>& v) {
    static constexpr const char* axes[] = {".x", ".y", ".z"};
    for (int k = 0; k < 3; ++k) f_(name + axes[k], {&v(k)});
  }
  void tensor(const std::string& name, Matrix3<S>& I) {
    f_(name + ".xx", {&I(0, 0)});
    f_(name + ".yy", {&I(1, 1)});
    f_(name + ".zz", {&I(2, 2)});
    f_(name + ".xy", {&I(0, 1), &I(1, 0)});
    f_(name + ".xz", {&I(0, 2), &I(2, 0)});
    f_(name + ".yz", {&I(1, 2), &I(2, 1)});
  }

  WrittenMachine<S>& machine_;
  Numbers which_;
  const F& f_;
};

template <class S, class F>
void eachNumber(WrittenMachine<S>& machine, Numbers which, const F& f) {
  NumbersVisitor<S, F>(machine, which, f).visit();
}

}  // namespace ursula
