#include "validation/defects.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "nocsolver/solver.h"

namespace ursula {
namespace {

using Torques = std::function<Vector6d(const Motion<double>&)>;
using ChangeMotion = std::function<Motion<double>(const Motion<double>&)>;
using ChangeMachine = std::function<void(ManipulatorParameters&)>;
using ChangeTorques = std::function<Vector6d(const Vector6d&)>;

/// Large against rounding, small against anything that a person would see in a plot.
constexpr double parameter_error = 1e-6;

Defect slip(const char* name, const char* group, Slip which) {
  return {name, group, [which](const Scenario& s) { return slippedSubject(*s.manipulator, s.load, WithSlips(which)); }};
}

Defect machine(const char* name, const ChangeMachine& change) {
  return {name, "parameter", [change](const Scenario& s) {
            ManipulatorParameters wrong = s.manipulator->parameters();
            change(wrong);
            return nocSubject(Manipulator(wrong), s.load);
          }};
}

/// The solver is told another motion than the one commanded.
Defect motion(const char* name, const ChangeMotion& change) {
  return {name, "motion", [change](const Scenario& s) {
            const Subject right = nocSubject(*s.manipulator, s.load);
            Subject wrong = right;
            wrong.torques = [right, change](const Motion<double>& m) { return right.torques(change(m)); };
            wrong.kinematics = [right, change](const Motion<double>& m) { return right.kinematics(change(m)); };
            wrong.rebuilt = nullptr;
            return wrong;
          }};
}

/// The torques alone are spoilt on their way out.
Defect torque(const char* name, const ChangeTorques& change) {
  return {name, "torque", [change](const Scenario& s) {
            Subject wrong = nocSubject(*s.manipulator, s.load);
            const Torques right = wrong.torques;
            wrong.torques = [right, change](const Motion<double>& m) { return change(right(m)); };
            wrong.rebuilt = nullptr;
            return wrong;
          }};
}

/// Torques of another instant of the motion.
Defect timed(const char* name, const std::function<double(double t, double sample)>& change) {
  return {name, "torque", [change](const Scenario& s) {
            Subject wrong = nocSubject(*s.manipulator, s.load);
            const Torques right = wrong.torques;
            const auto trajectory = s.trajectory;
            const double duration = trajectory->duration(), sample = duration / 300;
            wrong.torques = [=](const Motion<double>& m) {
              return right(trajectory->at(std::clamp(change(m.t, sample), 0.0, duration)));
            };
            wrong.rebuilt = nullptr;
            return wrong;
          }};
}

Defect singlePrecision() {
  return {"single precision", "torque", [](const Scenario& s) {
            Subject wrong = nocSubject(*s.manipulator, s.load);
            const auto load = s.load;
            const auto solver = std::make_shared<const Solver<float>>(*s.manipulator);
            wrong.torques = [solver, load](const Motion<double>& m) {
              Motion<float> single;
              single.t = static_cast<float>(m.t);
              single.p = m.p.cast<float>();
              single.Q = m.Q.cast<float>();
              single.omega = m.omega.cast<float>();
              single.p_dot = m.p_dot.cast<float>();
              single.omega_dot = m.omega_dot.cast<float>();
              single.p_ddot = m.p_ddot.cast<float>();
              Workspace<float> work;
              const Vector6<float> wrench = loadAtP(load.get(), m).cast<float>();
              return Vector6d(solver->inverseDynamics(single, work, wrench).cast<double>());
            };
            wrong.rebuilt = nullptr;
            return wrong;
          }};
}

Defect withoutLoad() {
  return {"load left out", "term", [](const Scenario& s) { return nocSubject(*s.manipulator, nullptr); }};
}

void addFormulas(std::vector<Defect>& out) {
  const std::vector<Defect> formulas = {slip("(2) as printed: frame without tilt", "formula", Slip::eq2),
                                        slip("(4c) as printed: q^2", "formula", Slip::eq4c),
                                        slip("(5) as printed: +a", "formula", Slip::eq5),
                                        slip("(14a) as printed: phi in [0, pi]", "formula", Slip::eq14a),
                                        slip("(14b) as printed: -k_y", "formula", Slip::eq14b),
                                        slip("(15a) as printed", "formula", Slip::eq15a),
                                        slip("(16) as printed: -omega", "formula", Slip::eq16),
                                        slip("(17) as printed: -omega_dot", "formula", Slip::eq17),
                                        slip("(19a) as printed", "formula", Slip::eq19a),
                                        slip("(19b) as printed", "formula", Slip::eq19b),
                                        slip("(23) as printed: a_ii", "formula", Slip::eq23),
                                        slip("(26) as printed: a_ii_dot", "formula", Slip::eq26_a_dot),
                                        slip("(26) as printed: B_dot", "formula", Slip::eq26_b_dot),
                                        slip("(43b) as printed: Omega_dot^2", "formula", Slip::eq43b_omega_dot),
                                        slip("(43b) as printed: sigma + s", "formula", Slip::eq43b_sigma),
                                        slip("(43b) as printed: doubled", "formula", Slip::eq43b_doubled),
                                        slip("(47) as in the text: Qb - rho", "formula", Slip::eq47)};
  out.insert(out.end(), formulas.begin(), formulas.end());
}

void addTerms(std::vector<Defect>& out) {
  const std::vector<Defect> terms = {slip("no centrifugal terms", "term", Slip::drop_centrifugal),
                                     slip("no Coriolis terms", "term", Slip::drop_coriolis),
                                     slip("no gyroscopic terms, links", "term", Slip::drop_gyroscopic_legs),
                                     slip("no gyroscopic terms, platform", "term", Slip::drop_gyroscopic_platform),
                                     slip("no centripetal term, platform", "term", Slip::drop_platform_centripetal),
                                     slip("no gravity on links", "term", Slip::drop_gravity_legs),
                                     slip("no gravity on platform", "term", Slip::drop_gravity_platform),
                                     slip("no friction", "term", Slip::drop_friction),
                                     slip("no coupling through the knee", "term", Slip::drop_link_coupling),
                                     withoutLoad()};
  out.insert(out.end(), terms.begin(), terms.end());
}

void addMachines(std::vector<Defect>& out) {
  using P = ManipulatorParameters;
  // One of each kind of parameter, on the leg where each kind is met first.
  for (const Parameter& parameter : allParameters()) {
    const bool of_other_leg = parameter.name.rfind("leg[", 0) == 0 && parameter.name.rfind("leg[2]", 0) != 0;
    if (of_other_leg) continue;
    out.push_back({fmt::format("{} off by {:g}", parameter.name, parameter_error), "parameter",
                   [parameter](const Scenario& s) { return disturbedSubject(s, parameter, parameter_error); }});
  }
  const std::vector<Defect> machines = {
      machine("wrong knee, leg 3",
              [](P& m) { m.legs[2].knee = m.legs[2].knee == Knee::positive ? Knee::negative : Knee::positive; }),
      machine("legs 2 and 5 swapped", [](P& m) { std::swap(m.legs[1], m.legs[4]); }),
      machine("platform points 1 and 2 swapped",
              [](P& m) { std::swap(m.legs[0].platform_point, m.legs[1].platform_point); }),
      machine("gravity upside down", [](P& m) { m.gravity = -m.gravity; }),
      machine("gravity 9.80665 for 9.81", [](P& m) { m.gravity *= 9.80665 / 9.81; }),
      machine("proximal and distal links exchanged, leg 1",
              [](P& m) {
                std::swap(m.legs[0].proximal.mass, m.legs[0].distal.mass);
                std::swap(m.legs[0].proximal.inertia, m.legs[0].distal.inertia);
              }),
      machine("axis of leg 4 reversed", [](P& m) { m.legs[3].base_axis = -m.legs[3].base_axis; })};
  out.insert(out.end(), machines.begin(), machines.end());
}

void addMotions(std::vector<Defect>& out) {
  using M = Motion<double>;
  const auto with = [](const std::function<void(M&)>& change) {
    return [change](const M& m) {
      M wrong = m;
      change(wrong);
      return wrong;
    };
  };
  const double degrees = 180 / 3.14159265358979323846;
  const std::vector<Defect> motions = {
      motion("Q transposed", with([](M& m) { m.Q.transposeInPlace(); })),
      motion("degrees for radians in omega", with([degrees](M& m) {
               m.omega *= degrees;
               m.omega_dot *= degrees;
             })),
      motion("omega in M for omega in B", with([](M& m) { m.omega = (m.Q.transpose() * m.omega).eval(); })),
      motion("omega_dot in M for omega_dot in B",
             with([](M& m) { m.omega_dot = (m.Q.transpose() * m.omega_dot).eval(); })),
      motion("velocities left out", with([](M& m) {
               m.omega.setZero();
               m.p_dot.setZero();
             })),
      motion("angular acceleration left out", with([](M& m) { m.omega_dot.setZero(); })),
      motion("acceleration of P left out", with([](M& m) { m.p_ddot.setZero(); })),
      motion("accelerations of C for those of P",
             with([](M& m) { m.p_ddot += m.omega_dot.cross(Vector3d(m.Q.col(2))); })),
      motion("p off by 1e-6 m", with([](M& m) { m.p.x() += 1e-6; }))};
  out.insert(out.end(), motions.begin(), motions.end());
}

void addTorques(std::vector<Defect>& out) {
  const std::vector<Defect> torques = {
      torque("sign of all torques", [](const Vector6d& tau) { return Vector6d(-tau); }),
      torque("sign of torque 3",
             [](Vector6d tau) {
               tau(2) = -tau(2);
               return tau;
             }),
      torque("torques 2 and 5 swapped",
             [](Vector6d tau) {
               std::swap(tau(1), tau(4));
               return tau;
             }),
      torque("columns of T permuted",
             [](const Vector6d& tau) {
               Vector6d out_of_order;
               for (int i = 0; i < leg_count; ++i) out_of_order((i + 1) % leg_count) = tau(i);
               return out_of_order;
             }),
      torque("torque 1 off by 1e-9 of itself",
             [](Vector6d tau) {
               tau(0) *= 1 + 1e-9;
               return tau;
             }),
      torque("torque 6 left out",
             [](Vector6d tau) {
               tau(5) = 0;
               return tau;
             }),
      torque("torques in kN m", [](const Vector6d& tau) { return Vector6d(tau / 1000); }),
      torque("torque 4 not a number",
             [](Vector6d tau) {
               tau(3) = std::nan("");
               return tau;
             }),
      timed("held constant between samples", [](double t, double sample) { return sample * std::floor(t / sample); }),
      timed("late by one sample", [](double t, double sample) { return t - sample; }),
      singlePrecision()};
  out.insert(out.end(), torques.begin(), torques.end());
}

}  // namespace

std::vector<Defect> allDefects() {
  std::vector<Defect> out;
  addFormulas(out);
  addTerms(out);
  addMachines(out);
  addMotions(out);
  addTorques(out);
  return out;
}

}  // namespace ursula
