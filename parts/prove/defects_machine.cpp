// This file has defects in the numbers of the machine: each kind of parameter, exchanged legs, tensors in other frames.
// It also has defects in which the solver gets another motion than the commanded one.

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "base/scalar.h"
#include "parts/prove/defects.h"
#include "validation/subject/body_terms.h"

namespace ursula {
namespace {

using P = ManipulatorParameters;

/// This is large relative to rounding, but invisible in a plot.
constexpr double parameter_error = 1e-6;

Matrix3d aboutJoint(const Link& link) {
  return link.inertia + pointInertia(link.mass, link.center_of_mass * Vector3d::UnitZ());
}

/// Returns the tensor as if the link's axes [x, axis × x, axis] were turned by a quarter about the axis.
Matrix3d quarterTurned(const Matrix3d& inertia) {
  Matrix3d turn;
  turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  return turn * inertia * turn.transpose();
}

/// Makes the platform's tensor wrong by an amount that depends on the orientation, by adding the moment of the error.
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

/// Copies the coefficients alone; Coulomb friction has smoothing speeds as well.
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
     {"smoothing speed",
      [](Leg& to, const Leg& from) {
        to.coulomb.smoothing_speed = from.coulomb.smoothing_speed;
        to.coulomb.sliding_speed = from.coulomb.sliding_speed;
      }},
     {"knee", [](Leg& to, const Leg& from) { to.knee = from.knee; }}}};

/// Returns the legs with two knee branches, 0-based.
std::vector<std::size_t> kneesOf(const Manipulator& machine) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < machine.parameters().legs.size(); ++i)
    if (rowOf(machine.parameters().legs[i].kind).knee != nullptr) out.push_back(i);
  return out;
}

/// Returns one leg of each kind, the second one if there are two.
std::vector<int> legsMet(const Manipulator& machine) {
  std::vector<int> out;
  for (const LegKind kind : kindsOf(machine)) {
    int last = 0, met = 0;
    for (int i = 0; i < machine.legCount() && met < 2; ++i)
      if (machine.leg(i).kind == kind) last = i, ++met;
    out.push_back(last);
  }
  return out;
}

/// Gives leg i the part of leg from(i).
Defect mixUp(const std::string& name, const LegPart& part, const std::function<std::size_t(std::size_t)>& from) {
  return wrongMachine(name, "index", [part, from](P& m) {
    const auto right = m.legs;
    for (std::size_t i = 0; i < right.size(); ++i) part.copy(m.legs[i], right[from(i)]);
  });
}

Defect wrongKnee(std::size_t leg) {
  return wrongMachine(fmt::format("wrong knee, leg {}", leg + 1), "parameter", [leg](P& m) {
    m.legs[leg].knee = m.legs[leg].knee == Knee::positive ? Knee::negative : Knee::positive;
  });
}

/// Returns the defects of legs with cylinder and rod.
std::vector<Defect> wrongTelescopes(const Manipulator& machine) {
  const std::vector<LegKind> kinds = kindsOf(machine);
  if (std::find(kinds.begin(), kinds.end(), LegKind::UPS) == kinds.end()) return {};
  const auto telescopes = [](const std::string& name, void (*change)(Leg&)) {
    return wrongMachine(name, "parameter", [change](P& m) {
      for (Leg& leg : m.legs)
        if (rowOf(leg.kind).isTelescopic()) change(leg);
    });
  };
  return {telescopes("cylinder for rod and rod for cylinder", [](Leg& leg) { std::swap(leg.proximal, leg.distal); }),
          telescopes("cylinder's mass centre from its far end",
                     [](Leg& leg) { leg.proximal.center_of_mass = leg.proximal.length - leg.proximal.center_of_mass; }),
          telescopes("rod's mass centre from B",
                     [](Leg& leg) { leg.distal.center_of_mass = leg.distal.length - leg.distal.center_of_mass; }),
          telescopes("rod longer by 1e-6 of its length", [](Leg& leg) { leg.distal.length *= 1 + 1e-6; }),
          telescopes("stroke of a tenth of the cylinder", [](Leg& leg) { leg.proximal.length *= 0.1; })};
}

std::vector<Defect> largerErrors(const Manipulator& machine) {
  const auto named = [](const std::string& name, const ChangeMachine& change) {
    return wrongMachine(name, "parameter", change);
  };
  const std::size_t fourth = legOf(machine, 4), sixth = legOf(machine, 6);
  const double longer = machine.isOfThePaper() ? 1e-10 : 1e-8;
  std::vector<Defect> out;
  const std::vector<std::size_t> knees = kneesOf(machine);
  if (!knees.empty()) out.push_back(wrongKnee(knees[std::min<std::size_t>(2, knees.size() - 1)]));
  append(out,
         {named("gravity upside down", [](P& m) { m.gravity = -m.gravity; }),
          named("gravity 9.80665 for 9.81", [](P& m) { m.gravity *= 9.80665 / 9.81; }),
          named("platform lighter by 1e-9 of its mass", [](P& m) { m.platform.mass *= 1 - 1e-9; }),
          named(fmt::format("leg {} longer by {} of its length", sixth + 1, machine.isOfThePaper() ? "1e-10" : "1e-8"),
                [=](P& m) { m.legs[sixth].distal.length *= 1 + longer; }),
          named("proximal and distal links exchanged, leg 1",
                [](P& m) {
                  std::swap(m.legs[0].proximal.mass, m.legs[0].distal.mass);
                  std::swap(m.legs[0].proximal.inertia, m.legs[0].distal.inertia);
                }),
          named(fmt::format("axis of leg {} reversed", fourth + 1),
                [=](P& m) { m.legs[fourth].base_axis = -m.legs[fourth].base_axis; })});
  append(out, wrongTelescopes(machine));
  return out;
}

}  // namespace

std::vector<Defect> indexDefects(const Manipulator& machine) {
  std::vector<Defect> out;
  const std::size_t count = machine.parameters().legs.size(), fifth = std::min<std::size_t>(4, count - 1);
  for (const LegPart& part : parts) {
    if (part.name == std::string("knee") && kneesOf(machine).empty()) continue;
    out.push_back(mixUp(fmt::format("each leg's {} from its neighbour", part.name), part,
                        [count](std::size_t i) { return (i + 1) % count; }));
    out.push_back(
        mixUp(fmt::format("{} of leg 1 for all legs", part.name), part, [](std::size_t) { return std::size_t{0}; }));
    out.push_back(mixUp(fmt::format("{} of leg {} for leg {}", part.name, fifth, fifth + 1), part,
                        [fifth](std::size_t i) { return i == fifth ? fifth - 1 : i; }));
  }
  append(out, {wrongMachine(fmt::format("legs 2 and {} swapped", fifth + 1), "index",
                            [fifth](P& m) { std::swap(m.legs[1], m.legs[fifth]); }),
               wrongMachine("platform points 1 and 2 swapped", "index",
                            [](P& m) { std::swap(m.legs[0].platform_point, m.legs[1].platform_point); })});
  return out;
}

std::vector<Defect> parameterDefects(const Manipulator& machine) {
  std::vector<Defect> out;
  const std::vector<int> legs = legsMet(machine);
  for (const Parameter& parameter : allParameters(machine)) {
    if (parameter.leg >= 0 && std::find(legs.begin(), legs.end(), parameter.leg) == legs.end()) continue;
    out.push_back({fmt::format("{} off by {:g}", parameter.path, parameter_error), "parameter",
                   [parameter](const Scenario& s) { return disturbedSubject(s, parameter, parameter_error); }});
  }
  append(out, largerErrors(machine));
  return out;
}

std::vector<Defect> frameDefects(const Manipulator& of) {
  const auto machine = [](const std::string& name, const ChangeMachine& change) {
    return wrongMachine(name, "frame", change);
  };
  const std::size_t first = 0, second = legOf(of, 2), third = legOf(of, 3), fourth = legOf(of, 4), fifth = legOf(of, 5);
  const auto platform = [](P& m) -> Platform& { return m.platform; };
  return {
      machine(fmt::format("tensor of the proximal link about its joint, leg {}", fifth + 1),
              [=](P& m) { m.legs[fifth].proximal.inertia = aboutJoint(m.legs[fifth].proximal); }),
      machine("tensor of the distal link about its joint, leg 2",
              [=](P& m) { m.legs[second].distal.inertia = aboutJoint(m.legs[second].distal); }),
      machine("tensor of the platform about P",
              [=](P& m) { platform(m).inertia += pointInertia(platform(m).mass, platform(m).center_of_mass); }),
      machine(fmt::format("tensor in axes turned by a quarter, proximal link of leg {}", fourth + 1),
              [=](P& m) { m.legs[fourth].proximal.inertia = quarterTurned(m.legs[fourth].proximal.inertia); }),
      machine(fmt::format("tensor in axes turned by a quarter, distal link of leg {}", fourth + 1),
              [=](P& m) { m.legs[fourth].distal.inertia = quarterTurned(m.legs[fourth].distal.inertia); }),
      machine("tensors in H for G and in G for H, leg 1",
              [=](P& m) { std::swap(m.legs[first].proximal.inertia, m.legs[first].distal.inertia); }),
      machine("mass centre of the distal link from its far end, leg 3",
              [=](P& m) {
                m.legs[third].distal.center_of_mass = m.legs[third].distal.length - m.legs[third].distal.center_of_mass;
              }),
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
      wrongPlatformTensor("tensor of the platform not turned", [](const Matrix3d& I, const Matrix3d&) { return I; }),
      control(machine("machine: no fault", [](P&) {})),
      control(wrongPlatformTensor(
          "tensor: no fault", [](const Matrix3d& I, const Matrix3d& Q) { return Matrix3d(Q * I * Q.transpose()); }))};
}

std::vector<Defect> motionDefects(const Manipulator&) {
  using M = Motion<double>;
  return {
      wrongMotion("Q transposed", [](M& m) { m.Q.transposeInPlace(); }),
      wrongMotion("degrees for radians in omega",
                  [](M& m) {
                    m.omega *= degrees_per_radian;
                    m.omega_dot *= degrees_per_radian;
                  }),
      wrongMotion("omega in M for omega in B", [](M& m) { m.omega = (m.Q.transpose() * m.omega).eval(); }),
      wrongMotion("omega_dot in M for omega_dot in B",
                  [](M& m) { m.omega_dot = (m.Q.transpose() * m.omega_dot).eval(); }),
      wrongMotion("velocities left out",
                  [](M& m) {
                    m.omega.setZero();
                    m.p_dot.setZero();
                  }),
      wrongMotion("angular acceleration left out", [](M& m) { m.omega_dot.setZero(); }),
      wrongMotion("acceleration of P left out", [](M& m) { m.p_ddot.setZero(); }),
      wrongMotion("accelerations of C for those of P",
                  [](M& m) { m.p_ddot += m.omega_dot.cross(Vector3d(m.Q.col(2))); }),
      wrongMotion("p off by 1e-6 m", [](M& m) { m.p.x() += 1e-6; }),
      wrongMotion("p off by 1e-10 m", [](M& m) { m.p.y() += 1e-10; }),
      wrongMotion("Q turned by 1e-10", [](M& m) { m.Q = (Eigen::AngleAxisd(1e-10, Vector3d::UnitY()) * m.Q).eval(); }),
      wrongMotion("omega off by 1e-8 of itself", [](M& m) { m.omega *= 1 + 1e-8; }),
      wrongMotion("acceleration of P off by 1e-9 of itself", [](M& m) { m.p_ddot *= 1 + 1e-9; }),
      control(wrongMotion("motion: no fault", [](M&) {}))};
}

}  // namespace ursula
