#include "parts/exchange/recognise/legs.h"

#include <fmt/format.h>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text.h"

namespace ursula::exchange {
namespace {

constexpr double eps = 2.3e-16;
/// Rounded digits may leave at most this share of the largest moment open.
constexpr double most_of_the_digits = 0.1;

std::string moments(const Vector3d& m) { return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", m.x(), m.y(), m.z()); }

/// Zeroes off-diagonal entries and offsets that are only the rounding of the rotation.
void cleanRounding(Matrix3d& inertia, Vector3d& center, double mass, double size) {
  const double largest = inertia.cwiseAbs().maxCoeff() + mass * center.squaredNorm();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (i != j && std::abs(inertia(i, j)) <= 64 * eps * largest) inertia(i, j) = 0;
  for (int k = 0; k < 3; ++k)
    if (std::abs(center(k)) <= 64 * eps * size) center(k) = 0;
}

void takeCoordinate(const GraphJoint& from, Coordinate coordinate, std::size_t k, ImportedLeg& leg,
                    Assumptions& assumptions) {
  leg.actuated[k] = from.driven;
  leg.friction.on(coordinate) = from.damping;
  leg.coulomb.on(coordinate) = from.friction;
  leg.rotor_inertia.on(coordinate) = from.rotor_inertia;
  if (from.driven) leg.motors.push_back(from.name);
  if (from.rotor_inertia != 0 && !from.driven)
    refuseJoint(from, fmt::format(" has a rotor's inertia of {} (armature) and is not driven, which a scenario has no "
                                  "key for; without it, in the file and in your engine, the machine can be taken",
                                  from.rotor_inertia));
  if (from.friction != 0 && from.smoothing_speed > 0)
    leg.smoothing_speed = from.smoothing_speed;
  else if (from.friction != 0)
    assumptions.push_back({fmt::format("Coulomb friction is smoothed below 0.01 {}, of which the file says nothing",
                                       slides(coordinate) ? "m/s" : "rad/s"),
                           from.name, from.friction, slides(coordinate) ? "N" : "N·m"});
}

}  // namespace

double largestMoment(const Matrix3d& inertia) {
  return Eigen::SelfAdjointEigenSolver<Matrix3d>(inertia, Eigen::EigenvaluesOnly).eigenvalues().cwiseAbs().maxCoeff();
}

CommonPerpendicular commonPerpendicular(const Vector3d& p, const Vector3d& along_p, const Vector3d& q,
                                        const Vector3d& along_q) {
  CommonPerpendicular out;
  const Vector3d across = along_p.cross(along_q), from = q - p;
  const double sine = across.norm(), cosine = along_p.dot(along_q);
  out.angle = std::atan2(sine, std::abs(cosine));
  if (sine < 1e-9) {
    out.at = p + along_p * from.dot(along_p) / 2;
    out.apart = from.cross(along_p).norm();
    return out;
  }
  const double square = sine * sine;
  const double on_p = (from.dot(along_p) - from.dot(along_q) * cosine) / square;
  const double on_q = (from.dot(along_p) * cosine - from.dot(along_q)) / square;
  out.at = (p + on_p * along_p + q + on_q * along_q) / 2;
  out.apart = std::abs(from.dot(across)) / sine;
  return out;
}

std::optional<HingePoint> hingePoint(const Primitive* three) {
  Matrix3d sum = Matrix3d::Zero(), axes;
  Vector3d right = Vector3d::Zero();
  HingePoint out;
  for (int k = 0; k < 3; ++k) {
    const Primitive &p = three[k], &next = three[(k + 1) % 3];
    if (p.kind != Primitive::Kind::R || next.kind != Primitive::Kind::R) return {};
    axes.col(k) = p.axis;
    const Matrix3d across = Matrix3d::Identity() - p.axis * p.axis.transpose();
    sum += across;
    right += across * p.inner;
    out.apart = std::max(out.apart, commonPerpendicular(p.inner, p.axis, next.inner, next.axis).apart);
  }
  if (std::abs(axes.determinant()) < 1e-2) return {};
  out.at = sum.ldlt().solve(right);
  for (int k = 0; k < 3; ++k) out.off = std::max(out.off, (out.at - three[k].inner).cross(three[k].axis).norm());
  return out;
}

Matrix3d snapped(const Matrix3d& inertia, bool line_may_be_zero, const Group& body, Assumptions& assumptions) {
  const Matrix3d symmetric = (inertia + inertia.transpose()) / 2;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> principal(symmetric);
  Vector3d m = principal.eigenvalues();
  // A number with a single digit, such as 1e5, would otherwise excuse any error.
  const double noise = 256 * eps * m.cwiseAbs().maxCoeff(),
               slack = std::min(3 * body.inertia_rounding, most_of_the_digits * m.cwiseAbs().maxCoeff()) + noise;
  const bool line_is_zero = line_may_be_zero && std::abs(symmetric(2, 2)) <= noise;
  if (!(m(0) > noise) && !line_is_zero)
    refuseBody(body, fmt::format(": principal moments of inertia {}, expected all of them above zero", moments(m)));
  const double excess = m(2) - m(1) - std::max(m(0), 0.0);
  if (excess <= 8 * eps * m(2) && !line_is_zero) return symmetric;
  // A turned tensor has rounding where that of a thin rod has zero.
  if (excess <= noise && line_is_zero) return ((m(1) + m(2)) / 2 * Vector3d(1, 1, 0)).asDiagonal();
  if (!(excess <= slack))
    refuseBody(body, fmt::format(": principal moments of inertia {}: the largest exceeds the sum of the others by "
                                 "{:.3g}, more than the file's digits leave open ({:.1g})",
                                 moments(m), excess, slack));
  assumptions.push_back(
      {"The largest principal moment exceeded the sum of the others, by the file's digits; all three were moved by a "
       "third of that",
       body.name, excess, "kg·m²"});
  m += excess / 3 * Vector3d(1, 1, -1);
  const Matrix3d out = principal.eigenvectors() * m.asDiagonal() * principal.eigenvectors().transpose();
  return (out + out.transpose()) / 2;
}

Link linkOf(const LegTask& task, const Group& link, const Eigen::Isometry3d& frame, int line, double length,
            bool line_may_be_zero) {
  if (!(link.mass > 0))
    refuseBody(link, fmt::format(", a link of the leg of {}, has no mass, expected one above zero", task.shape.place));
  requireWeight(link);
  Link out;
  out.length = length;
  out.mass = link.mass;
  Vector3d center = frame.inverse() * link.center_of_mass;
  const Matrix3d turn = frame.linear();
  out.inertia = turn.transpose() * link.inertia * turn;
  out.inertia = ((out.inertia + out.inertia.transpose()) / 2).eval();
  cleanRounding(out.inertia, center, link.mass, task.size);
  out.inertia = snapped(out.inertia, line_may_be_zero, link, task.assumptions);
  out.center_of_mass = std::exchange(center(line), 0);
  out.off_line = center;
  return out;
}

void freeSpin(const LegTask& task, const Group& body, const Eigen::Isometry3d& frame, bool keep_moment, Link& link) {
  const Matrix3d local = frame.linear().transpose() * body.inertia * frame.linear();
  const Vector3d center = frame.inverse() * body.center_of_mass;
  const double off = center.head<2>().norm(), largest = local.cwiseAbs().maxCoeff();
  const double unequal = std::max(
      {std::abs(local(0, 0) - local(1, 1)), std::abs(local(0, 1)), std::abs(local(0, 2)), std::abs(local(1, 2))});
  const double share = largest > 0 ? unequal / largest : 0;
  if (!(off <= task.choices.tolerance * task.size) || !(share <= task.choices.tolerance))
    refuseBody(
        body,
        fmt::format(
            " spins freely about the line of its leg, of {}: its transverse moments differ by {:.3g} of the largest "
            "and its mass centre is {:.3g} m off the line, expected equal ones and a mass centre on the line",
            task.shape.place, share, off));
  if (share > worth_saying)
    task.assumptions.push_back(
        {"This freely spinning body is assumed to be round; its moments differ by this share", body.name, share, "1"});
  if (off > worth_saying * task.size)
    task.assumptions.push_back(
        {"This freely spinning body is assumed to have its mass centre on the line", body.name, off, "m"});
  if (keep_moment) {
    const double across = (link.inertia(0, 0) + link.inertia(1, 1)) / 2;
    link.inertia = Vector3d(across, across, link.inertia(2, 2)).asDiagonal();
    link.off_line.setZero();
  } else {
    link.inertia(2, 2) -= local(2, 2);
    if (std::abs(link.inertia(2, 2)) <= 64 * eps * largest) link.inertia(2, 2) = 0;
  }
  task.assumptions.push_back(
      {"This rod may spin freely about its line; it does not, and then its moment about the line has no effect",
       body.name, share, "1"});
}

void lumpCrosses(const LegTask& task, const Vector3d& base_point, Group& proximal, const Group& distal) {
  const double leg_moment =
      largestMoment(proximal.inertiaAbout(base_point)) + largestMoment(distal.inertiaAbout(base_point));
  const double leg_weight = proximal.mass * (proximal.center_of_mass - base_point).norm() +
                            distal.mass * (distal.center_of_mass - base_point).norm();
  for (const Cross& cross : task.shape.crosses) {
    const Group& group = task.groups.groups[cross.group];
    if (group.isFrame()) continue;
    requireWeight(group);
    const double share = std::max(largestMoment(group.inertiaAbout(cross.centre)) / leg_moment,
                                  group.mass * (group.center_of_mass - cross.centre).norm() / leg_weight);
    if (!(share <= task.choices.lump))
      refuseBody(group, fmt::format(", between the hinges of one joint of the leg of {}, has {:.3g} of the leg's "
                                    "moments, which would be lost, expected at most {:g} (--lump)",
                                    task.shape.place, share, task.choices.lump));
    const bool at_base = cross.rides == Cross::Rides::base, at_platform = cross.rides == Cross::Rides::platform;
    if (at_platform) task.of_platform.add(group.mass, cross.centre, Matrix3d::Zero());
    if (!at_base && !at_platform) proximal.add(group.mass, cross.centre, Matrix3d::Zero());
    task.assumptions.push_back({fmt::format("Its tensor is left out, as a share of the leg's moments; its mass {}",
                                            at_base       ? "rests on the base"
                                            : at_platform ? "rides on the platform's joint"
                                                          : "rides on the first link's end"),
                                group.name, share, "1"});
  }
}

void takeLegDynamics(const LegTask& task, const std::array<Vector3d, 3>& grows_along, ImportedLeg& leg) {
  const auto coordinates = rowOf(leg.kind).coordinates;
  for (std::size_t k = 0; k < coordinates.size(); ++k) {
    // Joints that a ball replaces have no dynamics of their own, as checked before.
    const std::optional<std::size_t> at = task.shape.jointOf(k);
    if (!at) continue;
    const Primitive& primitive = task.shape.joints[*at];
    const GraphJoint& joint = task.graph.joints[primitive.joint];
    takeCoordinate(joint, coordinates[k], k, leg, task.assumptions);
    if (joint.driven && !slides(coordinates[k]) && grows_along[k].dot(primitive.axis) < 0)
      task.assumptions.push_back(
          {fmt::format(
               "The file's coordinate of this hinge grows against the scenario's {}: its effort has the other sign",
               nameOf(coordinates[k])),
           joint.name, -1, "1"});
  }
}

Stroke strokeOf(const LegTask& task, const Primitive& slide, const Vector3d& along, double length) {
  const GraphJoint& joint = task.graph.joints[slide.joint];
  const bool grows = slide.axis.dot(along) > 0;
  const double down = joint.lower - joint.position, up = joint.upper - joint.position;
  Stroke out{length + (grows ? down : -up), length + (grows ? up : -down), false};
  const bool limited = std::isfinite(out.least) || std::isfinite(out.most);
  out.from_file = std::isfinite(out.least) && std::isfinite(out.most) && out.least > 0 && out.most > out.least;
  if (!out.from_file) {
    out.least = 2 * length / 3;
    out.most = 4 * length / 3;
    task.assumptions.push_back(
        {fmt::format("The file {}: a third of the leg's length either way was taken",
                     limited ? "limits this slide's stroke to no usable range" : "does not limit this slide's stroke"),
         joint.name, length / 3, "m"});
  } else if (!(out.least < length && length < out.most)) {
    task.assumptions.push_back({"The initial pose lies outside the slide's limits, or at one; the stroke was widened",
                                joint.name, std::max(out.least - length, length - out.most), "m"});
    const double margin = 0.05 * (out.most - out.least);
    if (!(out.least < length)) out.least = std::max(length - margin, length / 2);
    if (!(length < out.most)) out.most = length + margin;
  }
  if (!grows)
    task.assumptions.push_back(
        {"The file's coordinate of this slide shortens the leg; d lengthens it", joint.name, -1, "1"});
  return out;
}

}  // namespace ursula::exchange
