#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/scenario.h"
#include "studies/identify/measured_log.h"

namespace ursula {

/// How a log is made of a machine in Simbody.
struct SyntheticLog {
  double rate = 500, duration = 8;  ///< Hz, s
  double period = 4;                ///< s, of the motion
  double effort_noise = 0.003;      ///< of the efforts' root mean square
  double motion_noise = 2e-6;       ///< rad or m
  double delay = 0;                 ///< s, of efforts behind the motion
  double size = 1;                  ///< of the motion
  unsigned seed = 1;
};

struct SyntheticRows {
  std::vector<double> t;
  Eigen::MatrixXd motion, efforts;  ///< driven coordinates and what drives them, with noise
  Eigen::VectorXd effort_noise;     ///< deviation of each motor's, N·m or N
};

/// A periodic motion about the middle of the scenario's, of three harmonics for each coordinate of the pose.
Motion<double> syntheticMotion(const Scenario& scenario, const SyntheticLog& how, double t);

/// Coordinates and efforts that Simbody's six-ball loop has of `machine` on that motion, with noise.
SyntheticRows syntheticRows(const Scenario& scenario, const ManipulatorParameters& machine, const SyntheticLog& how);

MeasuredLog logOf(const SyntheticRows& rows, const Scenario& scenario);

/// A CSV as a user has one.
std::string csvOf(const SyntheticRows& rows, const Scenario& scenario);

}  // namespace ursula
