#include "validation/pointwise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "model/simbody_loop.h"

namespace ursula {
namespace {

constexpr double eps = Eigen::NumTraits<double>::epsilon();
constexpr double pi = 3.14159265358979323846;

/// Angles that differ by whole turns are equal.
double angleDifference(double a, double b) { return std::abs(std::remainder(a - b, 2 * pi)); }

/// The largest of errors over legs or bodies; NaN stays and wins, so that it is seen.
void raise(Deviation& deviation, double error, int where) {
  if (std::isnan(deviation.error)) return;
  if (std::isnan(error) || error >= deviation.error) {
    deviation.error = error;
    deviation.where = where;
  }
}

void compareJoints(const JointMotion& answer, PointwiseSample& sample) {
  const JointMotion& simbody = sample.joints;
  for (int i = 0; i < leg_count; ++i) {
    raise(sample.joint_angles, angleDifference(answer.q.phi(i), simbody.q.phi(i)), i);
    raise(sample.joint_angles, angleDifference(answer.q.psi(i), simbody.q.psi(i)), i);
    raise(sample.joint_angles, angleDifference(answer.q.theta(i), simbody.q.theta(i)), i);
    const auto difference = [i](const JointVariables<double>& a, const JointVariables<double>& b) {
      return Vector3d(a.phi(i) - b.phi(i), a.psi(i) - b.psi(i), a.theta(i) - b.theta(i)).norm();
    };
    raise(sample.joint_rates, difference(answer.q_dot, simbody.q_dot), i);
    raise(sample.joint_accelerations, difference(answer.q_ddot, simbody.q_ddot), i);
  }
}

void compareBodies(const BodyMotions<double>& answer, const BodyMotions<double>& simbody, PointwiseSample& sample) {
  const double length = sample.conditioning.length;
  const auto norm = [length](const Vector6d& v) { return v.tail<3>().norm() + length * v.head<3>().norm(); };
  for (int b = 0; b < body_count; ++b) {
    const auto i = static_cast<std::size_t>(b);
    raise(sample.position, (answer[i].c - simbody[i].c).norm() + length * (answer[i].R - simbody[i].R).norm(), b);
    raise(sample.twist, norm(answer[i].twist - simbody[i].twist), b);
    raise(sample.twist_rate, norm(answer[i].twist_rate - simbody[i].twist_rate), b);
  }
}

/// Rounding of displacements, rates and accelerations: depth · eps · κ of the legs · scale, each level once more κ.
void setKinematicLimits(PointwiseSample& sample) {
  const Conditioning& c = sample.conditioning;
  const double unit = rounding_depth * eps * c.kappa_legs;
  sample.position.limit = unit * c.position_scale;
  sample.twist.limit = unit * c.kappa_B * c.twist_scale;
  sample.twist_rate.limit = unit * c.kappa_legs * c.kappa_B * c.rate_scale;
  sample.joint_angles.limit = sample.position.limit / c.length;
  sample.joint_rates.limit = sample.twist.limit / c.length;
  sample.joint_accelerations.limit = sample.twist_rate.limit / c.length;
}

/// t_P = T φ̇ (24) and ṫ_P = T φ̈ + Ṫ φ̇ (25) with Simbody's joint motion.
void compareJacobians(const KinematicAnswer& answer, PointwiseSample& sample) {
  const Conditioning& c = sample.conditioning;
  const Vector6d rate = sample.joints.q_dot.phi, acceleration = sample.joints.q_ddot.phi;
  Vector6d twist, twist_rate;
  twist << sample.motion.omega, sample.motion.p_dot;
  twist_rate << sample.motion.omega_dot, sample.motion.p_ddot;
  const auto norm = [&c](const Vector6d& v) { return v.tail<3>().norm() + c.length * v.head<3>().norm(); };
  raise(sample.jacobian, norm(answer.T * rate - twist), -1);
  raise(sample.jacobian_rate, norm(answer.T * acceleration + answer.T_rate * rate - twist_rate), -1);
  sample.jacobian.limit = sample.twist.limit * c.kappa_B;
  sample.jacobian_rate.limit = sample.twist_rate.limit * c.kappa_B;
}

/// Ṫ against a difference of T along the motion: five points, so that the truncation stays below the limit, which is
/// the rounding of T over the step. No other road is needed.
void compareJacobianDifferences(const Scenario& scenario, const Subject& subject, const KinematicAnswer& answer,
                                PointwiseSample& sample) {
  const Conditioning& c = sample.conditioning;
  const double duration = scenario.trajectory->duration(), step = duration * std::pow(eps, 0.2) / 100;
  const double t = std::clamp(sample.motion.t, 2 * step, duration - 2 * step);
  const auto T = [&](double at) { return subject.kinematics(scenario.trajectory->at(at)).T; };
  const Matrix6d difference = (8 * (T(t + step) - T(t - step)) - (T(t + 2 * step) - T(t - 2 * step))) / (12 * step);
  const Matrix6d T_rate = t == sample.motion.t ? answer.T_rate : subject.kinematics(scenario.trajectory->at(t)).T_rate;
  const Matrix6d error = T_rate - difference;
  const double scale = answer.T.bottomRows<3>().norm() + c.length * answer.T.topRows<3>().norm();
  raise(sample.jacobian_difference, error.bottomRows<3>().norm() + c.length * error.topRows<3>().norm(), -1);
  sample.jacobian_difference.limit = rounding_depth * eps * c.kappa_B * c.kappa_legs * scale / step;
}

/// The first leg with an angle that is not finite.
std::optional<int> unplaceable(const JointVariables<double>& q) {
  for (int i = 0; i < leg_count; ++i)
    if (!std::isfinite(q.phi(i) + q.psi(i) + q.theta(i))) return i;
  return std::nullopt;
}

void runKinematics(const Scenario& scenario, const Subject& subject, SimbodyLoop& loop, PointwiseSample& sample) {
  const KinematicAnswer answer = subject.kinematics(sample.motion);
  compareJoints(answer.joints, sample);
  compareJacobians(answer, sample);
  compareJacobianDifferences(scenario, subject, answer, sample);
  if (const std::optional<int> leg = unplaceable(answer.joints.q)) {  // Simbody throws at a state that is no number
    for (Deviation* deviation : {&sample.position, &sample.twist, &sample.twist_rate})
      raise(*deviation, std::nan(""), *leg);
    return;
  }
  loop.place(sample.motion, answer.joints);
  compareBodies(answer.bodies, loop.bodies(), sample);
}

void runDynamics(SimbodyLoop& loop, PointwiseSample& sample) {
  loop.place(sample.motion);
  sample.torques_simbody = loop.inverseDynamics();
  for (int i = 0; i < leg_count; ++i) raise(sample.torque, std::abs(sample.torques(i) - sample.torques_simbody(i)), i);
  const double length = sample.conditioning.length;
  loop.accelerate(sample.torques);
  const Motion<double> found = loop.platform();
  raise(sample.acceleration,
        (found.p_ddot - sample.motion.p_ddot).norm() + length * (found.omega_dot - sample.motion.omega_dot).norm(), -1);
  sample.torque.limit = sample.conditioning.torqueRounding();
  sample.acceleration.limit = sample.conditioning.accelerationRounding();
}

PointwiseSample runInstant(const Scenario& scenario, const Subject& subject, ConditioningProbe& probe,
                           SimbodyLoop& loop, double t) {
  PointwiseSample sample;
  sample.motion = scenario.trajectory->at(t);
  sample.conditioning = probe.at(sample.motion);
  sample.joints = loop.place(sample.motion);
  try {
    sample.torques = subject.torques(sample.motion);
    setKinematicLimits(sample);
    if (subject.kinematics) runKinematics(scenario, subject, loop, sample);
    runDynamics(loop, sample);
  } catch (const PoseError& error) {
    sample.refused = error.what();
  }
  return sample;
}

struct Quantity {
  std::string name, unit, what, basis;
  Deviation PointwiseSample::*deviation;
  bool of_body;
};

std::string placeName(const Quantity& quantity, int where) {
  if (where < 0) return "platform";
  if (!quantity.of_body) return fmt::format("leg {}", where + 1);
  if (where == 2 * leg_count) return "platform";
  return fmt::format("{} link of leg {}", where < leg_count ? "proximal" : "distal", where % leg_count + 1);
}

/// Every instant is judged. Shown is the one furthest beyond its limit, or where none is, the largest error.
const PointwiseSample* findShown(const std::vector<PointwiseSample>& samples, const Quantity& quantity) {
  const PointwiseSample *largest = nullptr, *worst = nullptr;
  double worst_ratio = 1;
  for (const PointwiseSample& sample : samples) {
    const Deviation& deviation = sample.*quantity.deviation;
    if (!(deviation.error <= deviation.limit)) {
      const double ratio = deviation.error / deviation.limit;
      if (!(ratio <= worst_ratio)) worst = &sample, worst_ratio = ratio;
      if (std::isnan(ratio)) return worst;
    }
    if (largest == nullptr || deviation.error > (largest->*quantity.deviation).error) largest = &sample;
  }
  return worst != nullptr ? worst : largest;
}

Check judgeQuantity(const std::vector<PointwiseSample>& samples, const Quantity& quantity) {
  for (const PointwiseSample& sample : samples)
    if (!sample.refused.empty()) return notMade(quantity.name, quantity.unit, "no answer: " + sample.refused);
  const PointwiseSample* shown = findShown(samples, quantity);
  if (shown == nullptr) return notMade(quantity.name, quantity.unit, "no instant was compared");
  const Deviation& deviation = shown->*quantity.deviation;
  const Conditioning& c = shown->conditioning;
  const std::string basis = fmt::format("{}; there kappa(B) = {:.3g}, kappa(legs) = {:.3g}, eps = {:.3g}",
                                        quantity.basis, c.kappa_B, c.kappa_legs, eps);
  const std::string why = fmt::format("{}, at {} instants; shown for t = {:.6g} s, {}", quantity.what, samples.size(),
                                      shown->motion.t, placeName(quantity, deviation.where));
  return judged(quantity.name, deviation.error, deviation.limit, quantity.unit, basis, why);
}

const std::vector<Quantity>& kinematicQuantities() {
  static const std::vector<Quantity> quantities = {
      {"kinematics.joint_angles", "rad", "phi, psi, theta against Simbody's loop placed by geometry",
       "25 eps kappa(legs) x largest coordinate / length", &PointwiseSample::joint_angles, false},
      {"kinematics.joint_rates", "rad/s", "their rates against Simbody's constraint Jacobian",
       "25 eps kappa(legs) kappa(B) x velocity / length", &PointwiseSample::joint_rates, false},
      {"kinematics.joint_accelerations", "rad/s^2", "their accelerations against Simbody's constraints",
       "25 eps kappa(legs)^2 kappa(B) x acceleration / length", &PointwiseSample::joint_accelerations, false},
      {"kinematics.positions", "m", "mass centres and orientations of 13 bodies, Simbody put into the joint state",
       "25 eps kappa(legs) x largest coordinate", &PointwiseSample::position, true},
      {"kinematics.twists", "m/s", "twists of 13 bodies, (16), (41)", "25 eps kappa(legs) kappa(B) x velocity",
       &PointwiseSample::twist, true},
      {"kinematics.accelerations", "m/s^2", "twist rates of 13 bodies, (17), (43)",
       "25 eps kappa(legs)^2 kappa(B) x acceleration", &PointwiseSample::twist_rate, true},
      {"kinematics.jacobian", "m/s", "t_P = T phi_dot (24) with Simbody's joint rates",
       "25 eps kappa(legs) kappa(B)^2 x velocity", &PointwiseSample::jacobian, true},
      {"kinematics.jacobian_rate", "m/s^2", "T phi_ddot + T_dot phi_dot (25) with Simbody's joint motion",
       "25 eps kappa(legs)^2 kappa(B)^2 x acceleration", &PointwiseSample::jacobian_rate, true},
      {"kinematics.jacobian_difference", "m/s", "T_dot against five-point differences of T along the motion",
       "25 eps kappa(legs) kappa(B) x ||T|| / step", &PointwiseSample::jacobian_difference, true},
  };
  return quantities;
}

const std::vector<Quantity>& dynamicQuantities() {
  static const std::vector<Quantity> quantities = {
      {"torque.pointwise", "N m", "torques against Simbody's own inverse dynamics",
       "25 eps kappa(B) kappa(legs) x || |T|' |w| ||", &PointwiseSample::torque, false},
      {"acceleration.pointwise", "m/s^2", "Simbody's accelerations of the platform under the torques, commanded state",
       "the torque's limit x || T_P inv(I) ||", &PointwiseSample::acceleration, true},
  };
  return quantities;
}

}  // namespace

std::vector<PointwiseSample> runPointwise(const Scenario& scenario, const Subject& subject,
                                          const std::vector<double>& instants) {
  ConditioningProbe probe(*scenario.manipulator, scenario.load);
  SimbodyLoop loop(*scenario.manipulator, SimbodyLoop::Topology::six_balls, scenario.load);
  std::vector<PointwiseSample> samples;
  samples.reserve(instants.size());
  for (double t : instants) samples.push_back(runInstant(scenario, subject, probe, loop, t));
  return samples;
}

std::vector<Check> judgePointwise(const std::vector<PointwiseSample>& samples, bool has_kinematics) {
  std::vector<Check> checks;
  if (has_kinematics)
    for (const Quantity& quantity : kinematicQuantities()) checks.push_back(judgeQuantity(samples, quantity));
  for (const Quantity& quantity : dynamicQuantities()) checks.push_back(judgeQuantity(samples, quantity));
  return checks;
}

}  // namespace ursula
