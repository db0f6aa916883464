#pragma once

#include <array>
#include <string>
#include <vector>

#include "model/manipulator.h"
#include "model/motion.h"
#include "parts/exchange/import.h"

namespace ursula::exchange {

/// A leg of the scenario, and what its text says of the file.
struct ImportedLeg : Leg {
  double smoothing_speed = 0;         ///< of Coulomb friction, rad/s or m/s; 0 for the scenario's default
  std::vector<std::string> motors;    ///< names of the driven joints in the file, in the order of the coordinates
  std::string joints;                 ///< names in the file
  std::array<std::string, 2> bodies;  ///< names of the proximal and the distal link in the file
  bool stroke_from_file = false;      ///< whether the lengths of UPS come from the file's limits
};

/// A machine that the program can validate, in B and M, with the assumptions made.
struct ImportedMachine {
  std::string name, base, platform;
  Vector3d gravity = Vector3d::Zero();
  Platform of_platform;
  std::vector<ImportedLeg> legs;
  Motion<double> initial;              ///< pose of M in B
  std::vector<Motion<double>> motion;  ///< the poses of the proposed motion's waypoints
  double motion_radius = 0;            ///< m
  Assumptions assumptions;
};

/// Finds base, platform and legs in a model and reports the assumptions. Throws ImportError with the names of bodies
/// and joints that no supported machine has.
ImportedMachine recognise(ModelGraph graph, const ImportChoices& choices);

/// Proposes a small helix of the platform's origin from the initial pose, with constant orientation. It is as large as
/// the legs allow, at most a twentieth of `size`. Throws ImportError if they cannot take the initial pose.
void proposeMotion(ImportedMachine& machine, double size);

/// Returns the machine as a scenario in TOML, with comments on the origin of the numbers. Each number is the shortest
/// that parses to the same double. `file` is the model's name in the comments.
std::string scenarioText(const ImportedMachine& machine, const std::string& file);

}  // namespace ursula::exchange
