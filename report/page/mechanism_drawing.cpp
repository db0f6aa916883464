#include "report/page/mechanism_drawing.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace ursula::report {
namespace {

/// The principal directions of a cloud, the thinnest first, with their standard deviations.
struct Cloud {
  Vector3d middle = Vector3d::Zero();
  Matrix3d directions = Matrix3d::Identity();
  Vector3d sizes = Vector3d::Zero();
};

Cloud cloudOf(const std::vector<Vector3d>& points) {
  Cloud out;
  if (points.empty()) return out;
  for (const Vector3d& point : points) out.middle += point / static_cast<double>(points.size());
  Matrix3d spread = Matrix3d::Zero();
  for (const Vector3d& point : points) spread += (point - out.middle) * (point - out.middle).transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(spread / static_cast<double>(points.size()));
  out.directions = solver.eigenvectors();
  out.sizes = solver.eigenvalues().cwiseMax(0).cwiseSqrt();
  return out;
}

constexpr double thin = 0.05;  // of the next larger size

std::vector<Vector3d> picked(const MechanismPicture::Body& body, const std::vector<std::size_t>& which) {
  std::vector<Vector3d> out;
  for (const std::size_t k : which) out.push_back(body.points[k]);
  return out;
}

/// The mass centre belongs to the picture where it alone shows the body, or lies off the line of two joints.
std::vector<std::size_t> shownPoints(const MechanismPicture::Body& body) {
  std::vector<std::size_t> all(body.points.size()), anchors(body.anchors);
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::iota(anchors.begin(), anchors.end(), std::size_t{0});
  if (body.anchors < 2) return all;
  const Cloud cloud = cloudOf(picked(body, all));
  const bool off_the_line = body.anchors == 2 && cloud.sizes(1) > 3 * thin * cloud.sizes(2);
  return off_the_line ? all : anchors;
}

}  // namespace

BodyShape shapeOf(const MechanismPicture::Body& body) {
  BodyShape out;
  out.points = shownPoints(body);
  const Cloud cloud = cloudOf(picked(body, out.points));
  out.plate = out.points.size() > 2 && cloud.sizes(1) > thin * cloud.sizes(2);
  const auto along = [&](std::size_t k, int direction) {
    return (body.points[k] - cloud.middle).dot(cloud.directions.col(direction));
  };
  const auto order = [&](std::size_t k) { return out.plate ? std::atan2(along(k, 1), along(k, 2)) : along(k, 2); };
  std::sort(out.points.begin(), out.points.end(),
            [&order](std::size_t a, std::size_t b) { return order(a) < order(b); });
  for (std::size_t k = 0; k + 1 < out.points.size(); ++k) out.rods.emplace_back(out.points[k], out.points[k + 1]);
  if (out.plate) out.rods.emplace_back(out.points.back(), out.points.front());
  return out;
}

Vector3d placed(const MechanismPicture::Body& body, const Vector3d& point, std::size_t instant) {
  const std::size_t k = std::min(instant, body.p.size() - 1);
  const Eigen::Vector4d& q = body.q[k];
  return body.p[k] + Eigen::Quaterniond(q(0), q(1), q(2), q(3)) * point;
}

Vector3d viewOf(const MechanismPicture& picture) {
  const Vector3d usual = Vector3d(-0.75, 1.15, -0.5).normalized();
  std::vector<Vector3d> points;
  for (const MechanismPicture::Body& body : picture.bodies)
    for (const Vector3d& point : body.points)
      for (std::size_t k = 0; k < body.p.size(); k += std::max<std::size_t>(1, body.p.size() / 8))
        points.push_back(placed(body, point, k));
  const Cloud cloud = cloudOf(points);
  if (!(cloud.sizes(0) < 3 * thin * cloud.sizes(1))) return usual;
  Vector3d normal = cloud.directions.col(0);
  if (normal.dot(usual) < 0) normal = -normal;
  if (std::abs(normal.z()) > 0.7) return Vector3d(-0.2, 0.35, -1).normalized();
  return (normal + 0.3 * normal.cross(Vector3d::UnitZ()) - 0.25 * Vector3d::UnitZ()).normalized();
}

}  // namespace ursula::report
