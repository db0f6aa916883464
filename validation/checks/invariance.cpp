#include "validation/checks/invariance.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <functional>

#include "model/manipulator.h"
#include "nocsolver/errors.h"
#include "validation/samples/place_name.h"
#include "validation/subject/presentation.h"
#include "validation/verdict/worst_share.h"

namespace ursula {
namespace {

/// No angle of it is special to any leg.
Presentation worldTurned() {
  Presentation out;
  out.turn = Eigen::AngleAxisd(0.7, Vector3d(0.36, -0.48, 0.8)).toRotationMatrix();
  return out;
}

/// Leg i becomes leg (i + 1) mod 6.
Presentation relabelled() {
  Presentation out;
  for (int i = 0; i < leg_count; ++i) out.leg[static_cast<std::size_t>((i + 1) % leg_count)] = i;
  return out;
}

/// Masses, inertias and friction doubled: a power of two, so that no rounding differs.
Manipulator doubled(const Manipulator& manipulator) {
  ManipulatorParameters machine = manipulator.parameters();
  machine.platform.mass *= 2;
  machine.platform.inertia *= 2;
  for (Leg& leg : machine.legs) {
    for (Link* link : {&leg.proximal, &leg.distal}) {
      link->mass *= 2;
      link->inertia *= 2;
    }
    for (JointFriction* friction : {&leg.friction, static_cast<JointFriction*>(&leg.coulomb)}) {
      friction->actuated *= 2;
      friction->universal *= 2;
      friction->knee *= 2;
    }
  }
  return Manipulator(machine);
}

Motion<double> reversed(const Motion<double>& motion) {
  Motion<double> out = motion;
  out.omega = -motion.omega;
  out.p_dot = -motion.p_dot;
  return out;
}

struct Invariance {
  const char* name;
  const char* what;
  std::function<Vector6d(const Motion<double>&)> expected, found;
};

Check judgeInvariance(const Invariance& invariance, const std::vector<PointwiseSample>& samples,
                      const RoundingProfile& profile, const Units& units) {
  SecondLook look(profile);
  Worst worst;
  double torque = 0;
  try {
    for (const PointwiseSample& sample : samples) {
      const Vector6d difference = invariance.expected(sample.motion) - invariance.found(sample.motion);
      Eigen::Index leg = 0;
      const double error = difference.cwiseAbs().maxCoeff<Eigen::PropagateNaN>(&leg);
      worst.add(error, look.limit(error, sample.conditioning, Rounded::solver, sample.motion, 2), sample.motion.t,
                static_cast<int>(leg));
      torque = std::max(torque, sample.torques_simbody.cwiseAbs().maxCoeff());
    }
  } catch (const PoseError& refusal) {
    return notMade(invariance.name, "N m", std::string("no answer: ") + refusal.what());
  }
  if (!worst.any) return notMade(invariance.name, "N m", "no instant was compared");
  Check check = judgedIfUseful(
      invariance.name, worst.value, limitToJudge(worst, useful_share * torque), useful_share * torque, "N m",
      "twice the solver's own rounding: both sides round",
      fmt::format("{}, at {} instants; shown for t = {:.6g} s, leg {}", invariance.what, samples.size(),
                  worst.t * units.time, worst.where + 1),
      fmt::format("it exceeds {:g} of the largest torque: {}", useful_share, causeOfRounding(samples, worst.widest_t)));
  check.largest = {worst.largest, worst.largest_t * units.time, placeName(worst.largest_where, false)};
  return check;
}

}  // namespace

std::vector<Check> judgeInvariances(const Scenario& scenario, const Subject& subject,
                                    const std::vector<PointwiseSample>& samples, const RoundingProfile& profile,
                                    const Units& units) {
  if (!subject.rebuilt) return {};
  const Manipulator& machine = *scenario.manipulator;
  const Presentation turned = worldTurned(), labels = relabelled();
  const Subject own = subject.rebuilt(machine), in_turned = subject.rebuilt(turned.of(machine)),
                with_other_labels = subject.rebuilt(labels.of(machine)),
                with_double = subject.rebuilt(doubled(machine)),
                without_friction = subject.rebuilt(frictionless(machine));
  using M = Motion<double>;
  const std::vector<Invariance> invariances = {
      {"invariance.rotation", "the whole world turned, gravity included, leaves the torques", own.torques,
       [&](const M& motion) { return in_turned.torques(turned.of(motion)); }},
      {"invariance.labels", "legs relabelled carry their torques along",
       [&](const M& motion) { return labels.of(own.torques(motion)); }, with_other_labels.torques},
      {"invariance.mass", "masses, inertias and friction doubled double the torques",
       [&](const M& motion) { return Vector6d(2 * own.torques(motion)); }, with_double.torques},
      {"invariance.time_reversal", "the mean of the torques forwards and backwards is that without friction",
       without_friction.torques,
       [&](const M& motion) { return Vector6d((own.torques(motion) + own.torques(reversed(motion))) / 2); }},
  };
  std::vector<Check> checks;
  checks.reserve(invariances.size());
  for (const Invariance& invariance : invariances)
    checks.push_back(judgeInvariance(invariance, samples, profile, units));
  return checks;
}

}  // namespace ursula
