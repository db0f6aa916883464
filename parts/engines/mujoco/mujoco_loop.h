#pragma once

#include <memory>
#include <string>

#include "model/open_tree.h"
#include "parts/engines/voting_engines.h"

namespace ursula {

/// A further formulation with another engine: the open legs and the free platform are trees in MuJoCo. Its recursive
/// Newton–Euler algorithm and Jacobians give the forces; multipliers at the Bᵢ close the loops. It uses raw parameters
/// and its own geometry, and knows neither the solver nor another formulation.
class MujocoLoop : public Engine {
 public:
  /// Throws std::runtime_error if the build lacks MuJoCo.
  explicit MujocoLoop(const Manipulator& manipulator, std::shared_ptr<const Load> load = nullptr);
  ~MujocoLoop() override;

  Vector6d inverseDynamics(const Motion<double>& motion) override;

  struct Impl;  ///< in mujoco_loop_internal.h, for those who call MuJoCo otherwise
  Impl& impl() { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

/// Version of the loaded library, "2.2.2"; "none" without it.
std::string mujocoVersion();

}  // namespace ursula
