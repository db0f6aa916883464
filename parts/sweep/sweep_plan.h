#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "model/mechanism_scenario.h"
#include "model/scenario.h"
#include "parts/sweep/design.h"
#include "parts/sweep/sweep_database.h"
#include "parts/sweep/sweep_file.h"

namespace ursula {

/// A sweep and the scenario that it varies; creates the scenario of each point. For one thread at a time.
class SweepPlan {
 public:
  /// Reads the scenario and finds the varied numbers, but creates no point. Throws ScenarioError with the place: in the
  /// sweep for a key without a number, in the scenario for its own errors.
  explicit SweepPlan(SweepFile file);
  ~SweepPlan();

  const SweepFile& file() const { return file_; }
  const SweepPoints& points() const { return points_; }
  /// Returns the varied scenario if it has [mechanism]; else null, and base() has it.
  const MechanismScenario* mechanism() const { return mechanism_ ? &*mechanism_ : nullptr; }
  /// Returns the scenario of point i of a mechanism. Throws ScenarioError for invalid numbers.
  MechanismScenario readMechanism(std::int64_t i);
  /// Returns the varied scenario with the sweep's samples; its constant parts are those of every point.
  const Scenario& base() const { return base_; }
  SweepIdentity identity() const;

  /// Returns the varied numbers at point i as a JSON object, in the sweep's order.
  std::string parameters(std::int64_t i) const;
  /// Returns the point as a scenario in TOML with absolute paths, for `ursula validate`.
  std::string text(std::int64_t i);
  /// Returns the point's scenario, parsed from text(i). Throws ScenarioError for invalid numbers.
  Scenario read(std::int64_t i);
  /// Returns the same scenario without its text, but faster.
  Scenario make(std::int64_t i);
  /// Returns whether the motion varies. If not, all scenarios of make() share the same object.
  bool variesMotion() const { return varies_trajectory_; }

 private:
  struct Document;
  void setTo(std::int64_t i);

  SweepFile file_;
  std::optional<MechanismScenario> mechanism_;
  Scenario base_;  ///< of a mechanism only its name, file and text
  std::unique_ptr<Document> document_;
  bool varies_machine_ = false, varies_trajectory_ = false, varies_load_ = false, varies_other_ = false;
  SweepPoints points_;
};

}  // namespace ursula
