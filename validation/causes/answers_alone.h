#pragma once

#include <optional>
#include <vector>

#include "validation/causes/asked_apart.h"
#include "validation/causes/explanation.h"
#include "validation/evidence/external_evidence.h"

namespace ursula {

/// These give one instant and motor's deviation, its rounding, and the limit of right efforts, N·m or N.
inline double offAt(const ExternalTorques& torques, std::size_t row, int motor) {
  return torques.file.torques[row](motor) - torques.noc[row](motor);
}
inline double roundingAt(const ExternalTorques& torques, std::size_t row) {
  return torques.samples[row].conditioning.torqueRounding();
}
inline double limitAt(const ExternalTorques& torques, std::size_t row, int motor) {
  return roundingAt(torques, row) + torques.precision[row](motor);
}

/// The motors that are wrong at some instant, 0-based.
std::vector<int> wrongMotors(const ExternalTorques& torques);

/// Explains efforts that lack only digits. These are single-precision numbers. From a solver they are also rounded
/// answers, and answers to nearly the same question that jump by about the deviation. Returns none for larger
/// deviations.
std::optional<Explanation> fewDigits(const MotorNames& motors, const ExternalTorques& torques, const AskedApart& asked);

/// Explains motors that answer the same at every instant, and whatever they are asked, where the right efforts vary.
/// The others must be right. Returns none otherwise.
std::optional<Explanation> sameAnswers(const MotorNames& motors, const ExternalTorques& torques,
                                       const AskedApart& asked);

/// Explains efforts that never leave a range of a motor's own, and are right wherever the right ones are within it.
/// Returns none otherwise.
std::optional<Explanation> cutOff(const MotorNames& motors, const ExternalTorques& torques, const AskedApart& asked);

/// Returns the largest change of an answer that is asked again alone, relative to the largest effort; 0 if it may be
/// rounding.
double changedWhenAskedAgain(const ExternalTorques& torques, const AskedApart& asked);

}  // namespace ursula
