#pragma once

#include <functional>
#include <memory>

#include "model/scenario.h"
#include "validation/limits/further_engines.h"
#include "validation/subject/subject.h"

namespace ursula {

/// Falsifies an engine wherever it is asked, so also where its rounding is measured. Empty members change nothing.
struct EngineFault {
  std::function<void(ManipulatorParameters&)> machine;  ///< which it is built from, in the frame in which it is asked
  std::function<void(Vector6d&)> efforts;               ///< its answers, by its own numbers of the motors

  /// Return what the faulty engine has in place of the right thing.
  Manipulator applied(const Manipulator& right) const;
  Scenario applied(Scenario right) const;
  Vector6d applied(Vector6d right) const;
  explicit operator bool() const { return machine || efforts; }
};

/// Falsifies formulations for negative controls.
struct FormulationFaults {
  EngineFault simbody;  ///< the loop with a ball per leg, at the samples
  OfFurtherEngines<EngineFault> further;
  std::function<Subject(const Subject&)> solver;  ///< the NOC, where its rounding is measured

  explicit operator bool() const;
};

/// makeFurtherEngines() with faults.
OfFurtherEngines<std::unique_ptr<Engine>> makeFurtherEngines(const Manipulator& manipulator,
                                                             const std::shared_ptr<const Load>& load,
                                                             const OfFurtherEngines<EngineFault>& faults);

}  // namespace ursula
