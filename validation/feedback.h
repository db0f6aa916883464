#pragma once

#include "model/scenario.h"
#include "validation/amplification.h"
#include "validation/pointwise.h"
#include "validation/result.h"
#include "validation/subject.h"

namespace ursula {

/// A further witness over the whole motion, whatever its amplification: the replay with a weak stabilising term, and
/// the torque that the term had to add. Exact torques need almost none; wrong ones need what they are wrong by.
///
/// The term is −I(φ)(ω_f² δφ + 2 ω_f δφ̇), with ω_f twice the rate at which deviations grow about each instant, so that
/// they decay instead. Integrated is the deviation from the commanded motion (Encke's form: Battin, An Introduction to
/// the Mathematics and Methods of Astrodynamics, 1999, chapter 9), so that its errors are relative to the deviation and
/// not to the motion. `feedback.torque`, N·m.
Check judgeFeedback(const Scenario& scenario, const Subject& subject, const Amplification& amplification,
                    const std::vector<PointwiseSample>& samples, const Units& units = {});

}  // namespace ursula
