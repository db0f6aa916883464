#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "parts/causes/mechanism_tried.h"

namespace ursula::mechanisms {
namespace {

/// A force along joint coordinates, as the motors feel it: what they must overcome.
struct JointTerm {
  const char* term;
  const char* detail;
  const char* number;  ///< the joint's, to which the term is proportional; empty for several
  double (*of)(const MechanismJoint&, const Coordinate&);
};

double dampingOf(const MechanismJoint& j, const Coordinate& c) { return j.damping * c.rate; }
double coulombOf(const MechanismJoint& j, const Coordinate& c) {
  return j.friction == 0 ? 0 : j.friction * std::tanh(c.rate / j.smoothing());
}
bool hasSpring(const MechanismJoint& j) { return j.kind == JointKind::revolute || j.kind == JointKind::prismatic; }
double springOf(const MechanismJoint& j, const Coordinate& c) {
  return hasSpring(j) ? j.stiffness * (c.value - j.spring_reference) : 0;
}

const JointTerm joint_terms[] = {
    {"friction", "", "",
     [](const MechanismJoint& j, const Coordinate& c) { return dampingOf(j, c) + coulombOf(j, c); }},
    {"friction", "the viscous part", "damping", dampingOf},
    {"friction", "the Coulomb part", "friction", coulombOf},
    {"rotor_inertia", "", "armature",
     [](const MechanismJoint& j, const Coordinate& c) { return j.rotor_inertia * c.acceleration; }},
    {"springs", "", "stiffness", springOf},
    {"springs", "their rest positions", "springref",
     [](const MechanismJoint& j, const Coordinate&) { return hasSpring(j) ? -j.stiffness * j.spring_reference : 0; }},
};

using Joints = std::vector<std::size_t>;

template <class Of>
VectorXd jointEfforts(const EffortResidual& data, std::size_t joint, const Of& of) {
  const MechanismJoint& its = data.mechanism->joints()[joint];
  return data.each([&](const Instant& at) -> VectorXd {
    VectorXd out = VectorXd::Zero(data.motors);
    for (const Coordinate& each : at.coordinates)
      if (each.joint == joint) out += each.row.transpose() * of(its, each);
    return out;
  });
}

bool isMotor(const Mechanism& mechanism, std::size_t joint) {
  const auto& motors = mechanism.motors();
  return std::find(motors.begin(), motors.end(), joint) != motors.end();
}

/// A term of some joints, `times`.
ChangeOf termOf(const Joints& joints, const JointTerm& term, double times) {
  return [joints, of = term.of, times](const EffortResidual& data) {
    VectorXd out = VectorXd::Zero(data.noc.size());
    for (const std::size_t j : joints) out += times * jointEfforts(data, j, of);
    return out;
  };
}

/// "joint.elbow.damping"; empty if the term has several numbers.
std::string numberOf(const std::string& joint, const JointTerm& term) {
  return *term.number == 0 ? "" : "joint." + joint + term.number;
}

void addTerm(const EffortResidual& data, const JointTerm& term, std::vector<Tried>& out) {
  const Mechanism& mechanism = *data.mechanism;
  Joints all, motors, passive;
  for (std::size_t j = 0; j < mechanism.joints().size(); ++j) {
    const MechanismJoint& joint = mechanism.joints()[j];
    if (!joint.isLoaded()) continue;
    if (jointEfforts(data, j, term.of).isZero(0)) continue;
    NamedCause named{CauseKind::missing_term, term.term};
    named.joint = joint.name;
    named.parameter = numberOf(joint.name + ".", term);
    addFixed(out, named, termOf({j}, term, -1), term.detail);
    named.kind = CauseKind::sign;
    addFixed(out, named, termOf({j}, term, -2), term.detail);
    all.push_back(j);
    (isMotor(mechanism, j) ? motors : passive).push_back(j);
  }
  NamedCause named{CauseKind::missing_term, term.term, "all", numberOf("", term)};
  if (all.size() > 1) addScaledTerm(named, termOf(all, term, 1), term.detail, out);
  if (passive.size() > 1 && !motors.empty())
    named.body = "passive", addFixed(out, named, termOf(passive, term, -1), term.detail);
  if (motors.size() > 1 && !passive.empty())
    named.body = "motors", addFixed(out, named, termOf(motors, term, -1), term.detail);
}

/// The friction of a passive joint, added to a motor's effort as it is: without the joint's Jacobian.
void addDirectFriction(const EffortResidual& data, std::vector<Tried>& out) {
  const Mechanism& mechanism = *data.mechanism;
  for (std::size_t j = 0; j < mechanism.joints().size(); ++j) {
    const MechanismJoint& joint = mechanism.joints()[j];
    if (isMotor(mechanism, j) || !hasSpring(joint) || (joint.damping == 0 && joint.friction == 0)) continue;
    for (Eigen::Index motor = 0; motor < data.motors; ++motor) {
      NamedCause named{CauseKind::frame, "friction"};
      named.joint = joint.name;
      named.motor = static_cast<int>(motor) + 1;
      addFixed(out, named, data.each([&](const Instant& at) -> VectorXd {
        VectorXd change = VectorXd::Zero(data.motors);
        for (const Coordinate& c : at.coordinates) {
          if (c.joint != j) continue;
          const double friction = dampingOf(joint, c) + coulombOf(joint, c);
          change -= c.row.transpose() * friction;
          change(motor) += friction;
        }
        return change;
      }),
               "added to the motor's effort without the joint's Jacobian");
    }
  }
}

/// Coulomb friction with the rate's sign, without the smoothing about rest; of one joint, and of all.
void addSharpFriction(const EffortResidual& data, std::vector<Tried>& out) {
  const auto sharper = [](const MechanismJoint& j, const Coordinate& c) {
    const double sign = c.rate > 0 ? 1 : c.rate < 0 ? -1 : 0;
    return j.friction == 0 ? 0 : j.friction * sign - coulombOf(j, c);
  };
  VectorXd all = VectorXd::Zero(data.noc.size());
  std::size_t count = 0;
  for (std::size_t j = 0; j < data.mechanism->joints().size(); ++j) {
    const MechanismJoint& joint = data.mechanism->joints()[j];
    if (joint.friction == 0) continue;
    const VectorXd change = jointEfforts(data, j, sharper);
    all += change, ++count;
    NamedCause named{CauseKind::parameter, "friction"};
    named.joint = joint.name;
    named.parameter = "joint." + joint.name + ".smoothing_speed";
    named.unit = joint.slides() ? "m/s" : "rad/s";
    named.expected = joint.smoothing(), named.found = 0;
    addFixed(out, named, change);
  }
  if (count > 1) addFixed(out, {CauseKind::parameter, "friction", "all", "joint.smoothing_speed"}, all);
}

/// 2 ω × v of slides left out of the acceleration of the body that slides, and perhaps of all that hangs on it; of one
/// slide, and of all.
void addSlidesCoriolis(const EffortResidual& data, std::vector<Tried>& out) {
  const Mechanism& mechanism = *data.mechanism;
  const FileTree tree(mechanism);
  constexpr const char* detail = "the Coriolis acceleration of what slides";
  for (const bool with_rest : {true, false}) {
    VectorXd all = VectorXd::Zero(data.noc.size());
    std::size_t count = 0;
    for (std::size_t j = 0; j < mechanism.joints().size(); ++j) {
      const MechanismJoint& joint = mechanism.joints()[j];
      if (!joint.slides() || !tree.holds(j) || tree.isReversed(j)) continue;
      const VectorXd change = data.each([&](const Instant& at) -> VectorXd {
        VectorXd sum = VectorXd::Zero(data.motors);
        const Vector3d omega = at.work.bodies[joint.parent].twist.head<3>();
        for (const Coordinate& c : at.coordinates)
          for (std::size_t b = 0; b < mechanism.bodies().size() && c.joint == j; ++b)
            if (b == joint.child || (with_rest && tree.isBefore(j, b)))
              sum -= mechanism.bodies()[b].mass * at.work.T[b].bottomRows<3>().transpose() * 2 * c.rate *
                     omega.cross(c.axis);
        return sum;
      });
      all += change, ++count;
      NamedCause named{CauseKind::missing_term, "coriolis"};
      named.joint = joint.name;
      addFixed(out, named, change, detail);
    }
    if (count > 1) addFixed(out, {CauseKind::missing_term, "coriolis", "all"}, all, detail);
  }
}

/// A number of a joint to which the efforts are proportional.
struct JointNumber {
  const char* key;
  const char *unit, *unit_of_slide;
  double MechanismJoint::*member;
  double (*per_unit)(const MechanismJoint&, const Coordinate&);
};

const JointNumber joint_numbers[] = {
    {"damping", "N m s", "N s/m", &MechanismJoint::damping,
     [](const MechanismJoint&, const Coordinate& c) { return c.rate; }},
    {"friction", "N m", "N", &MechanismJoint::friction,
     [](const MechanismJoint& j, const Coordinate& c) { return std::tanh(c.rate / j.smoothing()); }},
    {"armature", "kg m^2", "kg", &MechanismJoint::rotor_inertia,
     [](const MechanismJoint&, const Coordinate& c) { return c.acceleration; }},
    {"stiffness", "N m/rad", "N/m", &MechanismJoint::stiffness,
     [](const MechanismJoint& j, const Coordinate& c) { return hasSpring(j) ? c.value - j.spring_reference : 0; }},
    {"springref", "rad", "m", &MechanismJoint::spring_reference,
     [](const MechanismJoint& j, const Coordinate&) { return hasSpring(j) ? -j.stiffness : 0; }},
};

void addNumber(const EffortResidual& data, std::size_t j, const JointNumber& number, std::vector<Tried>& out) {
  const MechanismJoint& joint = data.mechanism->joints()[j];
  if (joint.closure && !hasSpring(joint) && !joint.isLoaded()) return;  // a tie between points, which has none
  const VectorXd column = jointEfforts(data, j, number.per_unit);
  if (column.isZero(0)) return;
  const double expected = joint.*(number.member);
  const bool is_reference = number.member == &MechanismJoint::spring_reference;
  Tried tried{{CauseKind::parameter, "", "", fmt::format("joint.{}.{}", joint.name, number.key),
               joint.slides() ? number.unit_of_slide : number.unit, expected},
              [column](const EffortResidual&, const VectorXd& x) { return VectorXd(x(0) * column); },
              VectorXd::Ones(1)};
  tried.named.joint = joint.name;
  tried.machine = [j, member = number.member](MechanismParameters& machine, const VectorXd& x) {
    machine.joints[j].*member += x(0);
  };
  tried.finish = [expected, is_reference](const VectorXd& x, const VectorXd& uncertainty, NamedCause& named) {
    named.found = expected + x(0);
    named.uncertainty = uncertainty(0);
    return is_reference || *named.found >= -uncertainty(0);
  };
  out.push_back(tried);
}

}  // namespace

void addJointTerms(const EffortResidual& data, std::vector<Tried>& out) {
  for (const JointTerm& term : joint_terms) addTerm(data, term, out);
  addDirectFriction(data, out);
  addSharpFriction(data, out);
  addSlidesCoriolis(data, out);
}

void addJointNumbers(const EffortResidual& data, std::vector<Tried>& out) {
  for (std::size_t j = 0; j < data.mechanism->joints().size(); ++j)
    for (const JointNumber& number : joint_numbers) addNumber(data, j, number, out);
}

}  // namespace ursula::mechanisms
