#pragma once

#include <string>
#include <vector>

#include "model/mechanism.h"

namespace ursula {

// Numbers of a mechanism by name, for `[mechanism.numbers]` and for sweeps: `body.NAME.mass`, `.center_of_mass.0` to 2
// and `.inertia.xx`, yy, zz, xy, xz, yz in the body's own frame, inertias about the mass centre; `joint.NAME.damping`,
// friction, armature, stiffness, springref; `gravity.0` to 2.

/// Returns the names of all numbers; bodies that stand still have none.
std::vector<std::string> mechanismNumbers(const MechanismParameters& machine);
/// Both throw InvalidParameter (place `mechanism.numbers`) for a name that the machine does not have.
double mechanismNumber(const MechanismParameters& machine, const std::string& name);
void setMechanismNumber(const std::string& name, double value, MechanismParameters& machine);

}  // namespace ursula
