#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "model/load.h"
#include "model/manipulator.h"
#include "model/trajectory.h"

namespace ursula {

/// `file:line:column: error: what, what was expected, did you mean …`
class ScenarioError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class Integrator { rkf78, rk_merson };

/// `[simulation]`: every key has a default; the results record all values.
struct SimulationSettings {
  int samples = 301;                          ///< instants compared and written, >= 2
  Integrator integrator = Integrator::rkf78;  ///< "rkf78" (Boost.Odeint) or "rk_merson" (Simbody)
  double tolerance = 1e-14;                   ///< of the integrator, absolute and relative, in [1e-15, 1e-3]
};

/// `[acceptance]`: the user's limits by check name; other limits are derived.
struct AcceptanceLimit {
  std::string check;
  double limit = 0;
};

/// The user's tolerance of efforts: `relative` to the largest effort of the motion, plus `absolute` (N·m or N).
struct EffortTolerance {
  double relative = 0, absolute = 0;
  bool any = false;  ///< allows a tolerance so large that zero torques would pass
};

/// A machine, its commanded motion, and how both are judged; read from a file or made by a program.
struct Scenario {
  std::string name;
  std::filesystem::path file;
  std::string text;  ///< the file as read; its hash is part of the provenance
  std::shared_ptr<const Manipulator> manipulator;
  std::shared_ptr<const Trajectory> trajectory;
  std::shared_ptr<const Load> load;  ///< null if there is none
  SimulationSettings simulation;
  std::vector<AcceptanceLimit> acceptance;
  std::optional<EffortTolerance> tolerance;  ///< `[acceptance] torque`

  /// Marks machine, trajectory and load as those that `text` describes.
  void markAsRead() { read_ = {manipulator.get(), trajectory.get(), load.get()}; }
  /// Returns whether `text` describes it: false if a program made the scenario or changed it after reading.
  bool isAsRead() const {
    return read_[0] != nullptr && read_ == std::array<const void*, 3>{manipulator.get(), trajectory.get(), load.get()};
  }

 private:
  std::array<const void*, 3> read_{};
};

/// Reads and checks a whole scenario. Throws ScenarioError; unknown content is an error.
Scenario readScenario(const std::filesystem::path& file);

/// Reads the same from a text; `file` names it in errors and anchors relative paths.
Scenario parseScenario(const std::string& text, const std::filesystem::path& file);

}  // namespace ursula
