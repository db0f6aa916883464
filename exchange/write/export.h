#pragma once

#include <string>
#include <vector>

#include "exchange/write/machine_model.h"

namespace ursula::exchange {

enum class ModelFormat { sdf, mjcf, urdf };

/// A model file, and notes on the parts of the scenario that it lacks.
struct WrittenModel {
  std::string text;
  std::vector<Assumption> notes;
};

/// Writes the scenario's machine at the first instant of its motion. Throws UnreachablePose.
WrittenModel exportScenario(const Scenario& scenario, ModelFormat format);

// The individual formats; each adds to `notes` what it cannot hold.

std::string sdfText(const MachineModel& machine, std::vector<Assumption>& notes);
std::string mjcfText(const MachineModel& machine, std::vector<Assumption>& notes);
std::string urdfText(const MachineModel& machine, std::vector<Assumption>& notes);

}  // namespace ursula::exchange
