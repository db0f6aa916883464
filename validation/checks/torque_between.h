#pragma once

#include <vector>

#include "model/scenario.h"
#include "validation/samples/pointwise.h"
#include "validation/subject/frame_change.h"
#include "validation/subject/subject.h"
#include "validation/verdict/result.h"

namespace ursula {

/// `torque.between`: the subject's torques at thousands of instants between those of the other checks, against
/// another formulation: the NOC against the fast kernels, somebody else's solver against the NOC. Instants at multiples
/// of the golden ratio, which meet no period of anything, and more where the subject's torques curve. The result says
/// how narrow a pulse may be to be missed.
Check judgeBetween(const Scenario& scenario, const Subject& subject, const std::vector<PointwiseSample>& samples,
                   const RoundingProfile& profile, const Units& units = {});

/// Every answer that a subject gave, whatever it was asked for, against the NOC's: in the place of judgeBetween's
/// check, whose instants are among them. Beyond the first thousands a solver may be wrong, too.
Check judgeAnswers(const Scenario& scenario, std::vector<Answered> answers, const std::vector<PointwiseSample>& samples,
                   const RoundingProfile& profile, const Units& units);

}  // namespace ursula
