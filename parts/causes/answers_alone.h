#pragma once

#include <optional>
#include <vector>

#include "parts/causes/asked_apart.h"
#include "parts/causes/explanation.h"
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
  return torques.samples[row].torqueLimits()(motor);
}

/// The motors that are wrong at some instant, 0-based.
std::vector<int> wrongMotors(const ExternalTorques& torques);

/// What the answers say by themselves, before any cause is fitted to their deviation.
struct AnswersAlone {
  bool has_few_digits = false;
  std::optional<Explanation> explanation;  ///< the same answer everywhere, few digits or a cut-off range
  /// Largest change of an answer that is asked again alone, relative to the largest effort; 0 if it may be rounding.
  double change = 0;
};
AnswersAlone readAlone(const MotorNames& motors, const ExternalTorques& torques, const AskedApart& asked);

}  // namespace ursula
