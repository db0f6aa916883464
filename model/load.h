#pragma once

#include <memory>
#include <type_traits>
#include <vector>

#include "base/scalar.h"

namespace ursula {

/// The external load on the platform at one instant, in the frame of its Load.
template <class S>
struct Wrench {
  Vector3<S> force = Vector3<S>::Zero();   ///< N
  Vector3<S> moment = Vector3<S>::Zero();  ///< N·m: a couple, added to the moment of the force about its arm
};

/// A row of a tabulated load.
struct TimedWrench {
  double time = 0;  ///< s
  Wrench<double> wrench;
};

/// A wrench over time that interpolates the rows of a table by quintics with zero second derivative at each row. Slopes
/// are limited, so no component leaves the range of its two neighbours. The ends have zero slope; beyond them the
/// wrench is constant. It is twice continuously differentiable, so an integrator keeps its order across rows.
class LoadHistory {
 public:
  /// Takes at least two finite rows with increasing times. Throws InvalidParameter (places `load.table[n].…`, 1-based).
  explicit LoadHistory(const std::vector<TimedWrench>& rows);
  /// The same history under a linear map of [force; moment], with time divided by `time_unit`. Mapped rows would give
  /// another curve, because slopes are limited per component.
  LoadHistory(const LoadHistory& from, const Matrix6d& map, double time_unit);
  ~LoadHistory();
  LoadHistory(const LoadHistory&) = delete;
  LoadHistory& operator=(const LoadHistory&) = delete;

  Wrench<double> at(double t) const;
  /// Returns the wrench in 50 digits; S must be Real50, else it does not link.
  template <class S, class = std::enable_if_t<!std::is_arithmetic_v<S>>>
  Wrench<S> at(const S& t) const;
  const std::vector<TimedWrench>& rows() const;
  /// Returns the rows' times in s; the third derivative jumps there.
  const std::vector<double>& knots() const;

 private:
  struct Curves;
  std::unique_ptr<const Curves> curves_;
};

/// `[load]`: an external force and moment on the platform.
struct Load {
  enum class Frame { base, platform };

  Vector3d force = Vector3d::Zero();           ///< N, in `frame`; unused with a history
  Vector3d moment = Vector3d::Zero();          ///< N·m, in `frame`; unused with a history
  Vector3d point = Vector3d::Zero();           ///< point of action of the force, m, in M; zero is P
  Frame frame = Frame::base;                   ///< frame of force and moment
  std::shared_ptr<const LoadHistory> history;  ///< null if the load is constant

  /// Returns force and moment at t, in `frame`. Does not allocate.
  Wrench<double> at(double t) const;
  /// Returns the same in 50 digits; S must be Real50, else it does not link.
  template <class S, class = std::enable_if_t<!std::is_arithmetic_v<S>>>
  Wrench<S> at(const S& t) const;
};

}  // namespace ursula
