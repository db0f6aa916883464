#include "studies/sweep/motion_extremes.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "model/instants.h"
#include "nocsolver/solver.h"
#include "validation/subject/scaled_jacobian.h"
#include "validation/subject/subject.h"

namespace ursula {

void MotionExtremes::fill(const Scenario& scenario) {
  motions_.clear();
  for (const double t : equallySpaced(scenario.trajectory->duration(), scenario.simulation.samples))
    motions_.push_back(scenario.trajectory->at(t));
  efforts_.resize(motions_.size());
  faults_.resize(motions_.size());
}

void MotionExtremes::efforts(const Scenario& scenario, Extremes& out) {
  loads_.clear();
  if (scenario.load)
    for (const Motion<double>& motion : motions_) loads_.push_back(loadAtP(scenario.load.get(), motion));
  BatchDynamics(*scenario.manipulator)
      .inverseDynamics(motions_.data(), motions_.size(), efforts_.data(), faults_.data(),
                       loads_.empty() ? nullptr : loads_.data());
  for (std::size_t k = 0; k < motions_.size(); ++k)
    for (int m = 0; m < motor_count; ++m) {
      const double size = std::abs(efforts_[k](m));
      LargestEffort& largest = out.efforts[static_cast<std::size_t>(m)];
      if (faults_[k] == PoseFault::none && (size > largest.value || k == 0)) largest = {size, motions_[k].t};
    }
}

/// Throws for the first instant at which the legs or the batch have no answer.
void MotionExtremes::margins(const Scenario& scenario, Extremes& out) const {
  const Solver<double> solver(*scenario.manipulator);
  Workspace<double> work;
  double worst = 0;
  Matrix6d at_worst = Matrix6d::Identity();
  for (std::size_t k = 0; k < motions_.size(); ++k) {
    solver.displacements(motions_[k], work);
    for (int i = 0; i < scenario.manipulator->legCount(); ++i)
      out.sine = std::min(out.sine, solver.margins(work, i).sine);
    if (faults_[k] != PoseFault::none) solver.inverseKinematics(motions_[k], work);
    solver.jacobians(motions_[k], work);
    const Matrix6d B = scaledB(work.B, solver.length());
    const double bound = B.norm() * B.inverse().norm();
    if (bound > worst || k == 0) {
      worst = bound;
      at_worst = B;
    }
    if (faults_[k] != PoseFault::none) solver.inverseDynamics(motions_[k], work);
  }
  out.kappa = conditionNumber(at_worst);
}

Extremes MotionExtremes::of(const Scenario& scenario, bool varies) {
  if (varies || motions_.empty()) fill(scenario);
  Extremes out;
  efforts(scenario, out);
  margins(scenario, out);
  return out;
}

}  // namespace ursula
