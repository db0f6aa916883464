#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <memory>

#include "nocsolver/noc/noc.h"
#include "validation/subject/subject.h"

// The NOC as a subject, for each scalar and each derived NOC.

namespace ursula::noc_subject {

/// Many threads may call a subject.
template <class Workspace>
Workspace& workspace() {
  thread_local Workspace work;
  return work;
}

template <class S>
Motion<S> as(const Motion<double>& m) {
  return {S(m.t),
          m.p.cast<S>(),
          m.Q.cast<S>(),
          m.omega.cast<S>(),
          m.p_dot.cast<S>(),
          m.omega_dot.cast<S>(),
          m.p_ddot.cast<S>()};
}

template <class S>
JointVariables<double> inDoubles(const JointVariables<S>& q) {
  return {q.phi.template cast<double>(), q.psi.template cast<double>(), q.theta.template cast<double>(),
          q.d.template cast<double>()};
}

template <class S>
BodyMotion<double> inDoubles(const BodyMotion<S>& body) {
  return {body.c.template cast<double>(), body.R.template cast<double>(), body.twist.template cast<double>(),
          body.twist_rate.template cast<double>()};
}

template <class S>
KinematicAnswer kinematicsOf(const Noc<S>& solver, const Motion<double>& motion) {
  NocWorkspace<S>& work = workspace<NocWorkspace<S>>();
  const Motion<S> m = as<S>(motion);
  KinematicAnswer answer;
  solver.inverseKinematics(m, work);
  answer.joints = {inDoubles(solver.angles(work)), inDoubles(solver.rates(work)),
                   inDoubles(solver.accelerations(work))};
  solver.bodyMotions(m, work, work.bodies);
  std::transform(work.bodies.begin(), work.bodies.end(), answer.bodies.begin(),
                 [](const BodyMotion<S>& body) { return inDoubles(body); });
  solver.jacobians(m, work);
  answer.T = solver.platformShaping(work).template cast<double>();
  answer.T_rate = solver.platformShapingRate(m, work).template cast<double>();
  return answer;
}

template <class S>
using Solver = std::shared_ptr<const Noc<S>>;
template <class S>
using SolverOf = std::function<Solver<S>(const Manipulator&)>;

/// `make` gives the same solver for another machine.
template <class S>
Subject makeSubject(const char* name, const Solver<S>& solver, const std::shared_ptr<const Load>& load,
                    const SolverOf<S>& make) {
  using Work = NocWorkspace<S>;
  Subject subject;
  subject.name = name;
  subject.formulation = Formulation::noc;
  subject.torques = [solver, load](const Motion<double>& motion) {
    const Vector6<S> on_platform = loadAtP(load.get(), motion).cast<S>();
    return Vector6d(solver->inverseDynamics(as<S>(motion), workspace<Work>(), on_platform).template cast<double>());
  };
  subject.kinematics = [solver](const Motion<double>& motion) { return kinematicsOf(*solver, motion); };
  subject.accelerations = [solver, load](const Motion<double>& motion, const Vector6d& torques) {
    const Vector6<S> on_platform = loadAtP(load.get(), motion).cast<S>(), efforts = torques.cast<S>();
    return Vector6d(
        solver->directDynamics(as<S>(motion), efforts, workspace<Work>(), on_platform).template cast<double>());
  };
  subject.complement = [solver, load](const Motion<double>& motion) {
    Work& work = workspace<Work>();
    const Motion<S> m = as<S>(motion);
    solver->inverseDynamics(m, work, loadAtP(load.get(), motion).cast<S>());
    return Complement{solver->D(m, work).template cast<double>(), work.T.template cast<double>()};
  };
  subject.reactions = [solver, load](const Motion<double>& motion) {
    Work& work = workspace<Work>();
    const Motion<S> m = as<S>(motion);
    const Vector6<S> efforts = solver->inverseDynamics(m, work, loadAtP(load.get(), motion).cast<S>());
    return solver->reactions(m, efforts, work);
  };
  subject.rebuilt = [name, make](const Manipulator& other) { return makeSubject<S>(name, make(other), nullptr, make); };
  return subject;
}

template <class S>
Subject makeSubject(const char* name, const Manipulator& machine, const std::shared_ptr<const Load>& load,
                    const SolverOf<S>& make) {
  return makeSubject<S>(name, make(machine), load, make);
}

}  // namespace ursula::noc_subject
