#include <algorithm>
#include <numeric>

#include "model/instants.h"
#include "validation/mechanism/mechanism_evidence.h"

namespace ursula {
namespace {

/// Moves and scales all that a machine is made of: x becomes scale·(R x + shift).
void transform(const Matrix3d& R, const Vector3d& shift, double scale, MechanismParameters& machine) {
  const auto point = [&](Vector3d& x) { x = (scale * (R * x + shift)).eval(); };
  const auto turned = [&](Matrix3d& I) { I = (R * I * R.transpose()).eval(); };
  for (MechanismBody& body : machine.bodies) {
    point(body.center_of_mass);
    turned(body.inertia);
    Vector3d origin = body.frame.translation();
    point(origin);
    body.frame.translation() = origin;
    body.frame.linear() = (R * body.frame.linear()).eval();
  }
  for (MechanismJoint& joint : machine.joints) {
    point(joint.centre);
    point(joint.centre_of_child);
    if (joint.turn != Matrix3d::Identity()) turned(joint.turn);  // a closed joint stays closed to the last bit
    for (Vector3d& axis : joint.axis) axis = (R * axis).eval();
  }
  machine.gravity = (scale * (R * machine.gravity)).eval();
  for (Eigen::Isometry3d& start : machine.start) {
    const Matrix3d turn = R * start.linear() * R.transpose();
    start.translation() = (scale * (R * start.translation() + shift - turn * shift)).eval();
    start.linear() = turn;
  }
}

/// Multiplies what acts along joints by factors of force and time, each slide also by those of length.
void scaleLoads(double mass, double length, double time, MechanismParameters& machine) {
  for (MechanismJoint& joint : machine.joints) {
    const bool slides = joint.slides();
    const double own = slides ? length : 1;                              // of its coordinate
    const double effort = mass * length * length / (time * time) / own;  // of its effort
    joint.position *= own;
    joint.spring_reference *= own;
    joint.damping *= effort * time / own;
    joint.friction *= effort;
    joint.smoothing_speed = joint.smoothing() * own / time;
    joint.rotor_inertia *= effort * time * time / own;
    joint.stiffness *= effort / own;
  }
}

ChangedMechanism same(const Mechanism& mechanism, const char* check) {
  ChangedMechanism out;
  const auto n = static_cast<Eigen::Index>(mechanism.motorCount());
  out.check = check;
  out.machine = mechanism.parameters();
  out.back = MotorEfforts::Ones(n);
  out.coordinates = MotorEfforts::Ones(n);
  out.motor_of.resize(mechanism.motorCount());
  std::iota(out.motor_of.begin(), out.motor_of.end(), std::size_t{0});
  return out;
}

ChangedMechanism inUnits(const Mechanism& mechanism) {
  constexpr double length = 0.3048, mass = 14.59, time = 0.7;
  ChangedMechanism out = same(mechanism, "invariance.units");
  transform(Matrix3d::Identity(), Vector3d::Zero(), length, out.machine);
  out.machine.gravity /= time * time;
  for (MechanismBody& body : out.machine.bodies) {
    body.mass *= mass;
    body.inertia *= mass * length * length;
    body.inertia_rounding *= mass * length * length;
  }
  scaleLoads(mass, length, time, out.machine);
  out.time = time;
  for (std::size_t k = 0; k < mechanism.motorCount(); ++k) {
    const double own = mechanism.motor(k).slides() ? length : 1;
    out.coordinates(static_cast<Eigen::Index>(k)) = own;
    out.back(static_cast<Eigen::Index>(k)) = time * time / (mass * length * length) * own;
  }
  return out;
}

/// Other motors first, other joints first, and no hint which joint the file closes its loops with.
ChangedMechanism relabelled(const Mechanism& mechanism) {
  ChangedMechanism out = same(mechanism, "invariance.labels");
  MechanismParameters& machine = out.machine;
  const std::size_t n = mechanism.motorCount(), bodies = machine.bodies.size();
  for (std::size_t k = 0; k < n; ++k) {
    out.motor_of[k] = n - 1 - k;
    machine.motors[n - 1 - k] = mechanism.parameters().motors[k];
  }
  std::reverse(machine.bodies.begin(), machine.bodies.end());
  std::reverse(machine.joints.begin(), machine.joints.end());
  std::reverse(machine.start.begin(), machine.start.end());
  for (MechanismJoint& joint : machine.joints) {
    joint.parent = bodies - 1 - joint.parent;
    joint.child = bodies - 1 - joint.child;
    joint.closure = joint.kind == JointKind::revolute || joint.kind == JointKind::prismatic ? joint.closure : false;
  }
  return out;
}

ChangedMechanism heavier(const Mechanism& mechanism) {
  ChangedMechanism out = same(mechanism, "invariance.mass");
  for (MechanismBody& body : out.machine.bodies) {
    body.mass *= 2;
    body.inertia *= 2;
  }
  scaleLoads(2, 1, 1, out.machine);
  out.back.setConstant(0.5);
  return out;
}

/// A motion run backwards needs the same efforts if what rubs gives back.
ChangedMechanism backwards(const Mechanism& mechanism) {
  ChangedMechanism out = same(mechanism, "invariance.time_reversal");
  for (MechanismJoint& joint : out.machine.joints) {
    joint.damping *= -1;
    joint.friction *= -1;
  }
  out.reversed = true;
  return out;
}

/// The motion in the units and the order of a changed machine.
class ChangedTrajectory : public MotorTrajectory {
 public:
  ChangedTrajectory(const MotorTrajectory& own, const ChangedMechanism& change) : own_(own), change_(change) {}

  std::string kind() const override { return own_.kind(); }
  double duration() const override { return own_.duration() * change_.time; }
  MotorMotion at(double t) const override {
    const double there = t / change_.time;
    const MotorMotion given = own_.at(change_.reversed ? own_.duration() - there : there);
    MotorMotion out = given;
    out.t = t;
    const double rate = (change_.reversed ? -1 : 1) / change_.time;
    for (Eigen::Index k = 0; k < given.q.size(); ++k) {
      const auto to = static_cast<Eigen::Index>(change_.motor_of[k]);
      const double own = change_.coordinates(k);
      out.q(to) = own * given.q(k);
      out.qdot(to) = own * rate * given.qdot(k);
      out.qddot(to) = own * rate * rate * given.qddot(k);
    }
    return out;
  }

 private:
  const MotorTrajectory& own_;
  const ChangedMechanism& change_;
};

}  // namespace

std::vector<ChangedMechanism> changedMechanisms(const Mechanism& mechanism) {
  std::vector<ChangedMechanism> out;
  const Matrix3d R = Eigen::Quaterniond(0.51, -0.34, 0.62, 0.49).normalized().toRotationMatrix();
  out.push_back(same(mechanism, "invariance.rotation"));
  transform(R, Vector3d::Zero(), 1, out.back().machine);
  out.push_back(same(mechanism, "invariance.axes"));
  transform(Matrix3d::Identity(), mechanism.length() * Vector3d(0.7, -0.4, 0.3), 1, out.back().machine);
  out.push_back(inUnits(mechanism));
  out.push_back(relabelled(mechanism));
  out.push_back(heavier(mechanism));
  out.push_back(backwards(mechanism));
  return out;
}

std::vector<MechanismInvariance> askInvariances(const MechanismScenario& scenario, const LoopMotion& motion) {
  constexpr int instants = 13;
  std::vector<MechanismInvariance> out;
  const Mechanism& mechanism = *scenario.mechanism;
  const double duration = motion.trajectory().duration();
  LoopWork work, changed_work;
  for (const ChangedMechanism& change : changedMechanisms(mechanism)) {
    const Mechanism changed(change.machine);
    const LoopSolver solver(changed);
    const ChangedTrajectory trajectory(motion.trajectory(), change);
    // A motion run backwards may end on another branch than it began on: it starts where the motion ends.
    loops::LoopPose pose = solver.assembled();
    if (change.reversed)
      for (const double t : equallySpaced(duration, 129)) solver.moveTo(motion.trajectory().at(t).q, pose);
    const LoopMotion there(solver, trajectory, pose);
    MechanismInvariance one{change.check, {}};
    for (const double t : equallySpaced(duration, instants)) {
      const MotorEfforts expected = motion.inverseDynamics(t, work);
      const MotorEfforts found =
          there.inverseDynamics((change.reversed ? duration - t : t) * change.time, changed_work);
      InvarianceSample sample{t, 1 / work.reciprocal_condition, MotorEfforts(expected.size()),
                              motion.solver().effortScale(work)};
      for (Eigen::Index k = 0; k < expected.size(); ++k) {
        const auto at = static_cast<Eigen::Index>(change.motor_of[k]);
        sample.difference(k) = found(at) * change.back(k) - expected(k);
      }
      one.samples.push_back(std::move(sample));
    }
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace ursula
