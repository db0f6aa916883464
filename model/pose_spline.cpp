#include "model/pose_spline.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "base/quintic_spline.h"
#include "base/real50.h"
#include "base/scalar.h"
#include "model/exact_trajectory.h"

namespace ursula {

/// Position and an unnormalised quaternion r = [w, x, y, z] form one curve in R⁷; the orientation is that of q = r /
/// |r|. A spline of r has closed-form derivatives, unlike slerp-like splines on the sphere. With r̄ the
/// conjugate and vec the vector part, dq/dt = ½ ω q gives
///   ω = 2 vec(ṙ r̄) / |r|²                          (a)
///   ω̇ = 2 (vec(r̈ r̄) − (r·ṙ) ω) / |r|²              (b)
/// exactly, since d|r|/dt adds to the scalar part of ṙ r̄ alone and vec(ṙ ṙ̄) = 0.
template <class S>
class PoseSplineKernel {
 public:
  explicit PoseSplineKernel(QuinticHermite<S, 7> curve) : curve_(std::move(curve)) {}

  Motion<S> at(const S& t) const {
    const CurvePoint<S, 7> point = curve_.at(t);
    const auto p = [](const auto& v) { return Vector3<S>(v.template head<3>()); };
    const auto r = [](const auto& v) { return Eigen::Quaternion<S>(v(3), v(4), v(5), v(6)); };
    const Eigen::Quaternion<S> q = r(point.value), q_dot = r(point.rate), q_ddot = r(point.acceleration);
    const S norm2 = q.squaredNorm();
    Motion<S> motion;
    motion.t = t;
    motion.p = p(point.value);
    motion.p_dot = p(point.rate);
    motion.p_ddot = p(point.acceleration);
    motion.Q = q.normalized().toRotationMatrix();
    motion.omega = 2 * (q_dot * q.conjugate()).vec() / norm2;                                       // (a)
    motion.omega_dot = 2 * ((q_ddot * q.conjugate()).vec() - q.dot(q_dot) * motion.omega) / norm2;  // (b)
    return motion;
  }

 private:
  QuinticHermite<S, 7> curve_;
};

namespace {

using PoseKnot = CurvePoint<Real50, 7>;

/// The spline runs through R⁴, so each knot uses q or −q, whichever is nearer to the previous one.
std::vector<PoseKnot> knotsOf(const std::vector<TimedPose>& poses) {
  std::vector<PoseKnot> knots(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    Eigen::Matrix<Real50, 4, 1> r = poses[i].orientation.cast<Real50>().normalized();
    if (i > 0 && r.dot(knots[i - 1].value.tail<4>()) < 0) r = -r;
    knots[i].t = poses[i].time;
    knots[i].value << poses[i].position.cast<Real50>(), r;
  }
  return knots;
}

void validate(const std::vector<TimedPose>& poses, const PoseSplineOptions& options, const RefusePose& refuse) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const TimedPose& pose = poses[i];
    const std::string time = fmt::format("{}", pose.time);
    if (!std::isfinite(pose.time)) refuse(i, "time", time, "a finite number");
    if (i == 0 && pose.time != 0) refuse(i, "time", time, "0, since every motion starts then");
    if (i > 0 && !(pose.time > poses[i - 1].time))
      refuse(i, "time", time, fmt::format("> {}, the time before", poses[i - 1].time));
    if (!pose.position.allFinite()) refuse(i, "position", "a non-finite entry", "finite numbers");
    requireUnit(pose.orientation, options.unit_within,
                [&](const std::string& value, const std::string& bound) { refuse(i, "orientation", value, bound); });
  }
}

void requireClearWay(const std::vector<PoseKnot>& knots, const RefusePose& refuse) {
  const double degrees = degrees_per_radian, most = 170;
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const auto cosine = knots[i].value.tail<4>().dot(knots[i - 1].value.tail<4>()).convert_to<double>();
    const double angle = 2 * std::acos(std::min(cosine, 1.0)) * degrees;
    if (!(angle <= most))
      refuse(i, "orientation", fmt::format("turned by {:.4g} degrees from the one before", angle),
             fmt::format("<= {} degrees, so that the way round is clear", most));
  }
}

/// The six Bézier points of a piece enclose it in their convex hull. So |r| stays away from 0 if each reaches at least
/// 1/4 along the mean of the two end quaternions.
void requireAwayFromZero(const std::vector<PoseKnot>& knots, const RefusePose& refuse) {
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const PoseKnot &from = knots[i - 1], &to = knots[i];
    const Real50 h = to.t - from.t;
    const PoseKnot::Vector first = from.value + h / 5 * from.rate, last = to.value - h / 5 * to.rate;
    const PoseKnot::Vector second = from.value + 2 * h / 5 * from.rate + h * h / 20 * from.acceleration;
    const PoseKnot::Vector last_but_one = to.value - 2 * h / 5 * to.rate + h * h / 20 * to.acceleration;
    const Eigen::Matrix<Real50, 4, 1> mean = (from.value + to.value).tail<4>().normalized();
    for (const PoseKnot::Vector& point : {from.value, first, second, last_but_one, last, to.value})
      if (!(mean.dot(point.tail<4>()) >= 0.25))
        refuse(i, "orientation", "a spline that swings too far on its way from the one before",
               "orientations nearer to each other or more evenly spread in time");
  }
}

/// Rounds the 50-digit solution once, so both kernels give the same curve to the last bit of a double.
std::unique_ptr<Trajectory> splineAlong(const std::string& kind, const QuinticHermite<Real50, 7>& curve,
                                        std::vector<double> times) {
  const auto relocate = [kind, curve, times](const Vector3d& origin) {
    PoseKnot::Vector offset = PoseKnot::Vector::Zero();
    offset.head<3>() = origin.cast<Real50>();
    return splineAlong(kind, curve.shifted(offset), times);
  };
  const double duration = times.back();
  return std::make_unique<KernelTrajectory<PoseSplineKernel>>(
      kind, duration, PoseSplineKernel<double>(QuinticHermite<double, 7>(curve)), PoseSplineKernel<Real50>(curve),
      relocate, std::move(times));
}

}  // namespace

void requireUnit(const Eigen::Vector4d& orientation, double within,
                 const std::function<void(const std::string& value, const std::string& bound)>& refuse) {
  const double norm = orientation.norm();
  if (!(std::abs(norm - 1) <= within))
    refuse(fmt::format("a quaternion of norm {}", norm), fmt::format("1 within {}", within));
}

std::unique_ptr<Trajectory> makePoseSpline(const std::vector<TimedPose>& poses, const PoseSplineOptions& options,
                                           const RefusePose& refuse) {
  if (poses.size() < options.at_least)
    refuse(0, "", fmt::format("{} pose{}", poses.size(), poses.size() == 1 ? "" : "s"),
           fmt::format(">= {}", options.at_least));
  validate(poses, options, refuse);
  std::vector<PoseKnot> knots = knotsOf(poses);
  requireClearWay(knots, refuse);
  if (options.ends == SplineEnds::free) {
    differentiateBySix(knots, 0, knots.front());
    differentiateBySix(knots, knots.size() - 6, knots.back());
  }
  solveQuinticSpline(knots);
  requireAwayFromZero(knots, refuse);
  std::vector<double> times;
  times.reserve(poses.size());
  for (const TimedPose& pose : poses) times.push_back(pose.time);
  return splineAlong(options.kind, QuinticHermite<Real50, 7>(knots), std::move(times));
}

}  // namespace ursula
