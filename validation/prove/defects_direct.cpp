// Wrong in what the solver says beside its torques on this motion: kinematics, direct dynamics, and torques that only
// another machine or another motion would show.

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

#include "nocsolver/solver.h"
#include "validation/prove/defects_kit.h"

namespace ursula {
namespace {

Defect wrongKinematics(const char* name, const std::function<void(KinematicAnswer&)>& change) {
  Defect out{name, "kinematics", [change](const Scenario& s) {
               const Subject right = nocSubject(*s.manipulator, s.load);
               Subject wrong = right;
               wrong.kinematics = [right, change](const Motion<double>& m) {
                 KinematicAnswer answer = right.kinematics(m);
                 change(answer);
                 return answer;
               };
               return wrong;
             }};
  out.roads = 1;
  return out;
}

/// Ṫ wrong only for joint rates across those of the motion: no product with them shows it.
void spoilAcrossMotion(KinematicAnswer& answer) {
  const Vector6d& rate = answer.joints.q_dot.phi;
  const double size = rate.squaredNorm();
  Matrix6d across = Matrix6d::Identity();
  if (size > 0) across -= rate * rate.transpose() / size;
  answer.T_rate *= Matrix6d::Identity() + 1e-6 * across;
}

using Direct = std::function<Vector6d(const Motion<double>&, const Vector6d& torques)>;

Defect wrongDirect(const char* name, const std::function<Direct(const Scenario&, const Subject& right)>& make) {
  Defect out{name, "direct", [make](const Scenario& s) {
               const Subject right = nocSubject(*s.manipulator, s.load);
               Subject wrong = right;
               wrong.accelerations = make(s, right);
               return wrong;
             }};
  out.roads = 1;
  return out;
}

/// Another mass matrix under the same forces.
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

/// The mass matrix of another machine.
Defect massMatrixOf(const char* name, const ChangeMachine& change) {
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

/// The direct dynamics of another machine or load.
Defect directOf(const char* name, const std::function<Subject(const Scenario&)>& other) {
  return wrongDirect(name, [other](const Scenario& s, const Subject&) -> Direct { return other(s).accelerations; });
}

/// The state is not the one asked for; `commanded` is the motion's at that instant.
Defect wrongState(const char* name, const std::function<void(Motion<double>& m, const Motion<double>& commanded)>& of) {
  return wrongDirect(name, [of](const Scenario& s, const Subject& right) -> Direct {
    return [right, trajectory = s.trajectory, of](const Motion<double>& m, const Vector6d& torques) {
      Motion<double> state = m;
      of(state, trajectory->at(m.t));
      return right.accelerations(state, torques);
    };
  });
}

std::vector<Defect> wrongMassMatrices() {
  using P = ManipulatorParameters;
  return {
      wrongMassMatrix("mass matrix off by 1e-8 in one entry", [](Matrix6d& M) { M(1, 1) *= 1 + 1e-8; }),
      wrongMassMatrix("mass matrix off by 1e-9 of itself", [](Matrix6d& M) { M *= 1 + 1e-9; }),
      wrongMassMatrix("mass matrix not symmetric by 1e-8", [](Matrix6d& M) { M(0, 4) += 1e-8 * M.norm(); }),
      wrongMassMatrix("mass matrix without its products between turn and shift, by 1e-7",
                      [](Matrix6d& M) {
                        M.topRightCorner<3, 3>() *= 1 - 1e-7;
                        M.bottomLeftCorner<3, 3>() *= 1 - 1e-7;
                      }),
      massMatrixOf("mass matrix without the mass of leg 3's distal link", [](P& m) { m.legs[2].distal.mass = 1e-9; }),
      massMatrixOf("mass matrix with leg 5's tensors 1e-6 too large",
                   [](P& m) { m.legs[4].proximal.inertia *= 1 + 1e-6; }),
      massMatrixOf("mass matrix about the mass centre by 1e-8 of the way",
                   [](P& m) { m.platform.center_of_mass *= 1 - 1e-8; })};
}

/// 1e-8 of what `part` leaves out of the state is left out.
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

/// What a machine or a motion must be like for the solver to be wrong.
using Wrong = std::function<bool(const Manipulator&, const Motion<double>&)>;

Subject wrongWhere(const Manipulator& machine, const std::shared_ptr<const Load>& load, const Wrong& wrong) {
  const Subject right = nocSubject(machine, load);
  Subject out = right;
  out.torques = [right, machine, wrong](const Motion<double>& m) {
    return Vector6d((wrong(machine, m) ? 1 + 1e-8 : 1) * right.torques(m));
  };
  out.rebuilt = [wrong](const Manipulator& other) { return wrongWhere(other, nullptr, wrong); };
  return out;
}

Defect hidden(const char* name, const std::function<Wrong(const Scenario&)>& make) {
  Defect out{name, "hidden", [make](const Scenario& s) { return wrongWhere(*s.manipulator, s.load, make(s)); }};
  out.roads = 1;
  return out;
}

Defect hiddenMachine(const char* name, bool (*wrong)(const Manipulator&)) {
  return hidden(name, [wrong](const Scenario&) -> Wrong {
    return [wrong](const Manipulator& machine, const Motion<double>&) { return wrong(machine); };
  });
}

/// P moves up or down at a speed that the commanded motion does not have, but backwards would.
Wrong beyondSpeeds(const Scenario& s) {
  double low = 0, high = 0;
  constexpr int instants = 6000;
  for (int k = 0; k <= instants; ++k) {
    const double speed = s.trajectory->at(s.trajectory->duration() * k / instants).p_dot.z();
    low = std::min(low, speed);
    high = std::max(high, speed);
  }
  const double margin = 1e-3 * (high - low);
  return [=](const Manipulator&, const Motion<double>& m) {
    return high > -low ? m.p_dot.z() < low - margin : m.p_dot.z() > high + margin;
  };
}

}  // namespace

std::vector<Defect> kinematicDefects() {
  using K = KinematicAnswer;
  return {
      wrongKinematics("psi of leg 3 off by 1e-10", [](K& k) { k.joints.q.psi(2) += 1e-10; }),
      wrongKinematics("knee's rate off by 1e-9 of itself, leg 5", [](K& k) { k.joints.q_dot.theta(4) *= 1 + 1e-9; }),
      wrongKinematics("motor's acceleration off by 1e-9 of itself, leg 1",
                      [](K& k) { k.joints.q_ddot.phi(0) *= 1 + 1e-9; }),
      wrongKinematics("mass centre of a distal link off by 1e-10 m", [](K& k) { k.bodies[9].c.z() += 1e-10; }),
      wrongKinematics("orientation of a proximal link off by 1e-10",
                      [](K& k) { k.bodies[4].R = Eigen::AngleAxisd(1e-10, Vector3d::UnitX()) * k.bodies[4].R; }),
      wrongKinematics("spin of a proximal link off by 1e-9 of itself",
                      [](K& k) { k.bodies[1].twist.head<3>() *= 1 + 1e-9; }),
      wrongKinematics("velocity of a distal link off by 1e-9 of itself",
                      [](K& k) { k.bodies[6].twist.tail<3>() *= 1 + 1e-9; }),
      wrongKinematics("acceleration of the platform's mass centre off by 1e-9 of itself",
                      [](K& k) { k.bodies[12].twist_rate.tail<3>() *= 1 + 1e-9; }),
      wrongKinematics("links of legs 3 and 4 exchanged", [](K& k) { std::swap(k.bodies[2], k.bodies[3]); }),
      wrongKinematics("T off by 1e-9 of itself", [](K& k) { k.T *= 1 + 1e-9; }),
      wrongKinematics("T_dot off by 1e-8 of itself", [](K& k) { k.T_rate *= 1 + 1e-8; }),
      wrongKinematics("T_dot off by 1e-6 of itself, but for the rates of the motion", spoilAcrossMotion)};
}

std::vector<Defect> directDefects() {
  std::vector<Defect> out = wrongMassMatrices();
  append(out, wrongForces());
  append(out, wrongStates());
  return out;
}

std::vector<Defect> hiddenDefects() {
  return {hiddenMachine("wrong where the base is tilted by more than 20 degrees",
                        [](const Manipulator& m) { return -m.gravity().z() < 0.94 * m.gravity().norm(); }),
          hiddenMachine("wrong where leg 1 has its knee the other way",
                        [](const Manipulator& m) { return m.leg(0).knee == Knee::negative; }),
          hiddenMachine("wrong where leg 1 is longer than 1.42 m",
                        [](const Manipulator& m) { return m.leg(0).proximal.length > 1.42; }),
          hiddenMachine("wrong where the platform is heavier than 600 kg",
                        [](const Manipulator& m) { return m.platform().mass > 600; }),
          hiddenMachine("wrong where nothing rubs", [](const Manipulator& m) { return m.leg(0).friction.theta == 0; }),
          hidden("wrong at speeds that only the way back has", beyondSpeeds)};
}

}  // namespace ursula
