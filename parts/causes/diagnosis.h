#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/scenario.h"
#include "parts/causes/asked_apart.h"
#include "validation/evidence/external_evidence.h"
#include "validation/verdict/result.h"

namespace ursula {

/// What an expert would say about wrong torques.
struct Diagnosis {
  std::string summary;    ///< which legs, when, by how much, in one line
  std::string deviation;  ///< the same for each leg
  std::string cause;      ///< a guess that the residual supports, or a statement that there is none
  CauseClaim claim = CauseClaim::none;
  std::optional<NamedCause> named = {};  ///< the cause; nullopt unless exactly one explains everything
  std::vector<NamedCause> others =
      {};  ///< causes that explain the deviation equally well; all of them if `named` is empty
  std::vector<NamedCause> together = {};  ///< two or three that explain it together; `named` is the first
  std::vector<TermError> terms = {};      ///< of a solver that answered separate questions
};

/// Only for torques that exceed their limits somewhere; for exact ones everything is empty. A cause must also explain
/// the solver's answers to separate questions.
Diagnosis diagnose(const Scenario& scenario, const ExternalTorques& torques, const AskedApart& asked = {});

/// Adds the likely cause, findings and texts of failed checks to the result, if there are any.
void addDiagnosis(const Diagnosis& diagnosis, ValidationResult& result);

}  // namespace ursula
