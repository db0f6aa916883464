#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "model/scenario.h"
#include "parts/identify/measured_log.h"

namespace ursula {

/// Properties of a log that Simbody makes of a machine.
struct SyntheticLog {
  double rate = 500, duration = 8;  ///< Hz, s
  double period = 4;                ///< period of the motion, s
  double effort_noise = 0.003;      ///< share of the efforts' root mean square
  double motion_noise = 2e-6;       ///< rad or m
  double delay = 0;                 ///< delay of efforts behind the motion, s
  double size = 1;                  ///< factor on the motion
  unsigned seed = 1;
  std::function<double(int row)> off = {};  ///< how far rows are from a grid of the rate, steps; none is
};

struct SyntheticRows {
  std::vector<double> t;
  Eigen::MatrixXd motion, efforts;  ///< driven coordinates and their efforts, with noise
  Eigen::VectorXd effort_noise;     ///< standard deviation of each motor's noise, N·m or N
};

/// Returns a periodic motion about the middle of the scenario's, with three harmonics for each coordinate of the pose.
Motion<double> syntheticMotion(const Scenario& scenario, const SyntheticLog& how, double t);

/// Returns coordinates and efforts of Simbody's six-ball loop of `machine` on that motion, with noise.
SyntheticRows syntheticRows(const Scenario& scenario, const ManipulatorParameters& machine, const SyntheticLog& how);

/// Returns `count` instants of the scenario's own motion and the closed form's efforts, with noise of deviation
/// `effort_noise`, N·m or N, on these.
SyntheticRows closedFormRows(const Scenario& scenario, int count, double effort_noise, unsigned seed);

MeasuredLog logOf(const SyntheticRows& rows, const Scenario& scenario);

/// Returns the log as a user's CSV file.
std::string csvOf(const SyntheticRows& rows, const Scenario& scenario);

}  // namespace ursula
