#include "validation/simulate/collocation.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>

#include "validation/subject/subject.h"

namespace ursula {
namespace {

constexpr int points = 15;
constexpr int most_sweeps = 40;
/// Of the whole time: shorter intervals are of no use.
constexpr double shortest = 1e-7;
/// An interval that was too long, or could be longer, becomes so many times as long at the most.
constexpr double most_longer = 2, most_shorter = 0.2;

using Row = Eigen::Matrix<double, 1, points>;
using Square = Eigen::Matrix<double, points, points>;
using Vectors = Eigen::Matrix<double, 3, points>;
using Quaternions = Eigen::Matrix<double, 4, points>;

/// Legendre's polynomials on [0, 1].
double legendre(int k, double x) { return std::legendre(static_cast<unsigned>(k), 2 * x - 1); }

/// ∫ from 0 to x of the k-th of them.
double integralOfLegendre(int k, double x) {
  return k == 0 ? x : (legendre(k + 1, x) - legendre(k - 1, x)) / (2 * (2 * k + 1));
}

/// Gauss' points on [0, 1].
class GaussPoints {
 public:
  GaussPoints() {
    using Half = boost::math::quadrature::gauss<double, points>;
    const int middle = points / 2;
    for (int k = 0; k <= middle; ++k) {
      const auto at = static_cast<std::size_t>(k);
      node(middle + k) = (1 + Half::abscissa()[at]) / 2;
      node(middle - k) = (1 - Half::abscissa()[at]) / 2;
      weight(middle + k) = weight(middle - k) = Half::weights()[at] / 2;
    }
    for (int j = 0; j < points; ++j)
      for (int k = 0; k < points; ++k) coefficient(k, j) = (2 * k + 1) * weight(j) * legendre(k, node(j));
    for (int i = 0; i < points; ++i) integral.row(i) = integralTo(node(i));
  }

  /// ∫ from 0 to x of what has the values f at the points is this times f.
  Row integralTo(double x) const {
    Row terms;
    for (int k = 0; k < points; ++k) terms(k) = integralOfLegendre(k, x);
    return terms * coefficient;
  }

  Row node, weight;
  Square coefficient;  ///< of Legendre's polynomials, from values at the points
  Square integral;     ///< up to each of the points
};

const GaussPoints& gauss() {
  static const GaussPoints points_of_gauss;
  return points_of_gauss;
}

/// Of the platform.
struct State {
  double t = 0;
  Vector3d p, v, omega;
  Eigen::Vector4d q;  ///< x, y, z, w
};

Motion<double> motionOf(const State& state) {
  Motion<double> out;
  out.t = state.t;
  out.p = state.p;
  out.p_dot = state.v;
  out.omega = state.omega;
  out.Q = Eigen::Quaterniond(Eigen::Vector4d(state.q.normalized())).toRotationMatrix();
  return out;
}

Eigen::Vector4d quaternionRate(const Vector3d& omega, const Eigen::Vector4d& q) {
  return (Eigen::Quaterniond(0, omega.x(), omega.y(), omega.z()) * Eigen::Quaterniond(q)).coeffs() / 2;
}

const char* words(PoseFault fault) {
  switch (fault) {
    case PoseFault::out_of_reach:
      return "a leg cannot reach";
    case PoseFault::end_of_stroke:
      return "a leg is at the end of its stroke";
    case PoseFault::point_on_axis:
      return "a leg's end is on its axis";
    case PoseFault::stretched_leg:
      return "a leg is stretched or folded";
    case PoseFault::singular_jacobian:
      return "the pose is singular";
    case PoseFault::none:
      break;
  }
  return "the efforts change too fast for it";
}

/// One interval from a state.
class Interval {
 public:
  Interval(const BatchDynamics& dynamics, const Load* load, long& evaluations)
      : dynamics_(dynamics), load_(load), evaluations_(evaluations) {}

  /// False where the equations were not solved; fault() may say why.
  bool solve(const State& from, double h, const EffortsAt& efforts) {
    from_ = from;
    h_ = h;
    for (int i = 0; i < points; ++i) torques_[at(i)] = efforts(from.t + h * gauss().node(i));
    // As if at its start for all the time.
    fault_ = PoseFault::none;
    const Vector6d now = ratesOf(from, efforts(from.t));
    if (fault_ != PoseFault::none) return false;
    acceleration_ = now.tail<3>().replicate<1, points>();
    spin_rate_ = now.head<3>().replicate<1, points>();
    turn_ = from.q.replicate<1, points>();
    double before = std::numeric_limits<double>::infinity();
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
      const double change = moveOn();
      // Changes fall by the same factor until they are rounding, which stays.
      if (change <= 4 * std::numeric_limits<double>::epsilon() || (change >= before / 4 && before < settled))
        return true;
      if (!(change < 1e3 * std::max(before, 1.0)) || !accelerate()) return false;
      before = change;
    }
    return false;
  }

  /// What the last two coefficients make of the pose, m or rad.
  double error() const {
    double out = 0;
    for (const Vectors* rates : {&acceleration_, &spin_rate_})
      for (int k : {points - 2, points - 1})
        out = std::max(out, h_ * h_ * (*rates * gauss().coefficient.row(k).transpose()).norm());
    return out;
  }

  /// x of the interval on.
  State state(double x) const {
    const Row to = gauss().integralTo(x);
    State out = from_;
    out.t = from_.t + x * h_;
    out.v += h_ * acceleration_ * to.transpose();
    out.omega += h_ * spin_rate_ * to.transpose();
    out.p += h_ * velocity_ * to.transpose();
    out.q = (from_.q + h_ * turn_rate_ * to.transpose()).normalized();
    return out;
  }

  /// [ω̇; p̈].
  Vector6d ratesOf(const State& state, const Vector6d& torques) {
    const Motion<double> motion = motionOf(state);
    const Vector6d wrench = loadAtP(load_, motion);
    Vector6d out;
    PoseFault fault = PoseFault::none;
    dynamics_.directDynamics(&motion, &torques, 1, &out, &fault, &wrench);
    ++evaluations_;
    if (fault != PoseFault::none) fault_ = fault;
    return out;
  }

  PoseFault fault() const { return fault_; }

 private:
  /// Changes of the pose below which they may be rounding, m or rad.
  static constexpr double settled = 1e-12;

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  /// Twists and poses from the accelerations; the largest change of a pose.
  double moveOn() {
    const auto& A = gauss().integral;
    velocity_.noalias() = h_ * acceleration_ * A.transpose();
    velocity_.colwise() += from_.v;
    spin_.noalias() = h_ * spin_rate_ * A.transpose();
    spin_.colwise() += from_.omega;
    Vectors place = h_ * velocity_ * A.transpose();
    place.colwise() += from_.p;
    for (int i = 0; i < points; ++i) turn_rate_.col(i) = quaternionRate(spin_.col(i), turn_.col(i));
    Quaternions turn = h_ * turn_rate_ * A.transpose();
    turn.colwise() += from_.q;
    const double change = std::max((place - place_).cwiseAbs().maxCoeff<Eigen::PropagateNaN>() / (1 + from_.p.norm()),
                                   (turn - turn_).cwiseAbs().maxCoeff<Eigen::PropagateNaN>());
    place_ = place;
    turn_ = turn;
    return change;
  }

  bool accelerate() {
    for (int i = 0; i < points; ++i) {
      const State here{from_.t + h_ * gauss().node(i), place_.col(i), velocity_.col(i), spin_.col(i), turn_.col(i)};
      motions_[at(i)] = motionOf(here);
      if (load_ != nullptr) loads_[at(i)] = loadAtP(load_, motions_[at(i)]);
    }
    dynamics_.directDynamics(motions_.data(), torques_.data(), points, rates_.data(), faults_.data(),
                             load_ != nullptr ? loads_.data() : nullptr);
    evaluations_ += points;
    for (int i = 0; i < points; ++i) {
      if (faults_[at(i)] != PoseFault::none) {
        fault_ = faults_[at(i)];
        return false;
      }
      spin_rate_.col(i) = rates_[at(i)].head<3>();
      acceleration_.col(i) = rates_[at(i)].tail<3>();
    }
    return true;
  }

  const BatchDynamics& dynamics_;
  const Load* load_;
  long& evaluations_;
  State from_;
  double h_ = 0;
  Vectors acceleration_, spin_rate_, velocity_, spin_, place_ = Vectors::Zero();
  Quaternions turn_, turn_rate_;
  std::array<Vector6d, points> torques_, rates_, loads_;
  std::array<Motion<double>, points> motions_;
  std::array<PoseFault, points> faults_{};
  PoseFault fault_ = PoseFault::none;
};

State stateOf(const Motion<double>& motion, double t) {
  return {t, motion.p, motion.p_dot, motion.omega, Eigen::Quaterniond(motion.Q).coeffs()};
}

}  // namespace

CollocatedMotion collocate(const BatchDynamics& dynamics, const Load* load, const Motion<double>& start,
                           const EffortsAt& efforts, const std::vector<double>& instants, double tolerance) {
  CollocatedMotion out;
  const double whole = instants.back() - instants.front();
  Interval interval(dynamics, load, out.evaluations);
  const auto show = [&](State state, double t) {
    state.t = t;
    Motion<double> motion = motionOf(state);
    const Vector6d rates = interval.ratesOf(state, efforts(t));
    motion.omega_dot = rates.head<3>();
    motion.p_ddot = rates.tail<3>();
    out.motions.push_back(motion);
  };
  State now = stateOf(start, instants.front());
  show(now, now.t);
  double h = whole / 4;
  std::size_t next = 1;
  while (next < instants.size()) {
    const double left = instants.back() - now.t;
    const bool last = h >= left * (1 - 1e-9);
    if (last) h = left;
    if (!(h > shortest * whole)) {
      out.gave_up = fmt::format("intervals shrink to nothing at t = {:.9g} s: {}", now.t, words(interval.fault()));
      return out;
    }
    const bool solved = interval.solve(now, h, efforts);
    const double change =
        solved ? std::clamp(0.8 * std::pow(tolerance / interval.error(), 1.0 / points), most_shorter, most_longer)
               : 0.5;
    if (!solved || !(interval.error() <= tolerance)) {
      h *= std::min(change, 0.8);
      continue;
    }
    ++out.intervals;
    const double end = last ? instants.back() : now.t + h;
    for (; next < instants.size() && instants[next] <= end; ++next)
      show(interval.state((instants[next] - now.t) / h), instants[next]);
    now = interval.state(1);
    now.t = end;
    h *= std::max(1.0, change);
  }
  return out;
}

}  // namespace ursula
