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

/// `[simulation]`: every key has a default, recorded in the results.
struct SimulationSettings {
  int samples = 301;                          ///< instants judged and written, >= 2
  Integrator integrator = Integrator::rkf78;  ///< "rkf78" (Boost.Odeint) or "rk_merson" (Simbody)
  double tolerance = 1e-14;                   ///< of the integrator, absolute and relative, in [1e-15, 1e-3]
};

/// `[acceptance]`: limits of the user's own, by check name; those not named are derived.
struct AcceptanceLimit {
  std::string check;
  double limit = 0;
};

/// What efforts may be off by, when their user says so: `relative` to the largest effort of the motion, and `absolute`
/// (N·m or N); both are added.
struct EffortTolerance {
  double relative = 0, absolute = 0;
  bool any = false;  ///< even one at which torques of zero would pass
};

/// A machine, what it is asked to do, and how that is judged; read from a file, or made by a program.
struct Scenario {
  std::string name;
  std::filesystem::path file;
  std::string text;  ///< the file as read: its hash is part of the provenance
  std::shared_ptr<const Manipulator> manipulator;
  std::shared_ptr<const Trajectory> trajectory;
  std::shared_ptr<const Load> load;  ///< null where none
  SimulationSettings simulation;
  std::vector<AcceptanceLimit> acceptance;
  std::optional<EffortTolerance> tolerance;  ///< `[acceptance] torque`

  /// Says that machine, trajectory and load are those that `text` gives.
  void markAsRead() { read_ = {manipulator.get(), trajectory.get(), load.get()}; }
  /// False for a scenario that a program made, or changed after it was read: then its text says nothing of it.
  bool isAsRead() const {
    return read_[0] != nullptr && read_ == std::array<const void*, 3>{manipulator.get(), trajectory.get(), load.get()};
  }

 private:
  std::array<const void*, 3> read_{};
};

/// Reads and checks a whole scenario. Throws ScenarioError; nothing is accepted that is not understood.
Scenario readScenario(const std::filesystem::path& file);

/// The same from text; `file` names it in errors and anchors relative paths.
Scenario parseScenario(const std::string& text, const std::filesystem::path& file);

}  // namespace ursula
