#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/limits/amplification.h"
#include "validation/replay/asked_torques.h"
#include "validation/samples/pointwise.h"
#include "validation/subject/subject.h"

namespace ursula {

/// The replay with a weak stabilising term: what the term had to add.
struct StabilisedReplay {
  double torque = 0, t = 0;  ///< the largest that the term added, N·m, and when
  long steps = 0, evaluations = 0;
  std::string stopped;                   ///< why before the end of the motion, else empty
  double stopped_at = 0;                 ///< s
  bool gave_up = false;                  ///< stopped by an error
  bool too_long = false;                 ///< stopped by the number of evaluations
  double rounding = 0;                   ///< twice the torque's largest rounding and the loops' as torque, N·m
  double answer = 0;                     ///< the term's torque for a lasting torque error of one
  double limit = 0;                      ///< torques above this are wrong, N·m
  double tolerance = 0;                  ///< absolute, of a step
  std::optional<Conditioning> noisiest;  ///< where the rounding is largest
  AskedTorques asked;
};

/// A further witness over the whole motion, whatever its amplification: the replay with a weak stabilising term, and
/// the torque that the term had to add. Exact torques need almost none; wrong ones need what they are wrong by.
///
/// The term is −I(φ)(ω_f² δφ + 2 ω_f δφ̇), with ω_f twice the rate at which deviations grow about each instant, so that
/// they decay instead. Integrated is the deviation from the commanded motion (Encke's form: Battin, An Introduction to
/// the Mathematics and Methods of Astrodynamics, 1999, chapter 9), so that its errors are relative to the deviation and
/// not to the motion.
///
/// Of `samples`, Conditions or PointwiseSample, motion and conditioning count. `known`, which may be null, is a replay
/// of the same scenario at the same instants: it stands for the subject's own where that could not differ from it in
/// any bit.
template <class Sample>
StabilisedReplay stabilisedReplay(const Scenario& scenario, const Subject& subject, const Amplification& amplification,
                                  const std::vector<Sample>& samples, const StabilisedReplay* known = nullptr);

}  // namespace ursula
