#include "validation/samples/pointwise.h"

#include <fmt/format.h>
#include <algorithm>
#include <bitset>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>

#include "base/scalar.h"
#include "simbody/simbody_loop.h"
#include "validation/subject/frame_change.h"
#include "validation/verdict/worst_share.h"

namespace ursula {

std::string motorName(const Units& units, int motor) {
  const std::string leg = placeName(units.legOf(motor), false);
  const auto& legs = units.efforts.leg;
  const bool alone = motor < 0 || std::count(legs.begin(), legs.end(), units.legOf(motor)) == 1;
  return alone ? leg : fmt::format("{}, motor {}", leg, motor + 1);
}

std::string placeName(int where, bool of_body) {
  if (where < 0) return "platform";
  if (!of_body) return fmt::format("leg {}", where + 1);
  if (where == 2 * leg_count) return "platform";
  return fmt::format("{} link of leg {}", where < leg_count ? "proximal" : "distal", where % leg_count + 1);
}

namespace {

constexpr double eps = Eigen::NumTraits<double>::epsilon();

/// Angles that differ by whole turns are equal.
double angleDifference(double a, double b) { return std::abs(std::remainder(a - b, 2 * pi)); }

/// Keeps the largest error over legs or bodies; NaN wins and stays.
void raise(Deviation& deviation, double error, int where) {
  if (std::isnan(deviation.error)) return;
  if (std::isnan(error) || error >= deviation.error) {
    deviation.error = error;
    deviation.where = where;
  }
}

/// Displacements are divided by the machine's length.
void compareJoints(const JointMotion& answer, PointwiseSample& sample) {
  const JointMotion& simbody = sample.joints;
  const double length = sample.conditioning.length;
  for (int i = 0; i < leg_count; ++i) {
    raise(sample.joint_angles, angleDifference(answer.q.phi(i), simbody.q.phi(i)), i);
    raise(sample.joint_angles, angleDifference(answer.q.psi(i), simbody.q.psi(i)), i);
    raise(sample.joint_angles, angleDifference(answer.q.theta(i), simbody.q.theta(i)), i);
    if (answer.q.d(i) != simbody.q.d(i))
      raise(sample.joint_angles, std::abs(answer.q.d(i) - simbody.q.d(i)) / length, i);
    const auto difference = [i, length](const JointVariables<double>& a, const JointVariables<double>& b) {
      return jointDistance(a, b, i, length);
    };
    raise(sample.joint_rates, difference(answer.q_dot, simbody.q_dot), i);
    raise(sample.joint_accelerations, difference(answer.q_ddot, simbody.q_ddot), i);
  }
}

void compareBodies(const BodyMotions<double>& answer, const BodyMotions<double>& simbody, PointwiseSample& sample) {
  const double length = sample.conditioning.length;
  for (int b = 0; b < body_count; ++b) {
    raise(sample.position, (answer[b].c - simbody[b].c).norm() + length * (answer[b].R - simbody[b].R).norm(), b);
    raise(sample.twist, twistSize(answer[b].twist - simbody[b].twist, length), b);
    raise(sample.twist_rate, twistSize(answer[b].twist_rate - simbody[b].twist_rate, length), b);
  }
}

void setLimits(PointwiseSample& sample) {
  const auto set = [&sample](Deviation PointwiseSample::*deviation, Rounded quantity) {
    (sample.*deviation).limit = sample.conditioning.rounding(quantity);
  };
  using S = PointwiseSample;
  set(&S::joint_angles, Rounded::angles);
  set(&S::joint_rates, Rounded::rates);
  set(&S::joint_accelerations, Rounded::accelerations);
  set(&S::position, Rounded::positions);
  set(&S::twist, Rounded::twists);
  set(&S::twist_rate, Rounded::twist_rates);
  set(&S::jacobian, Rounded::jacobian);
  set(&S::jacobian_rate, Rounded::jacobian_rate);
  set(&S::torque, Rounded::torque);
  set(&S::acceleration, Rounded::acceleration);
}

/// t_P = T φ̇ (24) and ṫ_P = T φ̈ + Ṫ φ̇ (25) with Simbody's joint motion.
void compareJacobians(const KinematicAnswer& answer, const Motors& motors, PointwiseSample& sample) {
  const Vector6d rate = sample.joints.q_dot.driven(motors), acceleration = sample.joints.q_ddot.driven(motors);
  Vector6d twist, twist_rate;
  twist << sample.motion.omega, sample.motion.p_dot;
  twist_rate << sample.motion.omega_dot, sample.motion.p_ddot;
  const double length = sample.conditioning.length;
  raise(sample.jacobian, twistSize(answer.T * rate - twist, length), -1);
  raise(sample.jacobian_rate, twistSize(answer.T * acceleration + answer.T_rate * rate - twist_rate, length), -1);
}

using ShapingAt = std::function<Matrix6d(double t)>;

/// Uses five points, with a truncation error of fourth order.
Matrix6d differenceOf(const ShapingAt& T, double t, double step) {
  return (8 * (T(t + step) - T(t - step)) - (T(t + 2 * step) - T(t - 2 * step))) / (12 * step);
}

/// Compares Ṫ with a difference of T along the motion, without another formulation. The limit is the rounding of T over
/// the step plus the truncation. Doubling the step with the correct formulas changes the result by some 15 times the
/// truncation.
void compareJacobianDifferences(const Scenario& scenario, const Subject& subject, const Subject& right,
                                const KinematicAnswer& answer, PointwiseSample& sample) {
  const Conditioning& c = sample.conditioning;
  const double duration = scenario.trajectory->duration(), step = duration * std::pow(eps, 0.2) / 100;
  const double t = std::clamp(sample.motion.t, 4 * step, duration - 4 * step);
  const auto shapingOf = [&scenario](const Subject& of) -> ShapingAt {
    return [&](double at) { return of.kinematics(scenario.trajectory->at(at)).T; };
  };
  const auto size = [&c](const Matrix6d& T) { return T.bottomRows<3>().norm() + c.length * T.topRows<3>().norm(); };
  const Matrix6d T_rate = t == sample.motion.t ? answer.T_rate : subject.kinematics(scenario.trajectory->at(t)).T_rate;
  raise(sample.jacobian_difference, size(T_rate - differenceOf(shapingOf(subject), t, step)), -1);
  const ShapingAt T = shapingOf(right);
  const double truncation = size(differenceOf(T, t, step) - differenceOf(T, t, 2 * step));
  sample.jacobian_difference.limit =
      1.5 * c.rounding(Rounded::shaping) / step + c.rounding(Rounded::shaping_rate) + truncation;
}

/// Returns the first leg with an angle that is not finite.
std::optional<int> unplaceable(const JointVariables<double>& q) {
  for (int i = 0; i < leg_count; ++i)
    if (!std::isfinite(q.phi(i) + q.psi(i) + q.theta(i) + q.d(i))) return i;
  return std::nullopt;
}

void runKinematics(const Scenario& scenario, const Subject& subject, const Subject& right, SimbodyLoop& loop,
                   PointwiseSample& sample) {
  const KinematicAnswer answer = subject.kinematics(sample.motion);
  compareJoints(answer.joints, sample);
  compareJacobians(answer, scenario.manipulator->motors(), sample);
  compareJacobianDifferences(scenario, subject, right, answer, sample);
  if (const std::optional<int> leg = unplaceable(answer.joints.q)) {  // Simbody throws at NaN states
    for (Deviation* deviation : {&sample.position, &sample.twist, &sample.twist_rate})
      raise(*deviation, std::nan(""), *leg);
    return;
  }
  loop.place(sample.motion, answer.joints);
  compareBodies(answer.bodies, loop.bodies(), sample);
}

void runDynamics(const SimbodyAnswer& simbody, SimbodyLoop& loop, PointwiseSample& sample) {
  sample.torques_simbody = simbody.torques;
  compareTorques(sample);
  Vector6d commanded;
  commanded << sample.motion.omega_dot, sample.motion.p_ddot;
  sample.acceleration_error = simbody.twistRateUnder(sample.torques, loop, sample.motion) - commanded;
  raise(sample.acceleration, twistSize(sample.acceleration_error, sample.conditioning.length), -1);
}

PointwiseSample runInstant(const Scenario& scenario, const Subject& subject, const Subject& right,
                           const Conditioning& conditioning, const SimbodyAnswer& simbody, SimbodyLoop& loop,
                           const Motion<double>& motion) {
  PointwiseSample sample;
  sample.motion = motion;
  sample.conditioning = conditioning;
  sample.joints = loop.place(motion);
  setLimits(sample);
  try {
    sample.torques = subject.torques(sample.motion);
    if (subject.kinematics) runKinematics(scenario, subject, right, loop, sample);
    runDynamics(simbody, loop, sample);
  } catch (const PoseError& error) {
    sample.refused = error.what();
  }
  return sample;
}

constexpr Deviation PointwiseSample::*deviations[] = {
    &PointwiseSample::joint_angles, &PointwiseSample::joint_rates,   &PointwiseSample::joint_accelerations,
    &PointwiseSample::position,     &PointwiseSample::twist,         &PointwiseSample::twist_rate,
    &PointwiseSample::jacobian,     &PointwiseSample::jacobian_rate, &PointwiseSample::jacobian_difference,
    &PointwiseSample::torque,       &PointwiseSample::acceleration};

/// The deviations beyond their limits.
std::bitset<std::size(deviations)> beyond(const PointwiseSample& sample) {
  std::bitset<std::size(deviations)> out;
  for (std::size_t k = 0; k < out.size(); ++k) {
    const Deviation& deviation = sample.*deviations[k];
    out[k] = !(deviation.error <= deviation.limit);
  }
  return out;
}

}  // namespace

std::vector<PointwiseSample> runPointwise(const Scenario& scenario, const Subject& subject,
                                          const std::vector<double>& instants, const RoundingProfile& profile,
                                          const std::vector<SimbodyAnswer>& simbody, const Deadline& deadline,
                                          const EngineFault& fault) {
  SimbodyLoop loop(fault.applied(*scenario.manipulator), SimbodyLoop::Topology::ball_per_leg, scenario.load);
  const Subject right = nocSubject(*scenario.manipulator, scenario.load);
  std::vector<PointwiseSample> samples;
  samples.reserve(instants.size());
  foresee(subject, *scenario.trajectory, instants);
  std::bitset<std::size(deviations)> confirmed;  // a second look confirmed these
  for (std::size_t k = 0; k < instants.size(); ++k) {
    deadline.require();
    const Motion<double> motion = scenario.trajectory->at(instants[k]);
    const auto run = [&](const Conditioning& conditioning) {
      return runInstant(scenario, subject, right, conditioning, simbody[k], loop, motion);
    };
    samples.push_back(run(profile.at(motion)));
    if ((beyond(samples.back()) & ~confirmed).none() || !samples.back().refused.empty()) continue;
    samples.back() = run(profile.closer(motion));
    confirmed |= beyond(samples.back());
  }
  return samples;
}

std::vector<PointwiseSample> runPointwise(const Scenario& scenario, const Subject& subject,
                                          const std::vector<double>& instants, const RoundingProfile& profile) {
  return runPointwise(scenario, subject, instants, profile, simbodyAnswers(scenario, instants));
}

std::vector<PointwiseSample> runPointwise(const Scenario& scenario, const Subject& subject,
                                          const std::vector<double>& instants, const Deadline& deadline) {
  return runPointwise(scenario, subject, instants,
                      RoundingProfile(scenario, profileInstants(static_cast<int>(instants.size())), deadline),
                      simbodyAnswers(scenario, instants, deadline), deadline);
}

std::vector<PointwiseSample> runJointsAndTorques(const Scenario& scenario, const Subject& subject,
                                                 const std::vector<double>& instants) {
  SimbodyLoop loop(*scenario.manipulator, SimbodyLoop::Topology::ball_per_leg, scenario.load);
  ConditioningProbe probe(*scenario.manipulator, scenario.load);
  std::vector<PointwiseSample> samples(instants.size());
  for (std::size_t k = 0; k < instants.size(); ++k) {
    PointwiseSample& sample = samples[k];
    sample.motion = scenario.trajectory->at(instants[k]);
    sample.conditioning = probe.at(sample.motion);
    sample.joints = loop.place(sample.motion);
    sample.torques_simbody = loop.inverseDynamics();
    setLimits(sample);
    sample.torques = subject.torques(sample.motion);
    compareTorques(sample);
    compareJoints(subject.kinematics(sample.motion).joints, sample);
  }
  return samples;
}

void compareTorques(PointwiseSample& sample) {
  WorstShare worst;
  worst.addEach(sample.torques - sample.torques_simbody, sample.torqueLimits(), sample.motion.t);
  sample.torque = {worst.value, worst.limit, worst.where};
}

std::size_t indexFrom(const std::vector<PointwiseSample>& samples, double t) {
  const auto at = std::lower_bound(samples.begin(), samples.end(), t,
                                   [](const PointwiseSample& each, double x) { return each.motion.t < x; });
  return std::min(static_cast<std::size_t>(at - samples.begin()), samples.size() - 1);
}

double largestTorque(const std::vector<PointwiseSample>& samples) {
  double largest = 0;
  for (const PointwiseSample& sample : samples)
    largest = std::max(largest, sample.torques_simbody.cwiseAbs().maxCoeff());
  return largest;
}

std::vector<double> instantsOf(const std::vector<PointwiseSample>& samples) {
  std::vector<double> out;
  out.reserve(samples.size());
  for (const PointwiseSample& sample : samples) out.push_back(sample.motion.t);
  return out;
}

std::string causeOfRounding(const std::vector<PointwiseSample>& samples, double t, Rounded quantity) {
  return samples.empty() ? "" : causeOfRounding(samples[indexFrom(samples, t)].conditioning, quantity);
}

}  // namespace ursula
