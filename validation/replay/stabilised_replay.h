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

/// The replay with a weak stabilising term, and the torque that the term added.
struct StabilisedReplay {
  double torque = 0, t = 0;  ///< the largest torque that the term added, N·m, and its time
  long steps = 0, evaluations = 0;
  std::string stopped;                   ///< why it stopped before the end of the motion, else empty
  double stopped_at = 0;                 ///< s
  bool gave_up = false;                  ///< stopped by an error
  bool too_long = false;                 ///< stopped by the limit of evaluations
  double rounding = 0;                   ///< twice the largest rounding of the torque and of the loops as torque, N·m
  double answer = 0;                     ///< the term's torque for a constant torque error of one
  double limit = 0;                      ///< larger torques are wrong, N·m
  double tolerance = 0;                  ///< absolute, per step
  std::optional<Conditioning> noisiest;  ///< at the largest rounding
  AskedTorques asked;
};

/// A further check over the whole motion, independent of its amplification: the replay with a weak stabilising term.
/// Exact torques need almost no stabilising torque; wrong ones need a torque as large as their error.
///
/// The term is −I(φ)(ω_f² δφ + 2 ω_f δφ̇). ω_f is twice the local growth rate of deviations, so they decay. It
/// integrates the deviation from the commanded motion (Encke's form: Battin, An Introduction to the Mathematics and
/// Methods of Astrodynamics, 1999, chapter 9). So its errors are relative to the deviation and not to the motion.
///
/// From `samples`, Conditions or PointwiseSample, it uses motion and conditioning. `known`, which may be null, is a
/// replay of the same scenario at the same instants. It replaces the subject's own if both must be bitwise equal.
template <class Sample>
StabilisedReplay stabilisedReplay(const Scenario& scenario, const Subject& subject, const Amplification& amplification,
                                  const std::vector<Sample>& samples, const StabilisedReplay* known = nullptr,
                                  const Deadline& deadline = {});

}  // namespace ursula
