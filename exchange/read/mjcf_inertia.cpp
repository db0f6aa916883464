#include "exchange/read/mjcf_parts.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "base/scalar.h"
#include "base/text.h"
#include "exchange/recognise/chains.h"

namespace ursula::exchange {
namespace {

struct Shape {
  double volume = 0;
  Vector3d moments = Vector3d::Zero();  ///< for unit mass, about the shape's axes
};

/// Mass and moments according to MuJoCo's reference: sizes are half lengths and radii.
Shape shapeOf(const Element& geom, const std::string& type, const std::vector<double>& size) {
  const auto needed = type == "sphere" ? 1U : type == "box" || type == "ellipsoid" ? 3U : 2U;
  if (size.size() < needed)
    refuse(geom, fmt::format("size has {} numbers, expected {} of a {}", size.size(), needed, type));
  for (std::size_t k = 0; k < needed; ++k)
    if (!(size[k] > 0)) refuse(geom, fmt::format("size {}, expected lengths above zero", size[k]));
  const double a = size[0], b = needed > 1 ? size[1] : a, c = needed > 2 ? size[2] : a;
  if (type == "sphere") return {4 * pi * a * a * a / 3, Vector3d::Constant(0.4 * a * a)};
  if (type == "box") return {8 * a * b * c, Vector3d(b * b + c * c, a * a + c * c, a * a + b * b) / 3};
  if (type == "ellipsoid") return {4 * pi * a * b * c / 3, Vector3d(b * b + c * c, a * a + c * c, a * a + b * b) / 5};
  const double height = 2 * b, cylinder = pi * a * a * height;
  const Vector3d round((3 * a * a + height * height) / 12, (3 * a * a + height * height) / 12, a * a / 2);
  if (type == "cylinder") return {cylinder, round};
  const double ball = 4 * pi * a * a * a / 3, share = ball / (ball + cylinder);
  const double along = 0.4 * a * a, across = along + height * (3 * a + 2 * height) / 8;
  return {ball + cylinder, (1 - share) * round + share * Vector3d(across, across, along)};
}

}  // namespace

void addGeom(const Element& geom, const MjcfCompiler& compiler, const Eigen::Isometry3d& at,
             const std::function<std::string(const char*)>& get, GraphBody& body) {
  const std::string group = get("group"), mass_text = get("mass"), density = get("density"), from_to = get("fromto");
  const double of_group = group.empty() ? 0 : numberOf(geom, group, "group");
  if (of_group < compiler.least_group || of_group > compiler.most_group) return;
  const std::string type = get("type").empty() ? "sphere" : get("type");
  const double given = mass_text.empty() ? -1 : numberOf(geom, mass_text, "mass");
  if (given == 0 || type == "plane" || type == "hfield") return;
  const double per_volume = density.empty() ? 1000 : numberOf(geom, density, "density");
  if (mass_text.empty() && per_volume == 0) return;
  if (!get("mesh").empty() || type == "mesh" || type == "sdf")
    refuse(geom, fmt::format("a mass that follows from a mesh ({}), which is not read; body {} needs an <inertial>",
                             shown(get("mesh")), shown(body.name)));
  if (get("shellinertia") == "true") refuse(geom, "shellinertia, which is not read; its body needs an <inertial>");
  if (type != "sphere" && type != "box" && type != "ellipsoid" && type != "cylinder" && type != "capsule")
    refuse(geom, fmt::format("type '{}', expected sphere, box, ellipsoid, cylinder or capsule", shown(type)));
  const std::string pos = get("pos");
  Vector3d center = pos.empty() ? Vector3d::Zero() : vectorOf(geom, pos, "pos");
  std::vector<double> size = numbersOf(geom, get("size"), 0, "size");
  Matrix3d turn = Matrix3d::Identity();
  if (from_to.empty()) {
    turn = mjcfOrientation(geom, compiler, get);
  } else {
    const std::vector<double> v = numbersOf(geom, from_to, 6, "fromto");
    const Vector3d from(v[0], v[1], v[2]), to(v[3], v[4], v[5]);
    center = (from + to) / 2;
    // MuJoCo points the shape's z axis from the second point to the first.
    turn = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), directionOf(geom, from - to, "fromto"))
               .toRotationMatrix();
    if (size.empty()) refuse(geom, "no size, expected a radius");
    const double half = (to - from).norm() / 2;
    size = type == "box" || type == "ellipsoid" ? std::vector<double>{size[0], size[0], half}
                                                : std::vector<double>{size[0], half};
  }
  const Shape shape = shapeOf(geom, type, size);
  const double mass = mass_text.empty() ? per_volume * shape.volume : given;
  if (!(mass > 0)) refuse(geom, fmt::format("a mass of {}, expected none below zero", mass));
  const Matrix3d axes = at.linear() * turn;
  Group sum;
  sum.add(body.mass, body.center_of_mass, body.inertia);
  sum.add(mass, at * center, axes * (mass * shape.moments).asDiagonal() * axes.transpose());
  body.mass = sum.mass;
  body.center_of_mass = sum.center_of_mass;
  body.inertia = sum.inertia;
}

void takeInertial(const Element& inertial, const MjcfCompiler& compiler, const Eigen::Isometry3d& at, GraphBody& body) {
  const auto get = [&](const char* name) { return attribute(inertial, name); };
  body.mass = numberOf(inertial, requiredAttribute(inertial, "mass"), "mass");
  if (body.mass < 0) refuse(inertial, fmt::format("a mass of {}, expected none below zero", body.mass));
  const std::string pos = get("pos"), full = get("fullinertia"), diagonal = get("diaginertia");
  body.center_of_mass = at * (pos.empty() ? Vector3d::Zero() : vectorOf(inertial, pos, "pos"));
  Matrix3d turn = at.linear() * mjcfOrientation(inertial, compiler, get), local = Matrix3d::Zero();
  if (!full.empty()) {
    for (const char* name : {"quat", "axisangle", "euler", "xyaxes", "zaxis"})
      if (!get(name).empty()) refuse(inertial, fmt::format("both fullinertia and {}, expected one", name));
    const std::vector<double> v = numbersOf(inertial, full, 6, "fullinertia");
    local = tensorOf({v[0], v[1], v[2]}, {v[3], v[4], v[5]});
    body.inertia_rounding = halfLastDigit(full);
  } else if (!diagonal.empty()) {
    local = vectorOf(inertial, diagonal, "diaginertia").asDiagonal();
    body.inertia_rounding = halfLastDigit(diagonal);
  }
  body.inertia = turn * local * turn.transpose();
}

void boundInertia(const Element& element, const MjcfCompiler& compiler, GraphBody& body,
                  std::vector<Assumption>& assumptions) {
  if (compiler.least_mass <= 0 && compiler.least_inertia <= 0 && !compiler.balance_inertia) return;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> principal((body.inertia + body.inertia.transpose()) / 2);
  Vector3d moments = principal.eigenvalues();
  if (body.mass < compiler.least_mass) {
    assumptions.push_back(
        {"The mass was raised to boundmass, by this", body.name, compiler.least_mass - body.mass, "kg"});
    body.mass = compiler.least_mass;
  }
  if (moments(0) < compiler.least_inertia) {
    assumptions.push_back({"Principal moments were raised to boundinertia, by up to this", body.name,
                           compiler.least_inertia - moments(0), "kg·m²"});
    moments = moments.cwiseMax(compiler.least_inertia);
  }
  if (!(moments(0) >= -1e-12 * moments(2))) refuse(element, "a principal moment below zero, expected none");
  if (compiler.balance_inertia && moments(2) > moments(0) + moments(1)) {
    assumptions.push_back(
        {"Moments that break the triangle inequality were set to their mean (balanceinertia), changed by "
         "up to this",
         body.name, (moments.array() - moments.mean()).abs().maxCoeff(), "kg·m²"});
    moments.setConstant(moments.mean());
  }
  body.inertia = principal.eigenvectors() * moments.asDiagonal() * principal.eigenvectors().transpose();
}

}  // namespace ursula::exchange
