#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "validation/mistakes/cause.h"
#include "validation/subject/body_terms.h"

// The causes that hypotheses.cpp tries on efforts that are wrong, a source for each group.

namespace ursula {

/// Errors in every continuous parameter of the machine, for all legs, both links or one leg. Others are gravity's size,
/// the other knee branch, inertias about the wrong point, mass centres from the wrong end, and exchanged values. Likely
/// causes come first.
std::vector<Cause> machineCauses(const Scenario& scenario);

/// Other interpretations of the motion: inverse rotation, the platform's frame, another point, a missing part. Also
/// platform quantities used without rotation, and inertias of the motors.
std::vector<Cause> motionCauses(const Scenario& scenario);

/// Rates read otherwise: rates of angles for the angular velocity, degrees, millimetres.
std::vector<Cause> rateCauses(const Scenario& scenario);

/// Telescopic legs without an end of stroke: another machine or a misread pose may be beyond it, and a solver need not
/// care.
Manipulator withoutStroke(const Manipulator& machine);

/// The NOC's efforts for a motion that a solver read otherwise; telescopic legs then have no end of stroke.
Cause readOtherwise(const Scenario& scenario, const CauseName& name,
                    const std::function<void(Motion<double>&)>& change);

/// The efforts that a mistake adds for one motion.
using EffortChange = std::function<Vector6d(const MachineTerms&)>;

/// Collects causes that add something to the NOC's efforts. The scenario must outlive them.
class EffortCauses {
 public:
  explicit EffortCauses(const Scenario& scenario) : scenario_(scenario) {}

  void add(const std::string& text, const NamedCause& named, const EffortChange& change) {
    add(text, named, change, scenario_.manipulator);
  }
  /// Adds the mistake also for a solver that makes it first, and then adds its motors' own friction and rotors.
  void addAlsoWithoutMotors(const std::string& text, const NamedCause& named, const EffortChange& change);

  std::vector<Cause> causes;

 private:
  void add(const std::string& text, const NamedCause& named, const EffortChange& change,
           const std::shared_ptr<const Manipulator>& changed);

  const Scenario& scenario_;
};

/// Mistakes in a solver's own formulas, for every kind of leg. A term of a group of bodies is missing or has the wrong
/// sign; tensors use other frames or points; the links' spin is missing. `scenario` must outlive them.
std::vector<Cause> termCauses(const Scenario& scenario);

/// Mistakes in a leg's own coordinates: friction without signs, rotors without the Jacobian's rate, a wrong or
/// damped inverse of its Jacobian, rates of distal links relative to the proximal ones. `scenario` must outlive them.
std::vector<Cause> jointCauses(const Scenario& scenario);

/// A wrong Jacobian, or moments about the wrong point. `scenario` must outlive them.
std::vector<Cause> jacobianCauses(const Scenario& scenario);

/// Open loops or loops closed by least squares, missing J̇. `scenario` must outlive them.
std::vector<Cause> loopCauses(const Scenario& scenario);

/// Rates that a solver takes as differences between the instants of its torques, s. Empty if these are too few.
/// `scenario` must outlive them.
std::vector<Cause> differenceCauses(const Scenario& scenario, const std::vector<double>& instants);

/// Mistakes with sliding legs, UPS and PUS: a mass centre is measured from the joint at the leg's other end, or a force
/// is along the wrong line. `scenario` must outlive them.
std::vector<Cause> slidingCauses(const Scenario& scenario);

}  // namespace ursula
