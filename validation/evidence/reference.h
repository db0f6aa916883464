#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "model/scenario.h"
#include "validation/limits/amplification.h"
#include "validation/limits/rounding_profile.h"
#include "validation/replay/windows.h"
#include "validation/samples/pointwise.h"
#include "validation/subject/presentation.h"

namespace ursula {

/// What a validation needs of the scenario alone, whoever is on trial: the scenario where its numbers are good, how its
/// roads round, how deviations grow, and what replays of the right torques do.
struct Reference {
  /// Throws as validate() does.
  explicit Reference(const Scenario& given);
  Reference(const Reference&) = delete;
  Reference& operator=(const Reference&) = delete;

  Presentation natural;          ///< of the scenario as given
  Scenario relocated;            ///< SI, positions from natural.origin
  Scenario scenario;             ///< in natural's units: what all experiments see
  std::vector<double> instants;  ///< that are judged and written
  RoundingProfile profile;
  Amplification amplification;
  std::vector<PointwiseSample> conditions;  ///< motion and conditioning at the instants
  double position_scale = 0;
  LoopForces forces;
  ReplayPlan plan;  ///< with the right torques
  /// Replays of the right torques, with what their integration is off by.
  std::vector<WindowedReplay> windows;

  /// observedOrders() of the scenario, when first asked for.
  const std::vector<double>& orders() const;
  /// closerLook at one of `windows`, when first asked for.
  const IntegrationError& closer(std::size_t window) const;

 private:
  mutable std::once_flag observed_;
  mutable std::vector<double> orders_;
  mutable std::mutex measuring_;
  mutable std::map<std::size_t, IntegrationError> closer_;
};

/// Motion and conditioning alone.
std::vector<PointwiseSample> conditionsAt(const Scenario& scenario, const std::vector<double>& instants,
                                          const RoundingProfile& profile);

}  // namespace ursula
