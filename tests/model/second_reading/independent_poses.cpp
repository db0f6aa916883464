#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/real50.h"
#include "tests/model/second_reading/second_reading.h"
#include "validation/checks/quintic_by_control_points.h"
#include "validation/limits/conditioning.h"

namespace ursula {
namespace {

const Real50 eps50 = std::numeric_limits<Real50>::epsilon();

double rounded(const Real50& value) { return static_cast<double>(value); }

template <class A, class B>
double distance(const A& a, const B& b) {
  return rounded((a - b).norm());
}

// --- helix
// ------------------------------------------------------------------------------------------------------------

/// Computes β by control points, and the pose by (49) and the curve's triad: tangent, normal to the centre, and
/// binormal.
struct WrittenHelix {
  const HelixParameters& helix;
  Real50 a{helix.radius}, b{helix.pitch}, duration{helix.duration};

  Real50 beta(const Real50& s) const {
    return atControlPoints(controlPoints({helix.start_angle, helix.start_rate, helix.start_acceleration},
                                         {helix.end_angle, helix.end_rate, helix.end_acceleration}, duration),
                           s);
  }
  Vector3<Real50> position(const Real50& s) const {
    const Real50 angle = beta(s) + helix.phase;
    return {a * cos(angle), a * sin(angle), b * (beta(s) + helix.height_phase)};
  }
  Matrix3<Real50> orientation(const Real50& s) const {
    const Real50 angle = beta(s) + helix.phase, slope = sqrt(a * a + b * b);
    const Real50 x = cos(angle), y = sin(angle), sine = a / slope, cosine = b / slope;
    Matrix3<Real50> Q;                // columns: minus the binormal, normal, tangent
    Q << -cosine * y, -x, -sine * y,  //
        cosine * x, -y, sine * x,     //
        -sine, Real50(0), cosine;
    return Q;
  }
  /// Size of the terms of β and of the larger phase; the coefficients of powers of s are 10, 15 and 6 times the rise.
  double terms() const {
    const double T = helix.duration;
    return 1 + std::abs(helix.start_angle) + std::max(std::abs(helix.phase), std::abs(helix.height_phase)) +
           31 * std::abs(helix.end_angle - helix.start_angle) +
           20 * T * (std::abs(helix.start_rate) + std::abs(helix.end_rate)) +
           5 * T * T * (std::abs(helix.start_acceleration) + std::abs(helix.end_acceleration));
  }
};

void compareHelix(const Trajectory& trajectory, const HelixParameters& helix, Mismatches& mismatches) {
  const WrittenHelix written{helix};
  mismatches.number("trajectory.duration", trajectory.duration(), helix.duration);
  const double limit = rounding_depth * rounded(eps50) * written.terms();
  const double length = std::abs(helix.radius) + std::abs(helix.pitch), T = helix.duration;
  for (const double share : {0.0, 0.28, 0.77, 1.0}) {
    const Real50 s(share), t = s * written.duration;
    const Motion<Real50> motion = trajectory.at(t);
    const std::string at = fmt::format(" at {} of the duration", share);
    mismatches.within("trajectory: p" + at, distance(motion.p, written.position(s)), limit * length);
    mismatches.within("trajectory: Q" + at, distance(motion.Q, written.orientation(s)), limit);
    if (share != 0 && share != 1) continue;
    // At the ends, rates and accelerations are exact, while poses between would only approximate them.
    const double rate = share == 0 ? helix.start_rate : helix.end_rate;
    const double acceleration = share == 0 ? helix.start_acceleration : helix.end_acceleration;
    mismatches.within("trajectory: rate" + at, std::abs(rounded(motion.omega.z() - rate)), 5 * limit / T);
    mismatches.within("trajectory: acceleration" + at, std::abs(rounded(motion.omega_dot.z() - acceleration)),
                      20 * limit / (T * T));
  }
}

// --- poses
// ------------------------------------------------------------------------------------------------------------

/// The rotation of [w, x, y, z], normalised; its columns are the axes rotated by q.
template <class S>
Matrix3<S> rotation(const Eigen::Vector4d& written) {
  using std::sqrt;
  const S norm = sqrt(S(written(0)) * written(0) + S(written(1)) * written(1) + S(written(2)) * written(2) +
                      S(written(3)) * written(3));
  const S w = written(0) / norm, x = written(1) / norm, y = written(2) / norm, z = written(3) / norm;
  Matrix3<S> Q;
  Q << 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),  //
      2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),   //
      2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y);
  return Q;
}

/// Compares in 50 digits. The last instant is the end of a quintic. The coefficients of a polynomial of fifth degree
/// within ±1 on [0, 1] add up to at most 3363 (Chebyshev's), and the quintic may exceed the poses threefold.
void comparePose(const Trajectory& trajectory, const TimedPose& pose, double t, const std::string& place,
                 double position_scale, Mismatches& mismatches) {
  const double limit = rounding_depth * rounded(eps50) * 3 * 3363;
  const Motion<Real50> motion = trajectory.at(Real50(t));
  mismatches.within(place + ".position", distance(motion.p, pose.position.cast<Real50>()), limit * position_scale);
  mismatches.within(place + ".orientation", distance(motion.Q, rotation<Real50>(pose.orientation)), limit);
}

void comparePoses(const Trajectory& trajectory, const std::vector<TimedPose>& poses, Mismatches& mismatches) {
  const std::vector<double>& times = trajectory.knots();
  mismatches.number("trajectory: the number of poses", static_cast<double>(times.size()),
                    static_cast<double>(poses.size()));
  if (poses.empty() || times.size() != poses.size()) return;
  mismatches.number("trajectory.duration", trajectory.duration(), poses.back().time);
  double scale = 0;
  for (const TimedPose& pose : poses) scale = std::max(scale, pose.position.norm());
  constexpr std::size_t in_50_digits = 60;  // of thousands, because 50 digits are expensive
  const std::size_t every = (poses.size() + in_50_digits - 1) / in_50_digits;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::string place = fmt::format("trajectory, pose {}", i + 1);
    mismatches.number(place + ".time", times[i], poses[i].time);
    if (i % every == 0 || i + 1 == poses.size()) {
      comparePose(trajectory, poses[i], times[i], place, scale, mismatches);
    } else {  // at its start a quintic equals its first coefficient
      const Motion<double> motion = trajectory.at(times[i]);
      const double limit = rounding_depth * std::numeric_limits<double>::epsilon();
      mismatches.within(place + ".position", (motion.p - poses[i].position).norm(), 0);
      mismatches.within(place + ".orientation", (motion.Q - rotation<double>(poses[i].orientation)).norm(), limit);
    }
  }
}

void compareHold(const Trajectory& trajectory, const TrajectoryAsWritten& written, Mismatches& mismatches) {
  mismatches.number("trajectory.duration", trajectory.duration(), written.duration);
  const TimedPose& pose = written.poses.front();
  for (const double t : {0.0, written.duration / 2, written.duration})
    comparePose(trajectory, pose, t, "trajectory", pose.position.norm(), mismatches);
}

}  // namespace

void compareTrajectory(const Trajectory& trajectory, const TrajectoryAsWritten& written, Mismatches& mismatches) {
  mismatches.text("trajectory.kind", trajectory.kind(), written.kind);
  if (written.kind == "helix") compareHelix(trajectory, written.helix, mismatches);
  if (written.kind == "waypoints" || written.kind == "samples") comparePoses(trajectory, written.poses, mismatches);
  if (written.kind == "hold") compareHold(trajectory, written, mismatches);
}

}  // namespace ursula
