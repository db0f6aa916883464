#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/external/asked_apart.h"
#include "validation/external/external_samples.h"
#include "validation/verdict/result.h"

namespace ursula {

/// What a person would say of torques that are wrong.
struct Diagnosis {
  std::string summary;                   ///< which legs, when, by how much, in a line
  std::string deviation;                 ///< the same for each leg
  std::string cause;                     ///< a guess that the residual supports, or that there is none
  std::optional<NamedCause> named = {};  ///< the cause; none where there is no one that explains all
  std::vector<NamedCause> others = {};   ///< that explain the deviation as well; all of them where `named` is none
  std::vector<TermError> terms = {};     ///< of a solver that was asked apart
};

/// Only for torques that are beyond their limits somewhere: of exact ones there is nothing to say, and all are empty.
/// A cause has to explain what a solver answered apart as well.
Diagnosis diagnose(const Scenario& scenario, const ExternalTorques& torques, const AskedApart& asked = {});

/// Into the result: its likely cause, findings, and what its failed checks say. Nothing where there is nothing to say.
void addDiagnosis(const Diagnosis& diagnosis, ValidationResult& result);

}  // namespace ursula
