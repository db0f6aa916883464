#pragma once

#include <string>
#include <utility>
#include <vector>

#include "model/trajectory.h"

namespace ursula {

/// A trajectory from one kernel written once for any scalar: `Kernel<S>::at(const S& t) const -> Motion<S>`.
template <template <class> class Kernel>
class KernelTrajectory final : public Trajectory {
 public:
  KernelTrajectory(std::string kind, double duration, Kernel<double> kernel, Kernel<Real50> kernel50,
                   std::vector<double> knots = {})
      : kind_(std::move(kind)),
        duration_(duration),
        kernel_(std::move(kernel)),
        kernel50_(std::move(kernel50)),
        knots_(std::move(knots)) {}

  std::string kind() const override { return kind_; }
  double duration() const override { return duration_; }
  Motion<double> at(double t) const override { return kernel_.at(t); }
  Motion<Real50> at(const Real50& t) const override { return kernel50_.at(t); }
  const std::vector<double>& knots() const override { return knots_; }

 private:
  std::string kind_;
  double duration_;
  Kernel<double> kernel_;
  Kernel<Real50> kernel50_;
  std::vector<double> knots_;
};

}  // namespace ursula
