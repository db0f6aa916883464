#include "parts/prove/defects.h"

#include <algorithm>
#include <iterator>

namespace ursula {

Manipulator changedMachine(const Manipulator& machine, const ChangeMachine& change) {
  ManipulatorParameters parameters = machine.parameters();
  change(parameters);
  return Manipulator(parameters);
}

Defect control(Defect without_defect) {
  without_defect.group = "control";
  without_defect.control = true;
  return without_defect;
}

Defect wrongMachine(const std::string& name, const std::string& group, const ChangeMachine& change) {
  return {name, group, [change](const Scenario& s) {
            Subject wrong = nocSubject(changedMachine(*s.manipulator, change), s.load);
            wrong.rebuilt = [change](const Manipulator& other) {
              return nocSubject(changedMachine(other, change), nullptr);
            };
            return wrong;
          }};
}

Defect wrongMotion(const std::string& name, const ChangeMotion& change) {
  return {name, "motion", [change](const Scenario& s) {
            const Subject right = nocSubject(*s.manipulator, s.load);
            const auto changed = [change](Motion<double> motion) {
              change(motion);
              return motion;
            };
            Subject wrong = right;
            wrong.torques = [right, changed](const Motion<double>& m) { return right.torques(changed(m)); };
            wrong.kinematics = [right, changed](const Motion<double>& m) { return right.kinematics(changed(m)); };
            wrong.rebuilt = nullptr;
            return wrong;
          }};
}

Defect wrongTorques(const std::string& name, const std::string& group,
                    const std::function<ChangeTorques(const Scenario&)>& change) {
  return {name, group, [change](const Scenario& s) {
            Subject wrong = nocSubject(*s.manipulator, s.load);
            const auto right = wrong.torques;
            const ChangeTorques changed = change(s);
            wrong.torques = [right, changed](const Motion<double>& m) { return changed(right(m), m); };
            wrong.rebuilt = nullptr;
            return wrong;
          }};
}

namespace {

Matrix6d shaping(const Solver<double>& solver, const Motion<double>& motion, Workspace<double>& work) {
  solver.inverseKinematics(motion, work);
  solver.jacobians(motion, work);
  return solver.T(work);
}

}  // namespace

Vector6d onActuators(const Solver<double>& solver, const Motion<double>& motion, const JointVariables<double>& forces) {
  Workspace<double> work;
  const Matrix6d T = shaping(solver, motion, work);
  Motion<double> unit = motion;
  Vector6d torques;
  for (int k = 0; k < motor_count; ++k) {
    unit.omega = T.col(k).head<3>();
    unit.p_dot = T.col(k).tail<3>();
    solver.inverseKinematics(unit, work);
    const JointVariables<double> rates = solver.rates(work);
    torques(k) =
        forces.phi.dot(rates.phi) + forces.psi.dot(rates.psi) + forces.theta.dot(rates.theta) + forces.d.dot(rates.d);
  }
  return torques;
}

Vector6d onActuators(const Solver<double>& solver, const Motion<double>& motion, const Vector6d& wrench) {
  Workspace<double> work;
  return shaping(solver, motion, work).transpose() * wrench;
}

Pulse::Pulse(const Trajectory& trajectory, double share)
    : from(share * trajectory.duration()), to(from + trajectory.duration() / 3000) {}

void append(std::vector<Defect>& to, std::vector<Defect> more) {
  to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

std::size_t otherLeg(const Manipulator& machine, int number, std::size_t than) {
  const std::size_t leg = legOf(machine, number);
  return leg != than ? leg : (than + 1) % machine.parameters().legs.size();
}

std::vector<LegKind> kindsOf(const Manipulator& machine) {
  std::vector<LegKind> kinds;
  for (const Leg& leg : machine.parameters().legs)
    if (std::find(kinds.begin(), kinds.end(), leg.kind) == kinds.end()) kinds.push_back(leg.kind);
  return kinds;
}

std::vector<Defect> allDefects(const Manipulator& machine) {
  std::vector<Defect> out;
  for (const auto& group : {formulaDefects, legDefects, fastDefects, parameterDefects, indexDefects, frameDefects,
                            frictionDefects, motionDefects, torqueDefects, branchDefects, kinematicDefects,
                            directDefects, hiddenDefects, sharedMotionDefects, sharedLoadDefects, experimentDefects})
    append(out, group(machine));
  return out;
}

}  // namespace ursula
