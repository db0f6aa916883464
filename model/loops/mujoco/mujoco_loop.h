#pragma once

#include <memory>
#include <string>

#include "model/load.h"
#include "model/manipulator.h"
#include "model/motion.h"

namespace ursula {

/// A further road, of another engine: the six open legs and the free platform as trees in MuJoCo, whose recursive
/// Newton–Euler algorithm and Jacobians give the forces; the loops are closed by multipliers at the six Bᵢ. Made of raw
/// parameters and geometry of its own; it knows neither the solver nor another road.
class MujocoLoop {
 public:
  /// Throws std::runtime_error in a build without MuJoCo.
  explicit MujocoLoop(const Manipulator& manipulator, std::shared_ptr<const Load> load = nullptr);
  ~MujocoLoop();
  MujocoLoop(const MujocoLoop&) = delete;
  MujocoLoop& operator=(const MujocoLoop&) = delete;

  /// Actuator torques for the motion, N·m, conjugate to φ̇. Throws std::domain_error where a leg cannot reach.
  Vector6d inverseDynamics(const Motion<double>& motion);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// MuJoCo is optional: false where this was built without it.
bool mujocoAvailable();

/// Of the library that is loaded, "2.2.2"; "none" without it.
std::string mujocoVersion();

/// Null where this was built without MuJoCo.
std::unique_ptr<MujocoLoop> makeMujocoLoop(const Manipulator& manipulator, std::shared_ptr<const Load> load = nullptr);

}  // namespace ursula
