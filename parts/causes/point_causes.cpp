#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "base/scalar.h"
#include "parts/causes/tried_causes.h"

namespace ursula {
namespace {

using Machine = ManipulatorParameters;

/// What belongs to the base or the platform of all legs.
struct Points {
  const char* words;
  NamedCause named;
  std::vector<Vector3d Leg::*> of;
};

NamedCause ofAllLegs(const char* key) {
  return {CauseKind::parameter, "", "legs", std::string("manipulator.leg_defaults.") + key};
}
const Points platform_points = {"platform points", ofAllLegs("platform_point"), {&Leg::platform_point}};
const Points base_points = {"base points", ofAllLegs("base_point"), {&Leg::base_point}};
const Points base_points_and_axes = {
    "base points and axes", ofAllLegs("base_point"), {&Leg::base_point, &Leg::base_axis}};

/// The same factor for all: of every coordinate, or of the radius about z.
void addScaled(const Points& points, TriedCauses& out) {
  const auto point = points.of.front();
  const std::vector<Leg>& legs = out.machine.parameters().legs;
  const bool flat = std::all_of(legs.begin(), legs.end(), [&](const Leg& leg) { return (leg.*point).z() == 0; });
  for (const bool radius : {false, true}) {
    if (radius && flat) continue;
    Cause& cause = out.addFitted(
        [point, radius](Machine& changed, double x) {
          for (Leg& leg : changed.legs) {
            const double z = (leg.*point).z();
            leg.*point *= 1 + x;
            if (radius) (leg.*point).z() = z;
          }
        },
        [&points, radius](double x, double deviation) {
          return fmt::format("{} of every leg scaled by {}{}", points.words, withDeviation(1 + x, deviation),
                             radius ? " across z" : "");
        },
        [&points](double, double) { return points.named; });
    cause.starts = {0, 1, -0.5};  // a diameter for a radius, and the other way round
  }
}

void addTurned(const std::string& words, const NamedCause& named,
               const std::function<void(Machine&, const Matrix3d&)>& turn, TriedCauses& out) {
  Cause& cause = out.addFitted(
      [turn](Machine& changed, double x) { turn(changed, Eigen::AngleAxisd(x, Vector3d::UnitZ()).toRotationMatrix()); },
      [words](double x, double deviation) {
        return fmt::format(
            "{} turned about z by {} deg", words,
            withDeviation(std::remainder(x, 2 * pi) * degrees_per_radian, deviation * degrees_per_radian));
      },
      [named](double, double) { return named; });
  constexpr double step = 15 / degrees_per_radian;  // near enough to any other angle
  cause.starts.clear();
  for (int k = -11; k <= 12; ++k) cause.starts.push_back(k * step);
}

void addTurnedPoints(const Points& points, TriedCauses& out) {
  addTurned(
      points.words + std::string(" of every leg"), points.named,
      [&points](Machine& changed, const Matrix3d& R) {
        for (Leg& leg : changed.legs)
          for (const auto each : points.of) leg.*each = (R * (leg.*each)).eval();
      },
      out);
}

/// Entry i is the leg whose points leg i gets: numbered from another leg, the other way round, or two exchanged.
std::set<std::vector<int>> numberings(int legs) {
  std::vector<int> right(legs);
  std::iota(right.begin(), right.end(), 0);
  std::set<std::vector<int>> out;
  for (int k = 0; k < legs; ++k) {
    std::vector<int> turned = right;
    std::rotate(turned.begin(), turned.begin() + k, turned.end());
    out.insert(turned);
    out.insert({turned.rbegin(), turned.rend()});
    for (int i = 0; i < k; ++i) {
      std::vector<int> exchanged = right;
      std::swap(exchanged[i], exchanged[k]);
      out.insert(exchanged);
    }
  }
  out.erase(right);
  return out;
}

void addNumbered(const Points& points, TriedCauses& out) {
  for (const std::vector<int>& from : numberings(out.machine.legCount())) {
    std::string which;
    for (std::size_t i = 0; i < from.size(); ++i)
      if (from[i] != static_cast<int>(i))
        which += fmt::format("{} leg {} has {} of leg {}", which.empty() ? "" : ",", i + 1,
                             points.of.size() > 1 ? "those" : "that", from[i] + 1);
    out.addMachine({fmt::format("{} of other legs:{}", points.words, which), points.named},
                   [from, &points](Machine& changed) {
                     const std::vector<Leg> legs_before = changed.legs;
                     for (std::size_t i = 0; i < from.size(); ++i)
                       for (const auto each : points.of) changed.legs[i].*each = legs_before[from[i]].*each;
                   });
  }
}

void addAxes(TriedCauses& out) {
  const auto add = [&](const char* words, const std::function<void(Leg&)>& change) {
    out.addMachine({fmt::format("base axes {}", words), ofAllLegs("base_axis")},
                   [change](Machine& machine) { std::for_each(machine.legs.begin(), machine.legs.end(), change); });
  };
  const auto radial = [](const Leg& leg) { return Vector3d(leg.base_point.x(), leg.base_point.y(), 0); };
  add("without their part along z", [](Leg& leg) { leg.base_axis.z() = 0; });
  add("with the wrong sign of z", [](Leg& leg) { leg.base_axis.z() *= -1; });
  add("along x", [](Leg& leg) { leg.base_axis = Vector3d::UnitX(); });
  add("along y", [](Leg& leg) { leg.base_axis = Vector3d::UnitY(); });
  add("along z", [](Leg& leg) { leg.base_axis = Vector3d::UnitZ(); });
  add("along the radii of the base points", [=](Leg& leg) { leg.base_axis = radial(leg); });
  add("across the radii of the base points", [=](Leg& leg) { leg.base_axis = Vector3d::UnitZ().cross(radial(leg)); });
}

}  // namespace

void addPointCauses(TriedCauses& out) {
  addAxes(out);
  for (const Points* points : {&platform_points, &base_points, &base_points_and_axes}) {
    addNumbered(*points, out);
    addTurnedPoints(*points, out);
  }
  addTurned(
      "points, mass centre and inertia of the platform", {CauseKind::frame, "orientation", "platform"},
      [](Machine& changed, const Matrix3d& R) {
        for (Leg& leg : changed.legs) leg.platform_point = (R * leg.platform_point).eval();
        Platform& one = changed.platform;
        one.center_of_mass = (R * one.center_of_mass).eval();
        one.inertia = (R * one.inertia * R.transpose()).eval();
      },
      out);
  for (const Points* points : {&platform_points, &base_points}) addScaled(*points, out);
}

}  // namespace ursula
