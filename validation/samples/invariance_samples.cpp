#include "validation/samples/invariance_samples.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>

#include "model/manipulator.h"
#include "nocsolver/errors.h"
#include "validation/subject/frame_change.h"

namespace ursula {
namespace {

/// Number of frames; an error that depends on the direction of an axis appears in some.
constexpr int frames = 8;

/// A rotation that is generic for every leg and differs between frames; in some, gravity points up.
Matrix3d turnOf(int frame) {
  const Vector3d axis(std::cos(1.3 * frame + 0.4), std::sin(2.1 * frame + 0.2), std::cos(0.7 * frame + 0.9));
  return Eigen::AngleAxisd(0.7 + 2.4 * frame, axis.normalized()).toRotationMatrix();
}

std::vector<FrameChange> worldTurned(const Manipulator& machine) {
  std::vector<FrameChange> out(frames, FrameChange(machine));
  for (int k = 0; k < frames; ++k) out[k].turn = turnOf(k);
  return out;
}

/// Other axes on the platform and another origin.
std::vector<FrameChange> otherAxes(const Manipulator& machine) {
  std::vector<FrameChange> out(frames, FrameChange(machine));
  const double length = machine.parameters().legs.front().platform_point.norm();
  for (int k = 0; k < frames; ++k) {
    out[k].platform_turn = turnOf(k + frames);
    out[k].origin = length * turnOf(k) * Vector3d(0.3, -0.7, 0.4);
  }
  return out;
}

/// Lengths from a ten-thousandth to ten thousand times the machine's own unit; masses and times grow with them.
std::vector<FrameChange> otherUnits(const Manipulator& machine) {
  std::vector<FrameChange> out;
  for (const double length : {1.23e-4, 3.71e-3, 0.0917, 7.13, 219.0, 8130.0}) {
    out.emplace_back(machine);
    out.back().units.length = length;
    out.back().units.mass = 1.37 * std::pow(length, 1.1);
    out.back().units.time = 0.91 * std::cbrt(length);
  }
  return out;
}

/// Leg i becomes leg i + 1, the last one the first.
FrameChange relabelled(const Manipulator& machine) {
  FrameChange out(machine);
  PerLeg<int> legs = out.leg;
  for (int i = 0; i < machine.legCount(); ++i) legs[(i + 1) % machine.legCount()] = i;
  out.relabel(machine, legs);
  return out;
}

/// Masses, inertias and friction doubled: a power of two, so rounding stays the same.
Manipulator doubled(const Manipulator& manipulator) {
  ManipulatorParameters machine = manipulator.parameters();
  machine.platform.mass *= 2;
  machine.platform.inertia *= 2;
  for (Leg& leg : machine.legs) {
    for (Link* link : {&leg.proximal, &leg.distal}) {
      link->mass *= 2;
      link->inertia *= 2;
    }
    for (JointFriction* friction : {&leg.friction, static_cast<JointFriction*>(&leg.coulomb), &leg.rotor_inertia}) {
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
  out.expected.reserve(samples.size());
  out.found.reserve(samples.size());
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

/// Evaluates each sample in one change of frame in turn, or in several if there are fewer samples.
InvarianceSamples sampledIn(Symmetry symmetry, const Subject& subject, const Manipulator& machine,
                            const std::vector<FrameChange>& all, const std::vector<PointwiseSample>& samples) {
  const Subject own = subject.rebuilt(machine);
  std::vector<Subject> seen;
  for (const FrameChange& there : all) seen.push_back(subject.rebuilt(there.transformed(machine)));
  std::size_t k = 0;  // index of the sample
  return sampled(
      symmetry, own.torques,
      [&](const Motion<double>& motion) {
        const Vector6d expected = own.torques(motion);
        Vector6d worst = expected;
        for (std::size_t i = k % all.size(); i < all.size(); i += samples.size()) {
          const Vector6d found = all[i].torquesBack(seen[i].torques(all[i].transformed(motion)));
          if (!((found - expected).norm() <= (worst - expected).norm())) worst = found;
        }
        ++k;
        return worst;
      },
      samples);
}

}  // namespace

std::vector<InvarianceSamples> runInvariances(const Scenario& scenario, const Subject& subject,
                                              const std::vector<PointwiseSample>& samples) {
  if (!subject.rebuilt) return {};
  const Manipulator& machine = *scenario.manipulator;
  const FrameChange labels = relabelled(machine);
  const Subject own = subject.rebuilt(machine), with_other_labels = subject.rebuilt(labels.transformed(machine)),
                with_double = subject.rebuilt(doubled(machine)),
                without_friction = subject.rebuilt(frictionless(machine));
  using M = Motion<double>;
  const auto transformed = [&](Symmetry symmetry, const std::vector<FrameChange>& all) {
    return sampledIn(symmetry, subject, machine, all, samples);
  };
  return {
      transformed(Symmetry::rotation, worldTurned(machine)),
      transformed(Symmetry::axes, otherAxes(machine)),
      transformed(Symmetry::units, otherUnits(machine)),
      sampled(
          Symmetry::labels, [&](const M& motion) { return labels.transformed(own.torques(motion)); },
          with_other_labels.torques, samples),
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
