#pragma once

#include <array>
#include <string>
#include <vector>

#include "exchange/import.h"
#include "model/leg_kind.h"

namespace ursula::exchange {

/// A link as in model/manipulator.h, with properties that only foreign files have.
struct ImportedLink {
  double length = 0;                           ///< m; 0 for a carriage
  double mass = 0;                             ///< kg
  Vector3d center_of_mass = Vector3d::Zero();  ///< in the link's frame, from its first end, m
  Matrix3d inertia = Matrix3d::Zero();         ///< about the mass centre, in the link's frame, kg·m²
  std::string bodies;                          ///< names in the file
};

struct ImportedLeg {
  LegKind kind = LegKind::UPS;
  std::array<bool, 3> actuated = {};
  Vector3d base_point = Vector3d::Zero(), base_axis = Vector3d::UnitX(), platform_point = Vector3d::Zero();
  ImportedLink proximal, distal;
  bool knee_positive = true;
  bool free_spin = false;
  double smoothing_speed = 0;  ///< of Coulomb friction, rad/s or m/s; 0 for the scenario's default
  std::array<double, 3> damping = {}, friction = {}, rotor_inertia = {};  ///< in the order of the kind's coordinates
  std::vector<std::string> motors;  ///< names of the driven joints in the file, in that order
  std::string joints;               ///< names in the file
  bool stroke_from_file = false;    ///< whether the lengths of UPS come from the file's limits
};

struct ImportedPose {
  double time = 0;
  Vector3d position = Vector3d::Zero();
  Matrix3d orientation = Matrix3d::Identity();
};

/// A machine that the program can validate, in B and M, with the assumptions made.
struct ImportedMachine {
  std::string name, base, platform;
  Vector3d gravity = Vector3d::Zero();
  double platform_mass = 0;
  Vector3d platform_center = Vector3d::Zero();
  Matrix3d platform_inertia = Matrix3d::Zero();
  std::vector<ImportedLeg> legs;
  ImportedPose initial;              ///< of M in B
  std::vector<ImportedPose> motion;  ///< proposed motion as waypoints; motion.h explains the search
  double motion_radius = 0;          ///< m
  std::vector<Assumption> assumptions;
};

/// Finds base, platform and legs in a model and reports the assumptions. Throws ImportError with the names of bodies
/// and joints that no supported machine has.
ImportedMachine recognise(ModelGraph graph, const ImportChoices& choices);

/// The share of a leg's range, up to 1, that is left at a pose of M in B. It is not positive if the leg cannot take the
/// pose.
double reserveOf(const ImportedLeg& leg, const ImportedPose& pose);

/// Proposes a small helix of the platform's origin from the initial pose, with constant orientation. It is as large as
/// the legs allow, at most a twentieth of `size`. Throws ImportError if they cannot take the initial pose.
void proposeMotion(ImportedMachine& machine, double size);

}  // namespace ursula::exchange
