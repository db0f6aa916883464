#pragma once

#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/judge_replay.h"
#include "validation/pointwise.h"
#include "validation/presentation.h"
#include "validation/result.h"

namespace ursula {

/// From a presentation's units and origin to SI and B: checks by their unit, columns by their name's.
void restore(const Presentation& from, ValidationResult& result);

/// What all roads share: the commanded motion, the load, the file as it was read.
void prependMotionChecks(const Scenario& scenario, ValidationResult& result);

/// What a subject and its validation have beside torques.
struct SubjectHas {
  bool any_instant = true;  ///< torques at any instant, not those of a file alone
  bool kinematics = true, direct_dynamics = true, other_machines = true;
  bool left_out_ladder = false, left_out_reactions = false;  ///< by the caller's options
};

/// Puts the checks into the order of checkNames() and adds those that do not apply, each with its reason.
void listEveryCheck(const Scenario& scenario, const SubjectHas& has, ValidationResult& result);

/// Judges by the scenario's own limits where it has any, each held against the largest value of its check, and sets the
/// verdict. Of what could not be judged a limit of the user's lifts only what had no useful limit; naming a check that
/// was not made is a failure.
void judgeByUser(const std::vector<AcceptanceLimit>& acceptance, ValidationResult& result);

/// Scenario, subject, build and settings.
void addProvenance(const Scenario& scenario, const std::string& subject, ValidationResult& result);

/// The machine along the time series, for the report.
void addPicture(const Scenario& scenario, ValidationResult& result);

/// Largest torque and acceleration with their errors, condition numbers, and what the replay took.
void addFindings(const std::vector<PointwiseSample>& samples, const std::vector<WindowedReplay>& windows,
                 ValidationResult& result, const Units& units = {});

}  // namespace ursula
