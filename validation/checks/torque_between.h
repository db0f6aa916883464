#pragma once

#include <vector>

#include "model/scenario.h"
#include "validation/samples/pointwise.h"
#include "validation/subject/frame_change.h"
#include "validation/subject/subject.h"
#include "validation/verdict/result.h"

namespace ursula {

/// `torque.between` compares the subject's torques with another formulation at thousands of instants between the other
/// checks'. The NOC is compared with the fast kernels, another solver with the NOC. Instants are multiples of the
/// golden ratio, which match no period, and more where the torques curve. The result gives the width of the narrowest
/// pulse that is surely found.
Check judgeBetween(const Scenario& scenario, const Subject& subject, const std::vector<PointwiseSample>& samples,
                   const RoundingProfile& profile, const Units& units = {});

/// Compares every answer that a subject ever gave with the NOC's. It replaces judgeBetween's check, whose instants it
/// includes. A solver may also be wrong beyond the first thousands.
Check judgeAnswers(const Scenario& scenario, std::vector<Answered> answers, const std::vector<PointwiseSample>& samples,
                   const RoundingProfile& profile, const Units& units);

}  // namespace ursula
