#include "model/motor_trajectory.h"

#include <fmt/format.h>

#include <cmath>

#include "base/errors.h"
#include "base/quintic_spline.h"
#include "base/scalar.h"

namespace ursula {
namespace {

void requireDuration(double duration) {
  if (!std::isfinite(duration) || !(duration > 0))
    throw InvalidParameter("trajectory.duration", fmt::format("{}", duration), "> 0");
}

class Fourier : public MotorTrajectory {
 public:
  Fourier(double duration, double period, std::vector<FourierSeries> motors)
      : duration_(duration), period_(period), motors_(std::move(motors)) {}

  std::string kind() const override { return "fourier"; }
  double duration() const override { return duration_; }

  MotorMotion at(double t) const override {
    const auto n = static_cast<Eigen::Index>(motors_.size());
    MotorMotion out{t, Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
    for (Eigen::Index k = 0; k < n; ++k) {
      const FourierSeries& series = motors_[k];
      out.q(k) = series.offset;
      const auto add = [&](std::size_t j, double a, double b) {  // a sin + b cos
        const double rate = 2 * pi * static_cast<double>(j + 1) / period_;
        const double s = std::sin(rate * t), c = std::cos(rate * t);
        out.q(k) += a * s + b * c;
        out.qdot(k) += rate * (a * c - b * s);
        out.qddot(k) -= rate * rate * (a * s + b * c);
      };
      for (std::size_t j = 0; j < series.sin.size(); ++j) add(j, series.sin[j], 0);
      for (std::size_t j = 0; j < series.cos.size(); ++j) add(j, 0, series.cos[j]);
    }
    return out;
  }

 private:
  double duration_, period_;
  std::vector<FourierSeries> motors_;
};

class Hold : public MotorTrajectory {
 public:
  Hold(double duration, Eigen::VectorXd q) : duration_(duration), q_(std::move(q)) {}

  std::string kind() const override { return "hold"; }
  double duration() const override { return duration_; }
  MotorMotion at(double t) const override {
    return {t, q_, Eigen::VectorXd::Zero(q_.size()), Eigen::VectorXd::Zero(q_.size())};
  }

 private:
  double duration_;
  Eigen::VectorXd q_;
};

using Knot = CurvePoint<double, 1>;

class Samples : public MotorTrajectory {
 public:
  Samples(std::vector<double> times, std::vector<QuinticHermite<double, 1>> curves)
      : times_(std::move(times)), curves_(std::move(curves)) {}

  std::string kind() const override { return "samples"; }
  double duration() const override { return times_.back(); }
  const std::vector<double>& knots() const override { return times_; }

  MotorMotion at(double t) const override {
    const auto n = static_cast<Eigen::Index>(curves_.size());
    MotorMotion out{t, Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
    for (Eigen::Index k = 0; k < n; ++k) {
      const Knot point = curves_[k].at(t);
      out.q(k) = point.value(0);
      out.qdot(k) = point.rate(0);
      out.qddot(k) = point.acceleration(0);
    }
    return out;
  }

 private:
  std::vector<double> times_;
  std::vector<QuinticHermite<double, 1>> curves_;
};

/// Sets rates and accelerations from the rows, by a quintic spline whose ends are the quintics through six rows.
void differentiate(std::vector<Knot>& knots) {
  differentiateBySix(knots, 0, knots.front());
  differentiateBySix(knots, knots.size() - 6, knots.back());
  solveQuinticSpline(knots);
}

}  // namespace

std::unique_ptr<MotorTrajectory> makeFourier(double duration, double period, std::vector<FourierSeries> motors) {
  requireDuration(duration);
  if (!std::isfinite(period) || !(period > 0))
    throw InvalidParameter("trajectory.period", fmt::format("{}", period), "> 0");
  return std::make_unique<Fourier>(duration, period, std::move(motors));
}

std::unique_ptr<MotorTrajectory> makeMotorHold(double duration, const Eigen::VectorXd& q) {
  requireDuration(duration);
  return std::make_unique<Hold>(duration, q);
}

std::unique_ptr<MotorTrajectory> makeMotorSamples(const std::vector<double>& times, const Eigen::MatrixXd& positions,
                                                  const Eigen::MatrixXd& rates, const Eigen::MatrixXd& accelerations) {
  const bool given = rates.size() > 0 && accelerations.size() > 0;
  const std::size_t least = given ? 2 : 6;
  if (times.size() < least)
    throw InvalidParameter("trajectory.samples", fmt::format("{} rows", times.size()), fmt::format(">= {}", least));
  if (times.front() != 0)
    throw InvalidParameter("trajectory.samples[1].time", fmt::format("{}", times.front()),
                           "0, since every motion starts then");
  for (std::size_t i = 1; i < times.size(); ++i)
    if (!(times[i] > times[i - 1]))
      throw InvalidParameter(fmt::format("trajectory.samples[{}].time", i + 1), fmt::format("{}", times[i]),
                             fmt::format("> {}, the time before", times[i - 1]));
  std::vector<QuinticHermite<double, 1>> curves;
  for (Eigen::Index k = 0; k < positions.cols(); ++k) {
    std::vector<Knot> knots(times.size());
    for (std::size_t i = 0; i < times.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      knots[i].t = times[i];
      knots[i].value(0) = positions(row, k);
      if (given) knots[i].rate(0) = rates(row, k);
      if (given) knots[i].acceleration(0) = accelerations(row, k);
    }
    if (!given) differentiate(knots);
    curves.emplace_back(knots);
  }
  return std::make_unique<Samples>(times, std::move(curves));
}

}  // namespace ursula
