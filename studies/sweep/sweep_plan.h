#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "model/scenario.h"
#include "studies/sweep/design.h"
#include "studies/sweep/sweep_database.h"
#include "studies/sweep/sweep_file.h"

namespace ursula {

/// A sweep with the scenario that it varies: makes each of its points a scenario. For one thread at a time.
class SweepPlan {
 public:
  /// Reads the scenario and finds the numbers that vary; no point is made yet. Throws ScenarioError with the place: in
  /// the sweep for a key that leads to no number, in the scenario for what is wrong with that.
  explicit SweepPlan(SweepFile file);
  ~SweepPlan();

  const SweepFile& file() const { return file_; }
  const SweepPoints& points() const { return points_; }
  /// What is varied, with the sweep's samples: of what does not vary, every point's.
  const Scenario& base() const { return base_; }
  SweepIdentity identity() const;

  /// What varies at point i, as a JSON object in the sweep's order.
  std::string parameters(std::int64_t i) const;
  /// The point as a scenario in TOML, with absolute paths: what `ursula validate` takes.
  std::string text(std::int64_t i);
  /// The point's scenario, as read from text(i). Throws ScenarioError for numbers that no scenario can have.
  Scenario read(std::int64_t i);
  /// The same scenario without its text, and sooner.
  Scenario make(std::int64_t i);
  /// What points share: where nothing of it varies it is the same object in every scenario of make().
  bool variesMotion() const { return varies_trajectory_; }

 private:
  struct Document;
  void setTo(std::int64_t i);

  SweepFile file_;
  Scenario base_;
  std::unique_ptr<Document> document_;
  bool varies_machine_ = false, varies_trajectory_ = false, varies_load_ = false, varies_other_ = false;
  SweepPoints points_;
};

}  // namespace ursula
