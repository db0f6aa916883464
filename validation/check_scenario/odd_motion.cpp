#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "model/instants.h"
#include "model/scenario_place.h"
#include "nocsolver/errors.h"
#include "nocsolver/solver.h"
#include "validation/check_scenario/oddity.h"

namespace ursula {
namespace {

constexpr double pi = 3.14159265358979323846;

double turned(const Matrix3d& Q) { return Eigen::AngleAxisd(Q).angle(); }

double degrees(double angle) { return angle * 180 / pi; }

/// What [w, x, y, z] would be had it been meant as [x, y, z, w].
Matrix3d asScalarLast(const Matrix3d& Q) {
  const Eigen::Quaterniond q(Q);
  return Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y()).toRotationMatrix();
}

/// The scalar last is a habit of many libraries; machines of this kind hardly turn by more than a right angle.
void scalarLast(const Scenario& scenario, const std::string& key, std::vector<Oddity>& out) {
  if (!placeInFile(scenario, key).given) return;
  const Matrix3d Q = scenario.trajectory->at(0).Q;
  const double read = turned(Q), swapped = turned(asScalarLast(Q));
  if (!(read > pi / 2 && swapped < pi / 2)) return;
  out.push_back({key, fmt::format("turns the platform by {:.4g} degrees at the start; read as [x, y, z, w] it would be "
                                  "{:.4g}: expected is [w, x, y, z]",
                                  degrees(read), degrees(swapped))});
}

void radians(const Scenario& scenario, std::vector<Oddity>& out) {
  for (const char* name : {"start_angle", "end_angle", "phase"}) {
    const std::string key = std::string("trajectory.") + name;
    const double value = placeInFile(scenario, key).number.value_or(0);
    if (std::abs(value) > 2 * pi)
      out.push_back({key, fmt::format("{:.6g} rad are {:.3g} turns: were degrees meant? Then it is {}_deg = {:.6g}",
                                      value, std::abs(value) / (2 * pi), name, value)});
  }
}

/// The largest acceleration against the machine's gravity, or Earth's.
void haste(const Scenario& scenario, std::vector<Oddity>& out) {
  constexpr double g = 9.81, hasty = 20;
  double most = 0, at = 0;
  for (double t : equallySpaced(scenario.trajectory->duration(), 201)) {
    const double size = scenario.trajectory->at(t).p_ddot.norm();
    if (!(size > most)) continue;
    most = size;
    at = t;
  }
  const std::string key = placeInFile(scenario, "trajectory.duration").given ? "trajectory.duration" : "trajectory";
  if (most > hasty * g)
    out.push_back(
        {key, fmt::format("{:.6g} s make the platform accelerate by {:.4g} m/s2 at t = {:.4g} s, {:.3g} times "
                          "9.81 m/s2",
                          scenario.trajectory->duration(), most, at, most / g)});
  if (scenario.trajectory->duration() >= 1000)
    out.push_back(
        {key, fmt::format("{:.6g} s: milliseconds, where seconds are expected?", scenario.trajectory->duration())});
}

/// |sin θ| of a leg where it is smallest over the motion.
struct Straightest {
  double sine = 1, at = 0;
};

std::array<Straightest, leg_count> straightest(const Scenario& scenario) {
  const Solver<double> solver(*scenario.manipulator);
  Workspace<double> work;
  std::array<Straightest, leg_count> all;
  for (double t : equallySpaced(scenario.trajectory->duration(), 201)) {
    solver.displacements(scenario.trajectory->at(t), work);
    for (std::size_t i = 0; i < leg_count; ++i)
      if (const double sine = std::abs(work.legs[i].sin_theta); sine < all[i].sine) all[i] = {sine, t};
  }
  return all;
}

/// A knee within 3° of straight or folded.
void straightKnees(const Scenario& scenario, std::vector<Oddity>& out) {
  constexpr double near = 3 * pi / 180;
  const std::array<Straightest, leg_count> all = straightest(scenario);
  for (std::size_t i = 0; i < leg_count; ++i)
    if (all[i].sine < std::sin(near))
      out.push_back(
          {"trajectory", fmt::format("brings the knee of leg {} to {:.3g} degrees from straight or folded at t "
                                     "= {:.4g} s: torques and rounding grow there",
                                     i + 1, degrees(std::asin(all[i].sine)), all[i].at)});
}

}  // namespace

std::vector<Oddity> oddMotion(const Scenario& scenario) {
  std::vector<Oddity> out;
  const std::string kind = scenario.trajectory->kind();
  if (kind == "helix") radians(scenario, out);
  if (kind == "hold") scalarLast(scenario, "trajectory.orientation", out);
  if (kind == "waypoints") scalarLast(scenario, "trajectory.points[1].orientation", out);
  if (kind == "samples") scalarLast(scenario, "trajectory.file", out);
  haste(scenario, out);
  try {
    straightKnees(scenario, out);
  } catch (const PoseError&) {
    // Out of reach is no oddity: tryMotion refuses it.
  }
  return out;
}

}  // namespace ursula
