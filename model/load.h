#pragma once

#include <memory>
#include <type_traits>
#include <vector>

#include "base/scalar.h"

namespace ursula {

/// What acts on the platform from outside at one instant, in the frame of its Load.
template <class S>
struct Wrench {
  Vector3<S> force = Vector3<S>::Zero();   ///< N
  Vector3<S> moment = Vector3<S>::Zero();  ///< N·m: a couple, on top of what the force's arm gives
};

/// A row of a tabulated load.
struct TimedWrench {
  double time = 0;  ///< s
  Wrench<double> wrench;
};

/// A wrench over time through the rows of a table: quintic between them with zero second derivative at each and slopes
/// limited so that no component ever leaves the range of its two neighbours; with zero slope at both ends and constant
/// beyond. Twice continuously differentiable over all time, so that an integrator keeps its order across the rows.
class LoadHistory {
 public:
  /// At least two rows, finite, times increasing. Throws InvalidParameter (places `load.table[n].…`, 1-based).
  explicit LoadHistory(const std::vector<TimedWrench>& rows);
  /// The same history under a linear map of [force; moment], its time divided by `time_unit`. Not that of mapped rows:
  /// slopes are limited by component, so that the axes matter.
  LoadHistory(const LoadHistory& from, const Matrix6d& map, double time_unit);
  ~LoadHistory();
  LoadHistory(const LoadHistory&) = delete;
  LoadHistory& operator=(const LoadHistory&) = delete;

  Wrench<double> at(double t) const;
  /// In 50 digits: S is Real50, for nothing else links.
  template <class S, class = std::enable_if_t<!std::is_arithmetic_v<S>>>
  Wrench<S> at(const S& t) const;
  const std::vector<TimedWrench>& rows() const;
  /// The rows' times, at which the third derivative jumps, s.
  const std::vector<double>& knots() const;

 private:
  struct Curves;
  std::unique_ptr<const Curves> curves_;
};

/// `[load]`: an external force and moment on the platform.
struct Load {
  enum class Frame { base, platform };

  Vector3d force = Vector3d::Zero();           ///< N, in `frame`, where there is no history
  Vector3d moment = Vector3d::Zero();          ///< N·m, in `frame`, where there is no history
  Vector3d point = Vector3d::Zero();           ///< where the force acts, m, in M; zero is P
  Frame frame = Frame::base;                   ///< in which force and moment are expressed
  std::shared_ptr<const LoadHistory> history;  ///< null: constant

  /// Force and moment at t, in `frame`. Does not allocate.
  Wrench<double> at(double t) const;
  /// In 50 digits: S is Real50, for nothing else links.
  template <class S, class = std::enable_if_t<!std::is_arithmetic_v<S>>>
  Wrench<S> at(const S& t) const;
};

}  // namespace ursula
