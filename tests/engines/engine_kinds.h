#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/LU>
#include <Eigen/SVD>

#include "nocsolver/noc/noc.h"
#include "parts/engines/maximal/maximal_loop.h"
#include "parts/engines/mujoco/mujoco_loop.h"
#include "tests/model/random_kinds.h"

namespace ursula {

constexpr LegKind U = LegKind::URS, T = LegKind::UPS, R = LegKind::RUS, P = LegKind::PUS;

inline constexpr double worst_condition =
    1e3;  ///< of the map from efforts to the platform; worse machines are left out
/// One rounding for each of 24 coordinates and 24 pivots, on either side of a comparison, times the condition number.
inline constexpr double room = 96 * worst_condition * Eigen::NumTraits<double>::epsilon();

inline double largest(const Vector6d& efforts) { return efforts.cwiseAbs().maxCoeff<Eigen::PropagateNaN>(); }

inline Vector6d wrenchOf(const Load* load, const Motion<double>& motion) {
  Vector6d out = Vector6d::Zero();
  if (load == nullptr) return out;
  const Matrix3d to_base = load->frame == Load::Frame::platform ? motion.Q : Matrix3d(Matrix3d::Identity());
  const Vector3d force = to_base * load->force;
  out << to_base * load->moment + (motion.Q * load->point).cross(force), force;
  return out;
}

/// The solver's efforts; nullopt if the machine is too near to a singular pose.
inline std::optional<Vector6d> bySolver(const Manipulator& machine, const Load* load, const Motion<double>& motion) {
  const Noc<double> solver(machine);
  NocWorkspace<double> work;
  try {
    const Vector6d efforts = solver.inverseDynamics(motion, work, wrenchOf(load, motion));
    const Vector6d values = Eigen::JacobiSVD<Matrix6<double>>(work.B).singularValues();
    if (values(0) > worst_condition * values(5)) return {};
    return efforts;
  } catch (const PoseError&) {
    return {};
  }
}

/// The same efforts by every formulation of this build.
inline std::vector<Vector6d> byEngines(const Manipulator& machine, const std::shared_ptr<const Load>& load,
                                       const Motion<double>& motion) {
  std::vector<Vector6d> out = {MaximalLoop(machine, load).inverseDynamics(motion)};
  if (mujocoAvailable()) out.push_back(MujocoLoop(machine, load).inverseDynamics(motion));
  return out;
}

/// A state for every formulation, with one motor or more on each leg.
inline KindCase goodCase(const std::vector<LegKind>& kinds, unsigned seed) {
  SeededDraws dice(seed);
  for (;;) {
    const KindCase thrown = thrownCase(dice, kinds);
    if (bySolver(Manipulator(thrown.machine), thrown.load.get(), thrown.motion)) return thrown;
  }
}

}  // namespace ursula
