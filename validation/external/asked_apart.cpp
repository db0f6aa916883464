#include "validation/external/asked_apart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <functional>

#include "validation/verdict/worst_share.h"

namespace ursula {
namespace {

constexpr std::size_t most_poses = 5;
constexpr const char* names[] = {
    "statics", "acceleration", "angular_acceleration", "velocity", "angular_velocity", "mixed", "odd", repeat_term};
constexpr std::size_t parts_count = std::size(names), repeat = parts_count - 1;
/// A part of less than this share of all efforts is nothing.
constexpr double nothing = 1e-9;

using Parts = std::array<Vector6d, parts_count>;
using Efforts = std::function<Vector6d(const Motion<double>&)>;

/// The parts of the efforts at the pose of `at`. The motion's own velocities are not used: they may be zero.
Parts partsOf(const Efforts& efforts, const Motion<double>& at, const Vector3d& v, const Vector3d& w) {
  const auto asked = [&](const Vector3d& p_dot, const Vector3d& omega, const Vector3d& p_ddot,
                         const Vector3d& omega_dot) {
    Motion<double> motion = at;
    motion.p_dot = p_dot;
    motion.omega = omega;
    motion.p_ddot = p_ddot;
    motion.omega_dot = omega_dot;
    return efforts(motion);
  };
  const Vector3d o = Vector3d::Zero();
  const auto even = [&](const Vector3d& p_dot, const Vector3d& omega) {
    return ((asked(p_dot, omega, o, o) + asked(-p_dot, -omega, o, o)) / 2).eval();
  };
  Parts out;
  out[0] = asked(o, o, o, o);
  out[1] = asked(o, o, v, o) - out[0];  // the same numbers serve as accelerations
  out[2] = asked(o, o, o, w) - out[0];
  out[3] = even(v, o) - out[0];
  out[4] = even(o, w) - out[0];
  out[5] = even(v, w) - out[0] - out[3] - out[4];
  out[6] = (asked(v, w, o, o) - asked(-v, -w, o, o)) / 2;
  out[repeat] = asked(o, o, o, o) - out[0];
  return out;
}

/// Points in another direction at each pose. Its size lets the efforts show beside gravity's.
Vector3d someVector(double size, std::size_t k) {
  const auto x = static_cast<double>(k);
  return size * Vector3d(std::cos(1 + 2 * x), std::sin(2 + 3 * x), std::cos(3 - x));
}

}  // namespace

std::vector<TermError> askedApart(const Subject& subject, const Scenario& scenario,
                                  const std::vector<Motion<double>>& motions) {
  if (motions.empty()) return {};
  const Subject noc = nocSubject(*scenario.manipulator, scenario.load);
  const double length = scenario.manipulator->leg(0).platform_point.norm();
  const double rate = std::sqrt(std::max(scenario.manipulator->gravity().norm(), 1e-3) / std::max(length, 1e-3));
  std::array<double, parts_count> error{}, size{};
  double all = 0;
  const std::size_t count = std::min(most_poses, motions.size());
  try {
    for (std::size_t k = 0; k < count; ++k) {
      const Motion<double>& at = motions[k * (motions.size() - 1) / std::max<std::size_t>(1, count - 1)];
      const Vector3d v = someVector(rate * length, k), w = someVector(rate, k + 7);
      const Parts found = partsOf(subject.torques, at, v, w), expected = partsOf(noc.torques, at, v, w);
      for (std::size_t part = 0; part < parts_count; ++part) {
        error[part] = larger(error[part], (found[part] - expected[part]).norm());
        size[part] = std::max(size[part], expected[part].norm());
        if (part != repeat) all = std::max(all, expected[part].norm());
      }
    }
  } catch (const std::exception&) {  // no answer to what the motion itself does not ask
    return {};
  }
  std::vector<TermError> out;
  for (std::size_t part = 0; part < parts_count; ++part)
    out.push_back({names[part], error[part] / (size[part] > nothing * all ? size[part] : all)});
  return out;
}

}  // namespace ursula
