#pragma once

#include <optional>

#include "validation/evidence/external_torques.h"
#include "validation/external/asked_apart.h"
#include "validation/external/explanation.h"

namespace ursula {

/// Of one instant and motor, N·m or N: what is off, and by how much right efforts may be.
inline double offAt(const ExternalTorques& torques, std::size_t row, int motor) {
  return torques.file.torques[row](motor) - torques.noc[row](motor);
}
inline double roundingAt(const ExternalTorques& torques, std::size_t row) {
  return torques.samples[row].conditioning.torqueRounding();
}
inline double limitAt(const ExternalTorques& torques, std::size_t row, int motor) {
  return roundingAt(torques, row) + torques.precision[row](motor);
}

/// Efforts that are right but for digits that they lack: numbers of single precision; of a solver that was asked also
/// answers that are rounded, and answers to nearly the same question that jump by about what they are off. None where
/// they are off by more.
std::optional<Explanation> fewDigits(const MotorNames& motors, const ExternalTorques& torques, const AskedApart& asked);

/// A solver's answers have every digit: nothing is allowed for those that are not printed.
ExternalTorques inEveryDigit(ExternalTorques torques);

}  // namespace ursula
