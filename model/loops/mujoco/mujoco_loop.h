#pragma once

#include <memory>
#include <string>

#include "model/loops/road.h"

namespace ursula {

/// A further road, of another engine: the open legs and the free platform as trees in MuJoCo, whose recursive
/// Newton–Euler algorithm and Jacobians give the forces; the loops are closed by multipliers at the Bᵢ. Made of raw
/// parameters and geometry of its own; it knows neither the solver nor another road.
class MujocoLoop : public Road {
 public:
  /// Throws std::runtime_error in a build without MuJoCo.
  explicit MujocoLoop(const Manipulator& manipulator, std::shared_ptr<const Load> load = nullptr);
  ~MujocoLoop() override;

  Vector6d inverseDynamics(const Motion<double>& motion) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// MuJoCo is optional: false where this was built without it.
bool mujocoAvailable();

/// Of the library that is loaded, "2.2.2"; "none" without it.
std::string mujocoVersion();

}  // namespace ursula
