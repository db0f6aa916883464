// Defects in the direct dynamics.

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "parts/fast/solver.h"
#include "parts/prove/defects.h"

namespace ursula {
namespace {

using Direct = std::function<Vector6d(const Motion<double>&, const Vector6d& torques)>;

Defect wrongDirect(const std::string& name, const std::function<Direct(const Scenario&, const Subject& right)>& make) {
  Defect out{name, "direct", [make](const Scenario& s) {
               const Subject right = nocSubject(*s.manipulator, s.load);
               Subject wrong = right;
               wrong.accelerations = make(s, right);
               return wrong;
             }};
  out.formulations_wanted = 1;
  return out;
}

/// Makes the mass matrix wrong, with the right forces.
Defect wrongMassMatrix(const char* name, const std::function<void(Matrix6d& M)>& change) {
  return wrongDirect(name, [change](const Scenario& s, const Subject& right) -> Direct {
    const auto solver = std::make_shared<const Solver<double>>(*s.manipulator);
    return [right, solver, change](const Motion<double>& m, const Vector6d& torques) {
      Workspace<double> work;
      solver->inverseKinematics(m, work);
      Matrix6d M = solver->massMatrixAtP(m, work);
      const Vector6d wrench = M * right.accelerations(m, torques);
      change(M);
      return Vector6d(M.partialPivLu().solve(wrench));
    };
  });
}

/// Takes the mass matrix of another machine.
Defect massMatrixOf(const std::string& name, const ChangeMachine& change) {
  return wrongDirect(name, [change](const Scenario& s, const Subject& right) -> Direct {
    const auto solver = std::make_shared<const Solver<double>>(*s.manipulator);
    const auto other = std::make_shared<const Solver<double>>(changedMachine(*s.manipulator, change));
    return [right, solver, other](const Motion<double>& m, const Vector6d& torques) {
      Workspace<double> work;
      solver->inverseKinematics(m, work);
      const Vector6d wrench = solver->massMatrixAtP(m, work) * right.accelerations(m, torques);
      return Vector6d(other->massMatrixAtP(m, work).partialPivLu().solve(wrench));
    };
  });
}

/// Takes the direct dynamics of another machine or load.
Defect directOf(const std::string& name, const std::function<Subject(const Scenario&)>& other) {
  return wrongDirect(name, [other](const Scenario& s, const Subject&) -> Direct { return other(s).accelerations; });
}

/// Uses another state than the requested one; `commanded` is the motion's at that instant.
Defect wrongState(const char* name, const std::function<void(Motion<double>& m, const Motion<double>& commanded)>& of) {
  return wrongDirect(name, [of](const Scenario& s, const Subject& right) -> Direct {
    return [right, trajectory = s.trajectory, of](const Motion<double>& m, const Vector6d& torques) {
      Motion<double> state = m;
      of(state, trajectory->at(m.t));
      return right.accelerations(state, torques);
    };
  });
}

std::vector<Defect> wrongMassMatrices(const Manipulator& machine) {
  using P = ManipulatorParameters;
  const std::size_t third = legOf(machine, 3), fifth = legOf(machine, 5);
  // A carriage does not turn, so its tensor has no effect.
  const bool turns = !rowOf(machine.parameters().legs[fifth].kind).hasCarriage();
  return {wrongMassMatrix("mass matrix off by 1e-8 in one entry", [](Matrix6d& M) { M(1, 1) *= 1 + 1e-8; }),
          wrongMassMatrix("mass matrix off by 1e-9 of itself", [](Matrix6d& M) { M *= 1 + 1e-9; }),
          wrongMassMatrix("mass matrix not symmetric by 1e-8", [](Matrix6d& M) { M(0, 4) += 1e-8 * M.norm(); }),
          wrongMassMatrix("mass matrix without its products between turn and shift, by 1e-7",
                          [](Matrix6d& M) {
                            M.topRightCorner<3, 3>() *= 1 - 1e-7;
                            M.bottomLeftCorner<3, 3>() *= 1 - 1e-7;
                          }),
          massMatrixOf("mass matrix without the mass of leg 3's distal link",
                       [third](P& m) { m.legs[third].distal.mass = 1e-9; }),
          massMatrixOf(fmt::format("mass matrix with leg {}'s tensors 1e-6 too large", fifth + 1),
                       [=](P& m) { (turns ? m.legs[fifth].proximal : m.legs[fifth].distal).inertia *= 1 + 1e-6; }),
          massMatrixOf("mass matrix about the mass centre by 1e-8 of the way",
                       [](P& m) { m.platform.center_of_mass *= 1 - 1e-8; })};
}

/// Omits 1e-8 of the effect of what `part` removes from the state.
Defect withoutPart(const char* name, double share, const std::function<void(Motion<double>&)>& part) {
  return wrongDirect(name, [share, part](const Scenario&, const Subject& right) -> Direct {
    return [right, share, part](const Motion<double>& m, const Vector6d& torques) {
      Motion<double> without = m;
      part(without);
      const Vector6d all = right.accelerations(m, torques);
      return Vector6d(all - share * (all - right.accelerations(without, torques)));
    };
  });
}

void withoutFriction(ManipulatorParameters& machine) {
  for (Leg& leg : machine.legs) {
    leg.friction = {};
    leg.coulomb = {};
  }
}

std::vector<Defect> wrongForces() {
  using P = ManipulatorParameters;
  const auto machine = [](const char* name, const ChangeMachine& change) {
    return directOf(name,
                    [change](const Scenario& s) { return nocSubject(changedMachine(*s.manipulator, change), s.load); });
  };
  return {withoutPart("direct dynamics: 1e-8 of the velocities' part left out", 1e-8,
                      [](Motion<double>& m) {
                        m.omega.setZero();
                        m.p_dot.setZero();
                      }),
          wrongDirect("direct dynamics: sign of the friction",
                      [](const Scenario& s, const Subject& right) -> Direct {
                        const Subject smooth = nocSubject(changedMachine(*s.manipulator, withoutFriction), s.load);
                        return [right, smooth](const Motion<double>& m, const Vector6d& torques) {
                          const Vector6d friction = right.torques(m) - smooth.torques(m);
                          return right.accelerations(m, torques + 2 * friction);
                        };
                      }),
          machine("direct dynamics: gravity off by 1e-9", [](P& m) { m.gravity *= 1 + 1e-9; }),
          machine("direct dynamics: leg 2's base point off by 1e-9 m", [](P& m) { m.legs[1].base_point.x() += 1e-9; }),
          directOf("direct dynamics: no load", [](const Scenario& s) { return nocSubject(*s.manipulator, nullptr); }),
          wrongDirect("direct dynamics: torques 3 and 4 swapped", [](const Scenario&, const Subject& right) -> Direct {
            return [right](const Motion<double>& m, Vector6d torques) {
              std::swap(torques(2), torques(3));
              return right.accelerations(m, torques);
            };
          })};
}

std::vector<Defect> wrongStates() {
  using M = Motion<double>;
  return {wrongState("direct dynamics at the commanded pose",
                     [](M& m, const M& commanded) {
                       m.p = commanded.p;
                       m.Q = commanded.Q;
                     }),
          wrongState("direct dynamics at the commanded height",
                     [](M& m, const M& commanded) { m.p.z() = commanded.p.z(); }),
          wrongState("direct dynamics at the commanded velocity",
                     [](M& m, const M& commanded) {
                       m.omega = commanded.omega;
                       m.p_dot = commanded.p_dot;
                     }),
          wrongState("direct dynamics at a state by 3e-5 nearer to the commanded one",
                     [](M& m, const M& commanded) { m.p += 3e-5 * (commanded.p - m.p); })};
}

}  // namespace

std::vector<Defect> directDefects(const Manipulator& machine) {
  std::vector<Defect> out = wrongMassMatrices(machine);
  append(out, wrongForces());
  append(out, wrongStates());
  append(out, {control(wrongMassMatrix("mass matrix: no fault", [](Matrix6d&) {})),
               control(massMatrixOf("mass matrix of another machine: no fault", [](ManipulatorParameters&) {})),
               control(wrongState("state: no fault", [](Motion<double>&, const Motion<double>&) {}))});
  return out;
}

}  // namespace ursula
