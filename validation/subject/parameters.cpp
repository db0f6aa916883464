#include "validation/subject/parameters.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>

namespace ursula {
namespace {

using Machine = ManipulatorParameters;
using VectorOf = std::function<Vector3d&(Machine&)>;
using NumberOf = std::function<double&(Machine&)>;
using TensorOf = std::function<Matrix3d&(Machine&)>;

/// What `of` reads of a machine that stays as it is.
template <class Of>
std::function<double(const Machine&)> reading(const Of& of) {
  return [of](const Machine& machine) {
    Machine copy = machine;
    return static_cast<double>(of(copy));
  };
}

void addNumber(std::vector<Parameter>& out, const std::string& name, const std::string& group, const NumberOf& of) {
  out.push_back({name, group, [of](Machine& machine, double relative) { of(machine) *= 1 + relative; }, reading(of)});
}

void addVector(std::vector<Parameter>& out, const std::string& name, const std::string& group, const VectorOf& of) {
  const std::array<const char*, 3> axes{"x", "y", "z"};
  for (int k = 0; k < 3; ++k)
    out.push_back({fmt::format("{}.{}", name, axes[static_cast<std::size_t>(k)]), group,
                   [of, k](Machine& machine, double relative) {
                     const double size = of(machine).norm();
                     of(machine)(k) += relative * (size > 0 ? size : 1);  // of one metre where the vector is zero
                   },
                   reading([of, k](Machine& machine) { return of(machine)(k); })});
}

void addTensor(std::vector<Parameter>& out, const std::string& name, const TensorOf& of) {
  struct Entry {
    const char* name;
    int i, j;
  };
  const std::array<Entry, 6> entries{
      {{"xx", 0, 0}, {"yy", 1, 1}, {"zz", 2, 2}, {"xy", 0, 1}, {"xz", 0, 2}, {"yz", 1, 2}}};
  for (const Entry& entry : entries)
    out.push_back({name + "." + entry.name, "inertia",
                   [of, entry](Machine& machine, double relative) {
                     Matrix3d& I = of(machine);
                     const double change = relative * I.cwiseAbs().maxCoeff();
                     I(entry.i, entry.j) += change;
                     if (entry.i != entry.j) I(entry.j, entry.i) += change;
                   },
                   reading([of, entry](Machine& machine) { return of(machine)(entry.i, entry.j); })});
}

/// The axis turned about two directions across it.
void addAxis(std::vector<Parameter>& out, const std::string& name, std::size_t leg) {
  for (int k = 0; k < 2; ++k)
    out.push_back({fmt::format("{}.{}", name, k == 0 ? "across" : "along"), "axis",
                   [leg, k](Machine& machine, double relative) {
                     Vector3d& u = machine.legs[leg].base_axis;
                     const Vector3d across = u.unitOrthogonal();
                     const Vector3d about = k == 0 ? across : Vector3d(u.normalized().cross(across));
                     u = Eigen::AngleAxisd(relative, about) * u;
                   },
                   nullptr});
}

/// The length of a cylinder says where its stroke ends, and nothing else.
void addLink(std::vector<Parameter>& out, const std::string& name, const std::function<Link&(Machine&)>& of,
             bool length_matters) {
  if (length_matters) addNumber(out, name + ".length", "length", [of](Machine& m) -> double& { return of(m).length; });
  addNumber(out, name + ".mass", "mass", [of](Machine& m) -> double& { return of(m).mass; });
  addNumber(out, name + ".center_of_mass", "center", [of](Machine& m) -> double& { return of(m).center_of_mass; });
  addTensor(out, name + ".inertia", [of](Machine& m) -> Matrix3d& { return of(m).inertia; });
}

void addFriction(std::vector<Parameter>& out, const std::string& name, std::size_t i, LegKind kind) {
  bool turns = false, goes = false;
  for (const Coordinate q : rowOf(kind).coordinates) {
    addNumber(out, fmt::format("{}.friction.{}", name, nameOf(q)), "friction",
              [i, q](Machine& m) -> double& { return m.legs[i].friction.on(q); });
    addNumber(out, fmt::format("{}.coulomb.{}", name, nameOf(q)), "friction",
              [i, q](Machine& m) -> double& { return m.legs[i].coulomb.on(q); });
    (slides(q) ? goes : turns) = true;
  }
  if (turns)
    addNumber(out, name + ".coulomb.smoothing_speed", "friction",
              [i](Machine& m) -> double& { return m.legs[i].coulomb.smoothing_speed; });
  if (goes)
    addNumber(out, name + ".coulomb.sliding_speed", "friction",
              [i](Machine& m) -> double& { return m.legs[i].coulomb.sliding_speed; });
}

/// A carriage does not turn, and its length is for drawing only.
void addCarriage(std::vector<Parameter>& out, const std::string& name, const std::function<Link&(Machine&)>& of) {
  addNumber(out, name + ".mass", "mass", [of](Machine& m) -> double& { return of(m).mass; });
}

void addLeg(std::vector<Parameter>& out, std::size_t i, LegKind kind) {
  const std::string name = fmt::format("leg[{}]", i + 1);
  const auto proximal = [i](Machine& m) -> Link& { return m.legs[i].proximal; };
  addVector(out, name + ".base_point", "point", [i](Machine& m) -> Vector3d& { return m.legs[i].base_point; });
  addVector(out, name + ".platform_point", "point", [i](Machine& m) -> Vector3d& { return m.legs[i].platform_point; });
  addAxis(out, name + ".base_axis", i);
  if (kind == LegKind::PUS)
    addCarriage(out, name + ".proximal", proximal);
  else
    addLink(out, name + ".proximal", proximal, kind != LegKind::UPS);
  addLink(
      out, name + ".distal", [i](Machine& m) -> Link& { return m.legs[i].distal; }, true);
  addFriction(out, name, i, kind);
}

}  // namespace

std::vector<Parameter> allParameters(const std::vector<LegKind>& legs) {
  std::vector<Parameter> out;
  addVector(out, "gravity", "gravity", [](Machine& m) -> Vector3d& { return m.gravity; });
  addNumber(out, "platform.mass", "mass", [](Machine& m) -> double& { return m.platform.mass; });
  addVector(out, "platform.center_of_mass", "center",
            [](Machine& m) -> Vector3d& { return m.platform.center_of_mass; });
  addTensor(out, "platform.inertia", [](Machine& m) -> Matrix3d& { return m.platform.inertia; });
  for (std::size_t i = 0; i < legs.size(); ++i) addLeg(out, i, legs[i]);
  return out;
}

std::vector<Parameter> allParameters(const Manipulator& machine) {
  std::vector<LegKind> legs;
  for (const Leg& leg : machine.parameters().legs) legs.push_back(leg.kind);
  return allParameters(legs);
}

}  // namespace ursula
