#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/scalar.h"
#include "model/instants.h"
#include "model/legs/leg_type.h"
#include "model/scenario_files.h"
#include "model/trajectories/trajectory_kinds.h"
#include "nocsolver/errors.h"
#include "nocsolver/noc/noc.h"
#include "validation/check_scenario/check_scenario.h"
#include "validation/subject/singular_everywhere.h"

namespace ursula {
namespace {

double turned(const Matrix3d& Q) { return Eigen::AngleAxisd(Q).angle(); }

double degrees(double angle) { return angle * 180 / pi; }

/// Returns the rotation that was meant if the file gives [x, y, z, w] instead of [w, x, y, z].
Matrix3d asScalarLast(const Matrix3d& Q) {
  const Eigen::Quaterniond q(Q);
  return Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y()).toRotationMatrix();
}

/// Detects a quaternion with the scalar last, as many libraries write it: such machines hardly rotate by more than a
/// right angle.
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
      out.push_back({key, fmt::format("{:.6g} rad are {:.3g} turns", value, std::abs(value) / (2 * pi)),
                     fmt::format("did you mean {}_deg = {:.6g}?", name, value)});
  }
}

/// Equally spaced instants and the knots, between which an acceleration of a spline has its largest values. Of many
/// knots every n-th is taken.
std::vector<double> tellingInstants(const Trajectory& trajectory) {
  constexpr std::size_t most_knots = 20'000;
  std::vector<double> out = equallySpaced(trajectory.duration(), 201);
  const std::vector<double>& knots = trajectory.knots();
  for (std::size_t k = 0; k < knots.size(); k += 1 + knots.size() / most_knots) out.push_back(knots[k]);
  return out;
}

/// The value below which this share of all values lies.
double quantile(std::vector<double> values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Detects a row whose time stamp alone is late or early: one of the two steps beside it is far from the usual one, and
/// together they are two usual ones. Nine of ten steps say what is usual. A spline through such a row accelerates.
void unevenStamp(const Scenario& scenario, std::vector<Oddity>& out) {
  const std::vector<double>& t = scenario.trajectory->knots();
  if (scenario.trajectory->kind() != "samples" || t.size() < 10) return;
  std::vector<double> steps, off;
  for (std::size_t k = 1; k < t.size(); ++k) steps.push_back(t[k] - t[k - 1]);
  const double usual = quantile(steps, 0.5);
  for (const double step : steps) off.push_back(std::abs(step / usual - 1));
  const double spread = quantile(off, 0.9);
  if (spread > 0.1) return;
  std::size_t worst = 0;
  double most = std::max(0.05, 5 * spread);
  for (std::size_t k = 1; k < steps.size(); ++k)
    if (off[k - 1] > most && std::abs((steps[k - 1] + steps[k]) / (2 * usual) - 1) <= std::max(0.01, 2 * spread)) {
      most = off[k - 1];
      worst = k;
    }
  if (worst == 0) return;
  out.push_back({"trajectory",
                 fmt::format("row {} of the samples has t = {:.9g} s, {:.4g} s {} than the steps of {:.6g} s beside it "
                             "say: the motion through it accelerates without need. Is its stamp right?",
                             worst + 1, t[worst], most * usual, steps[worst - 1] > usual ? "later" : "earlier", usual),
                 "", "stamp"});
}

/// Compares the largest acceleration with the machine's gravity, or Earth's.
void haste(const Scenario& scenario, std::vector<Oddity>& out) {
  constexpr double g = 9.81, hasty = 20;
  double most = 0, at = 0;
  for (double t : tellingInstants(*scenario.trajectory)) {
    const double size = scenario.trajectory->at(t).p_ddot.norm();
    if (!(size > most)) continue;
    most = size;
    at = t;
  }
  const std::string key = placeInFile(scenario, "trajectory.duration").given ? "trajectory.duration" : "trajectory";
  if (most > hasty * g)
    out.push_back(
        {key,
         fmt::format("{:.6g} s make the platform accelerate by {:.4g} m/s2 at t = {:.4g} s, {:.3g} times 9.81 m/s2",
                     scenario.trajectory->duration(), most, at, most / g)});
  if (scenario.trajectory->duration() >= 1000)
    out.push_back({key, fmt::format("{:.6g} s", scenario.trajectory->duration()),
                   fmt::format("did you mean ms? {0:.6g} ms are {1:.6g} s", scenario.trajectory->duration(),
                               scenario.trajectory->duration() / 1000)});
}

/// Compares the platform's first position with what its legs can span.
void distance(const Scenario& scenario, std::vector<Oddity>& out) {
  const std::vector<Leg>& legs = scenario.manipulator->parameters().legs;
  double span = 0, near = std::numeric_limits<double>::infinity();
  const Vector3d p = scenario.trajectory->at(0).p;
  for (const Leg& leg : legs) {
    span = std::max(span, leg.proximal.length + leg.distal.length + leg.platform_point.norm());
    near = std::min(near, (p - leg.base_point).norm());
  }
  const bool on_rails =
      std::any_of(legs.begin(), legs.end(), [](const Leg& leg) { return rowOf(leg.kind).hasCarriage(); });
  if (near > 100 * span && !on_rails)
    out.push_back(
        {"trajectory",
         fmt::format("begins {:.6g} m from the nearest base point, while a leg and the platform span {:.6g} m", near,
                     span),
         inMillimetres(near)});
}

/// A leg's smallest value of a number over the motion.
struct Least {
  double value = std::numeric_limits<double>::infinity(), at = 0;

  void include(double other, double t) {
    if (other < value) *this = {other, t};
  }
};

/// A leg's smallest margins.
struct NearestOfLeg {
  Least sine;    ///< |sin θ|, or similar: 0 if the leg's rates are undetermined
  Least stroke;  ///< for UPS: to either end of the cylinder, m
};

std::vector<NearestOfLeg> nearestOfLegs(const Scenario& scenario) {
  const Manipulator& machine = *scenario.manipulator;
  const Noc<double> solver(machine);
  NocWorkspace<double> work;
  std::vector<NearestOfLeg> all(machine.parameters().legs.size());
  for (double t : equallySpaced(scenario.trajectory->duration(), 201)) {
    solver.displacements(scenario.trajectory->at(t), work);
    const JointVariables<double> q = solver.angles(work);
    for (int i = 0; i < machine.legCount(); ++i) {
      NearestOfLeg& nearest = all[i];
      const Leg& leg = machine.leg(i);
      nearest.sine.include(work.legs[i].margins.sine, t);
      if (rowOf(leg.kind).isTelescopic()) nearest.stroke.include(typeOf(leg.kind).margin(leg, q, i), t);
    }
  }
  return all;
}

/// Warns of poses within 3° of undetermined rates, and of rods within a fiftieth of a cylinder from its end.
void legsAtTheirLimits(const Scenario& scenario, std::vector<Oddity>& out) {
  constexpr double near = 3 * pi / 180;
  const std::vector<NearestOfLeg> all = nearestOfLegs(scenario);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Leg& leg = scenario.manipulator->leg(static_cast<int>(i));
    const auto& [sine, stroke] = all[i];
    const LegType& type = typeOf(leg.kind);
    if (sine.value < std::sin(near))
      out.push_back(
          {"trajectory",
           fmt::format(
               "brings the {} of leg {} to {:.3g} degrees from {} at t = {:.4g} s: efforts and rounding grow there",
               type.bends(), i + 1, degrees(std::asin(sine.value)), type.atDeadCentre(), sine.at)});
    if (rowOf(leg.kind).isTelescopic() && stroke.value < leg.proximal.length / 50)
      out.push_back({"trajectory", fmt::format("brings the rod of leg {} to {:.3g} m from an end of its cylinder, "
                                               "which is {:.6g} m long, at t = {:.4g} s",
                                               i + 1, stroke.value, leg.proximal.length, stroke.at)});
  }
}

}  // namespace

std::vector<Oddity> oddMotion(const Scenario& scenario) {
  std::vector<Oddity> out;
  radians(scenario, out);
  const TrajectoryKind* kind = trajectoryKind(scenario.trajectory->kind());
  if (kind != nullptr && kind->orientation != nullptr) scalarLast(scenario, kind->orientation, out);
  unevenStamp(scenario, out);
  haste(scenario, out);
  distance(scenario, out);
  if (const auto found = singularEverywhere(scenario))
    out.push_back({"manipulator.leg", "the machine is " + found->words()});
  try {
    legsAtTheirLimits(scenario, out);
  } catch (const PoseError&) {
    // A pose out of reach gives no warning, because tryMotion refuses it.
  }
  return out;
}

}  // namespace ursula
