#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/outside/window_means.h"

namespace ursula {

using EffortsAt = std::function<Eigen::VectorXd(double t)>;

/// Efforts at instants. They stay when rows of the motion are left out if they are known at any instant.
struct EffortRows {
  std::vector<double> t;
  EffortList efforts;
  bool at_any_instant = false;
};

/// Some of the rows: the first, each `step`-th from `from` on, and the last.
struct SomeRows {
  std::size_t step = 1, from = 0;

  bool all() const { return step == 1; }
  template <class T>
  std::vector<T> of(const std::vector<T>& rows) const {
    std::vector<T> out;
    if (from > 0) out.push_back(rows.front());
    for (std::size_t k = from; k + 1 < rows.size(); k += step) out.push_back(rows[k]);
    out.push_back(rows.back());
    return out;
  }
};

/// The efforts that a motion through some of its rows needs. Throws LoopError, InvalidParameter for too few.
using NeededBy = std::function<EffortsAt(const SomeRows& some)>;

/// A motion in place of efforts, and what it is judged by.
struct MotionAsked {
  const std::vector<double>& instants;  ///< of its rows
  const EffortRows& given;
  const NeededBy& needed;
  EffortsAt right;                           ///< those of the scenario's motion
  EffortsAt sampled;                         ///< those of a spline through that motion at the rows' instants and digits
  Eigen::VectorXd in;                        ///< turns each motor's effort into one unit
  std::optional<EffortTolerance> tolerance;  ///< the user's
};

/// The efforts that are judged in place of a motion: means over windows.
struct MotionWindows {
  std::vector<double> t;
  EffortList efforts, precision;
  double window = 0;          ///< length of one, s
  std::size_t undecided = 0;  ///< windows with a motor of which the rows leave too much open
  double distance = 0;        ///< of the motion's rows, s
  double enough = 0;          ///< the distance that would decide half of the windows, s
  std::string wanted;         ///< what the rows should leave open at most, in words

  bool isDecided() const { return 2 * undecided <= t.size(); }
};

/// Compares given efforts with those needed, as means over windows. What the rows leave open is found by leaving out
/// more of them. An undecided window has only the part of a difference that the rows do not explain. Throws CsvError
/// for too few rows, and LoopError.
MotionWindows inWindows(const MotionAsked& asked);

}  // namespace ursula
