// Wrong numbers of the machine: each kind of parameter, legs that take each other's, tensors in other frames.

#include <fmt/format.h>

#include <array>

#include "validation/prove/defects_kit.h"

namespace ursula {
namespace {

using P = ManipulatorParameters;

/// Large against rounding, small against anything that a person would see in a plot.
constexpr double parameter_error = 1e-6;

/// Tensor of a point mass about a point `arm` from it.
Matrix3d pointInertia(double mass, const Vector3d& arm) {
  return mass * (arm.squaredNorm() * Matrix3d::Identity() - arm * arm.transpose());
}

Matrix3d aboutJoint(const Link& link) {
  return link.inertia + pointInertia(link.mass, link.center_of_mass * Vector3d::UnitZ());
}

/// The link's axes [x, axis × x, axis] turned by a quarter about the axis.
Matrix3d quarterTurned(const Matrix3d& inertia) {
  Matrix3d turn;
  turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  return turn * inertia * turn.transpose();
}

/// A platform's tensor that is wrong by an amount that depends on its orientation: the moment that it takes more.
Defect wrongPlatformTensor(const char* name, const std::function<Matrix3d(const Matrix3d& I, const Matrix3d& Q)>& of) {
  return wrongTorques(name, "frame", [of](const Scenario& s) -> ChangeTorques {
    const auto solver = std::make_shared<const Solver<double>>(*s.manipulator);
    const Matrix3d I = s.manipulator->platform().inertia;
    return [solver, I, of](const Vector6d& torques, const Motion<double>& m) {
      const Matrix3d more = of(I, m.Q) - m.Q * I * m.Q.transpose();
      Vector6d wrench = Vector6d::Zero();
      wrench.head<3>() = more * m.omega_dot + m.omega.cross(Vector3d(more * m.omega));
      return Vector6d(torques + onActuators(*solver, m, wrench));
    };
  });
}

struct LegPart {
  const char* name;
  void (*copy)(Leg& to, const Leg& from);
};

void copyCoefficients(JointFriction& to, const JointFriction& from) { to = from; }

template <class T>
void copyLinks(Leg& to, const Leg& from, T Link::*part) {
  to.proximal.*part = from.proximal.*part;
  to.distal.*part = from.distal.*part;
}

const std::array<LegPart, 11> parts{
    {{"base point", [](Leg& to, const Leg& from) { to.base_point = from.base_point; }},
     {"axis", [](Leg& to, const Leg& from) { to.base_axis = from.base_axis; }},
     {"platform point", [](Leg& to, const Leg& from) { to.platform_point = from.platform_point; }},
     {"lengths", [](Leg& to, const Leg& from) { copyLinks(to, from, &Link::length); }},
     {"masses", [](Leg& to, const Leg& from) { copyLinks(to, from, &Link::mass); }},
     {"mass centres", [](Leg& to, const Leg& from) { copyLinks(to, from, &Link::center_of_mass); }},
     {"inertias", [](Leg& to, const Leg& from) { copyLinks(to, from, &Link::inertia); }},
     {"viscous friction", [](Leg& to, const Leg& from) { to.friction = from.friction; }},
     {"Coulomb friction", [](Leg& to, const Leg& from) { copyCoefficients(to.coulomb, from.coulomb); }},
     {"smoothing speed", [](Leg& to, const Leg& from) { to.coulomb.smoothing_speed = from.coulomb.smoothing_speed; }},
     {"knee", [](Leg& to, const Leg& from) { to.knee = from.knee; }}}};

/// Leg i takes the part of leg from(i).
Defect mixUp(const std::string& name, const LegPart& part, const std::function<std::size_t(std::size_t)>& from) {
  return wrongMachine(name, "index", [part, from](P& m) {
    const auto right = m.legs;
    for (std::size_t i = 0; i < leg_count; ++i) part.copy(m.legs[i], right[from(i)]);
  });
}

}  // namespace

std::vector<Defect> indexDefects() {
  std::vector<Defect> out;
  for (const LegPart& part : parts) {
    out.push_back(mixUp(fmt::format("each leg's {} from its neighbour", part.name), part,
                        [](std::size_t i) { return (i + 1) % leg_count; }));
    out.push_back(
        mixUp(fmt::format("{} of leg 1 for all legs", part.name), part, [](std::size_t) { return std::size_t{0}; }));
    out.push_back(mixUp(fmt::format("{} of leg 4 for leg 5", part.name), part,
                        [](std::size_t i) { return i == 4 ? std::size_t{3} : i; }));
  }
  append(out, {wrongMachine("legs 2 and 5 swapped", "index", [](P& m) { std::swap(m.legs[1], m.legs[4]); }),
               wrongMachine("platform points 1 and 2 swapped", "index",
                            [](P& m) { std::swap(m.legs[0].platform_point, m.legs[1].platform_point); })});
  return out;
}

std::vector<Defect> parameterDefects() {
  std::vector<Defect> out;
  // One of each kind of parameter, on the leg where each kind is met first.
  for (const Parameter& parameter : allParameters(std::vector<LegKind>(leg_count, LegKind::URS))) {
    const bool of_other_leg = parameter.name.rfind("leg[", 0) == 0 && parameter.name.rfind("leg[2]", 0) != 0;
    if (of_other_leg) continue;
    out.push_back({fmt::format("{} off by {:g}", parameter.name, parameter_error), "parameter",
                   [parameter](const Scenario& s) { return disturbedSubject(s, parameter, parameter_error); }});
  }
  const auto machine = [](const char* name, const ChangeMachine& change) {
    return wrongMachine(name, "parameter", change);
  };
  append(out,
         {machine("wrong knee, leg 3",
                  [](P& m) { m.legs[2].knee = m.legs[2].knee == Knee::positive ? Knee::negative : Knee::positive; }),
          machine("gravity upside down", [](P& m) { m.gravity = -m.gravity; }),
          machine("gravity 9.80665 for 9.81", [](P& m) { m.gravity *= 9.80665 / 9.81; }),
          machine("platform lighter by 1e-9 of its mass", [](P& m) { m.platform.mass *= 1 - 1e-9; }),
          machine("leg 6 longer by 1e-10 of its length", [](P& m) { m.legs[5].distal.length *= 1 + 1e-10; }),
          machine("proximal and distal links exchanged, leg 1",
                  [](P& m) {
                    std::swap(m.legs[0].proximal.mass, m.legs[0].distal.mass);
                    std::swap(m.legs[0].proximal.inertia, m.legs[0].distal.inertia);
                  }),
          machine("axis of leg 4 reversed", [](P& m) { m.legs[3].base_axis = -m.legs[3].base_axis; })});
  return out;
}

std::vector<Defect> frameDefects() {
  const auto machine = [](const char* name, const ChangeMachine& change) {
    return wrongMachine(name, "frame", change);
  };
  const auto platform = [](P& m) -> Platform& { return m.platform; };
  return {
      machine("tensor of the proximal link about its joint, leg 5",
              [](P& m) { m.legs[4].proximal.inertia = aboutJoint(m.legs[4].proximal); }),
      machine("tensor of the distal link about its joint, leg 2",
              [](P& m) { m.legs[1].distal.inertia = aboutJoint(m.legs[1].distal); }),
      machine("tensor of the platform about P",
              [=](P& m) { platform(m).inertia += pointInertia(platform(m).mass, platform(m).center_of_mass); }),
      machine("tensor in axes turned by a quarter, proximal link of leg 4",
              [](P& m) { m.legs[3].proximal.inertia = quarterTurned(m.legs[3].proximal.inertia); }),
      machine("tensor in axes turned by a quarter, distal link of leg 4",
              [](P& m) { m.legs[3].distal.inertia = quarterTurned(m.legs[3].distal.inertia); }),
      machine("tensors in H for G and in G for H, leg 1",
              [](P& m) { std::swap(m.legs[0].proximal.inertia, m.legs[0].distal.inertia); }),
      machine(
          "mass centre of the distal link from its far end, leg 3",
          [](P& m) { m.legs[2].distal.center_of_mass = m.legs[2].distal.length - m.legs[2].distal.center_of_mass; }),
      machine("platform's frame at its mass centre", [=](P& m) { platform(m).center_of_mass.setZero(); }),
      machine("rho applied twice", [=](P& m) { platform(m).center_of_mass *= 2; }),
      machine("rho upside down", [=](P& m) { platform(m).center_of_mass.z() *= -1; }),
      machine("products of inertia with the other sign, platform",
              [=](P& m) {
                const Vector3d diagonal = platform(m).inertia.diagonal();
                platform(m).inertia *= -1;
                platform(m).inertia.diagonal() = diagonal;
              }),
      wrongPlatformTensor("tensor of the platform turned the wrong way",
                          [](const Matrix3d& I, const Matrix3d& Q) { return Matrix3d(Q.transpose() * I * Q); }),
      wrongPlatformTensor("tensor of the platform not turned", [](const Matrix3d& I, const Matrix3d&) { return I; })};
}

}  // namespace ursula
