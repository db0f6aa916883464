#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/real50.h"
#include "model/trajectory.h"

namespace ursula {

/// Sizes of intermediate sums that a pose does not show, such as a helix's angles and their heights; roundings are
/// counted from them.
struct HiddenTerms {
  double angle = 6.2831853071795864769;  ///< rad; one turn by default
  double length = 0;                     ///< m
};

/// A trajectory that gives its motion in 50 digits as well. Internal, so that users' trajectories need no Boost.
class ExactTrajectory : public Trajectory {
 public:
  Motion<double> at(double t) const override = 0;
  virtual Motion<Real50> at(const Real50& t) const = 0;
  virtual HiddenTerms hiddenTerms() const { return {}; }
  const ExactTrajectory* exact() const override { return this; }
};

/// A trajectory from one kernel for any scalar: `Kernel<S>::at(const S& t) const -> Motion<S>`. The kernel has a name
/// of its own, not in an unnamed namespace: this class, which has one, would differ in each source, and GCC warns.
template <template <class> class Kernel>
class KernelTrajectory final : public ExactTrajectory {
 public:
  /// Creates the same motion with positions relative to another origin.
  using Relocate = std::function<std::unique_ptr<Trajectory>(const Vector3d& origin)>;

  KernelTrajectory(std::string kind, double duration, Kernel<double> kernel, Kernel<Real50> kernel50, Relocate relocate,
                   std::vector<double> knots = {}, HiddenTerms hidden = {})
      : kind_(std::move(kind)),
        duration_(duration),
        kernel_(std::move(kernel)),
        kernel50_(std::move(kernel50)),
        relocate_(std::move(relocate)),
        knots_(std::move(knots)),
        hidden_(hidden) {}

  std::string kind() const override { return kind_; }
  double duration() const override { return duration_; }
  Motion<double> at(double t) const override { return kernel_.at(t); }
  Motion<Real50> at(const Real50& t) const override { return kernel50_.at(t); }
  std::unique_ptr<Trajectory> relativeTo(const Vector3d& origin) const override { return relocate_(origin); }
  const std::vector<double>& knots() const override { return knots_; }
  HiddenTerms hiddenTerms() const override { return hidden_; }

 private:
  std::string kind_;
  double duration_;
  Kernel<double> kernel_;
  Kernel<Real50> kernel50_;
  Relocate relocate_;
  std::vector<double> knots_;
  HiddenTerms hidden_;
};

}  // namespace ursula
