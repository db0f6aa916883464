#include "validation/samples/invariance_samples.h"

#include <Eigen/Geometry>
#include <functional>

#include "model/manipulator.h"
#include "nocsolver/errors.h"
#include "validation/subject/presentation.h"

namespace ursula {
namespace {

/// No angle of it is special to any leg.
Presentation worldTurned(const Manipulator& machine) {
  Presentation out(machine);
  out.turn = Eigen::AngleAxisd(0.7, Vector3d(0.36, -0.48, 0.8)).toRotationMatrix();
  return out;
}

/// Leg i becomes leg i + 1, the last one the first.
Presentation relabelled(const Manipulator& machine) {
  Presentation out(machine);
  std::array<int, leg_count> legs = out.leg;
  for (int i = 0; i < machine.legCount(); ++i) legs[static_cast<std::size_t>((i + 1) % machine.legCount())] = i;
  out.relabel(machine, legs);
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
      friction->phi *= 2;
      friction->psi *= 2;
      friction->theta *= 2;
      friction->d *= 2;
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

using TorquesOf = std::function<Vector6d(const Motion<double>&)>;

InvarianceSamples sampled(Symmetry symmetry, const TorquesOf& expected, const TorquesOf& found,
                          const std::vector<PointwiseSample>& samples) {
  InvarianceSamples out{symmetry, {}, {}, ""};
  try {
    for (const PointwiseSample& sample : samples) {
      const Vector6d one_side = expected(sample.motion), other_side = found(sample.motion);
      out.expected.push_back(one_side);
      out.found.push_back(other_side);
    }
  } catch (const PoseError& refusal) {
    out.refused = refusal.what();
  }
  return out;
}

}  // namespace

std::vector<InvarianceSamples> runInvariances(const Scenario& scenario, const Subject& subject,
                                              const std::vector<PointwiseSample>& samples) {
  if (!subject.rebuilt) return {};
  const Manipulator& machine = *scenario.manipulator;
  const Presentation turned = worldTurned(machine), labels = relabelled(machine);
  const Subject own = subject.rebuilt(machine), in_turned = subject.rebuilt(turned.of(machine)),
                with_other_labels = subject.rebuilt(labels.of(machine)),
                with_double = subject.rebuilt(doubled(machine)),
                without_friction = subject.rebuilt(frictionless(machine));
  using M = Motion<double>;
  return {
      sampled(
          Symmetry::rotation, own.torques, [&](const M& motion) { return in_turned.torques(turned.of(motion)); },
          samples),
      sampled(
          Symmetry::labels, [&](const M& motion) { return labels.of(own.torques(motion)); }, with_other_labels.torques,
          samples),
      sampled(
          Symmetry::mass, [&](const M& motion) { return Vector6d(2 * own.torques(motion)); }, with_double.torques,
          samples),
      sampled(
          Symmetry::time_reversal, without_friction.torques,
          [&](const M& motion) { return Vector6d((own.torques(motion) + own.torques(reversed(motion))) / 2); },
          samples),
  };
}

}  // namespace ursula
