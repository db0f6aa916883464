#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "validation/causes/cause.h"
#include "validation/causes/hypotheses.h"
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

/// The NOC's efforts for a motion that a solver read otherwise; telescopic legs then have no end of stroke.
Cause readOtherwise(const Scenario& scenario, const CauseName& name,
                    const std::function<void(Motion<double>&)>& change);

/// Tries every order of the legs with the best signs, in the unit that the torques' size suggests. Returns nullopt if
/// neither order nor signs differ.
std::optional<Hypothesis> signsAndOrder(const TorqueResidual& data);

/// Finds torques of another time, τ(t + dt), with dt in ms and in samples. Uses the samples whose shifted time is
/// within the motion; returns nullopt if they are too few.
std::optional<Hypothesis> timeShift(const Scenario& scenario, const TorqueResidual& data);

/// Tries efforts of an engine whose soft constraints close the loops, as mj_inverse has them: open loops, with forces
/// in proportion to J̇ u. One number per leg is fitted. Returns nullopt if a leg's number is not positive or has no
/// effect.
std::optional<Hypothesis> softLoops(const Scenario& scenario, const TorqueResidual& data);

/// Tries every vector of the machine with all its entries wrong: gravity, mass centres, points, axes. It fits two or
/// three numbers each, and drops those that leave more than a thousandth.
std::vector<Hypothesis> fitVectors(const Scenario& scenario, const TorqueResidual& data);

/// The efforts that a mistake adds for one motion.
using EffortChange = std::function<Vector6d(const MachineTerms&)>;

/// Collects causes that add something to the NOC's efforts. The scenario must outlive them.
class EffortCauses {
 public:
  explicit EffortCauses(const Scenario& scenario) : scenario_(scenario) {}

  void add(const std::string& text, const NamedCause& named, const EffortChange& change);

  std::vector<Cause> causes;

 private:
  const Scenario& scenario_;
};

/// Mistakes in a solver's own formulas, for every kind of leg. A term of a group of bodies is missing or has the wrong
/// sign; tensors use other frames or points; the links' spin is missing. `scenario` must outlive them.
std::vector<Cause> termCauses(const Scenario& scenario);

/// A wrong Jacobian, open loops or loops closed by least squares, missing J̇. `scenario` must outlive them.
std::vector<Cause> loopCauses(const Scenario& scenario);

/// Mistakes with sliding legs, UPS and PUS: a mass centre is measured from the joint at the leg's other end, or a force
/// is along the wrong line. `scenario` must outlive them.
std::vector<Cause> slidingCauses(const Scenario& scenario);

}  // namespace ursula
