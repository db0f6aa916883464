#include "exchange/recognise/leg_dynamics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/shown_text.h"
#include "exchange/import_error.h"

namespace ursula::exchange {
namespace {

/// The axis about which a scenario's angle grows, docs/conventions.md; zero for a slide.
Vector3d growsAbout(const ImportedLeg& leg, Coordinate coordinate, const Vector3d& base_axis, const Matrix3d& proximal,
                    const Matrix3d& distal) {
  if (slides(coordinate)) return Vector3d::Zero();
  const bool plane = leg.kind == LegKind::UPS || leg.kind == LegKind::URS;
  if (coordinate == Coordinate::phi || (coordinate == Coordinate::psi && !plane)) return -base_axis;
  if (plane) return proximal.col(0);
  return leg.kind == LegKind::RUS ? Vector3d(-distal.col(0)) : Vector3d(distal.col(0));
}

void takeCoordinate(const GraphJoint& from, Coordinate coordinate, std::size_t k, ImportedLeg& leg,
                    std::vector<Assumption>& assumptions) {
  leg.actuated[k] = from.driven;
  leg.damping[k] = from.damping;
  leg.friction[k] = from.friction;
  leg.rotor_inertia[k] = from.rotor_inertia;
  if (from.driven) leg.motors.push_back(from.name);
  if (from.rotor_inertia != 0 && !from.driven)
    throw ImportError(
        fmt::format("joint {} has a rotor's inertia of {} (armature) and is not driven, which a scenario "
                    "has no key for; without it, in the file and in your engine, the machine can be taken",
                    shown(from.name), from.rotor_inertia),
        from.line);
  if (from.friction != 0 && from.smoothing_speed > 0)
    leg.smoothing_speed = from.smoothing_speed;
  else if (from.friction != 0)
    assumptions.push_back({fmt::format("Coulomb friction is smoothed below 0.01 {}, of which the file says nothing",
                                       slides(coordinate) ? "m/s" : "rad/s"),
                           from.name, from.friction, slides(coordinate) ? "N" : "N·m"});
}

}  // namespace

void takeLegDynamics(const LegTask& task, const Vector3d& base_axis, const Matrix3d& proximal, const Matrix3d& distal,
                     ImportedLeg& leg, std::vector<Assumption>& assumptions) {
  const auto coordinates = rowOf(leg.kind).coordinates;
  for (std::size_t k = 0; k < coordinates.size(); ++k) {
    std::size_t at = k;
    if (task.shape.has_inner_ball) {
      // Joints that a ball replaces have no dynamics of their own, as checked before.
      const bool mine = leg.kind == LegKind::UPS ? k == 2 : k == 0;
      if (!mine) continue;
      at = leg.kind == LegKind::UPS ? 1 : 0;
    }
    const Primitive& primitive = task.shape.joints[at];
    const GraphJoint& joint = task.graph.joints[primitive.joint];
    takeCoordinate(joint, coordinates[k], k, leg, assumptions);
    if (joint.driven && growsAbout(leg, coordinates[k], base_axis, proximal, distal).dot(primitive.axis) < 0)
      assumptions.push_back(
          {fmt::format("The file's coordinate of this hinge grows against the scenario's {}: its effort has the other "
                       "sign",
                       nameOf(coordinates[k])),
           joint.name, -1, "1"});
  }
}

Stroke strokeOf(const LegTask& task, const Primitive& slide, const Vector3d& along, double length,
                std::vector<Assumption>& assumptions) {
  const GraphJoint& joint = task.graph.joints[slide.joint];
  const bool grows = slide.axis.dot(along) > 0;
  const double down = joint.lower - joint.position, up = joint.upper - joint.position;
  Stroke out{length + (grows ? down : -up), length + (grows ? up : -down), false};
  const bool limited = std::isfinite(out.least) || std::isfinite(out.most);
  out.from_file = std::isfinite(out.least) && std::isfinite(out.most) && out.least > 0 && out.most > out.least;
  if (!out.from_file) {
    out.least = 2 * length / 3;
    out.most = 4 * length / 3;
    assumptions.push_back(
        {fmt::format("The file {}: a third of the leg's length either way was taken",
                     limited ? "limits this slide's stroke to no usable range" : "does not limit this slide's stroke"),
         joint.name, length / 3, "m"});
  } else if (!(out.least < length && length < out.most)) {
    assumptions.push_back({"The initial pose lies outside the slide's limits, or at one; the stroke was widened",
                           joint.name, std::max(out.least - length, length - out.most), "m"});
    const double margin = 0.05 * (out.most - out.least);
    if (!(out.least < length)) out.least = std::max(length - margin, length / 2);
    if (!(length < out.most)) out.most = length + margin;
  }
  if (!grows)
    assumptions.push_back(
        {"The file's coordinate of this slide shortens the leg; d lengthens it", joint.name, -1, "1"});
  return out;
}

}  // namespace ursula::exchange
