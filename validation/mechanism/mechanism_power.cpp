// The power balance. A machine's energy changes at the rate that its motors' power, less the losses, says. Simbody's
// energies are differentiated along q + q̇ s + q̈ s²/2, whose rate at s = 0 is that of any motion in this state; so the
// trajectory need not be smooth. Neither accelerations nor forces of joints are used.

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

#include "simbody/simbody_mechanism.h"
#include "validation/mechanism/mechanism_evidence.h"

namespace ursula {
namespace {

/// The derivative by central differences of order 8; all poses continue the state y at that instant.
double energyRate(SimbodyMechanism& simbody, const std::vector<double>& y, const MotorMotion& at, double h) {
  constexpr double weights[] = {4 / 5.0, -1 / 5.0, 4 / 105.0, -1 / 280.0};
  const auto energy = [&](double s) {
    MotorMotion moved = at;
    moved.q += s * at.qdot + s * s / 2 * at.qddot;
    moved.qdot += s * at.qddot;
    simbody.setState(at.t, y.data());
    simbody.place(moved);
    const SimbodyMechanism::Energy found = simbody.energy();
    return found.kinetic + found.potential;
  };
  double out = 0;
  for (int k = 0; k < 4; ++k) out += weights[k] * (energy((k + 1) * h) - energy(-(k + 1) * h)) / h;
  return out;
}

/// What an energy may be off by rounding, J: that of the placed pose through all forces, and that of its own terms.
double energyRounding(const SimbodyMechanism& simbody, const MechanismSample& sample,
                      const MechanismEvidence& evidence) {
  const Mechanism& mechanism = *evidence.scenario->mechanism;
  double size = simbody.energy().kinetic;
  for (Eigen::Index k = 0; k < sample.scale.size(); ++k)
    size += sample.scale(k) * (mechanism.motor(k).slides() ? mechanism.length() : 1);
  const auto bodies = simbody.bodies();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const MechanismBody& body = mechanism.bodies()[b];
    if (!body.fixed)
      size += body.mass * mechanism.gravity().norm() * (bodies[b].displacement * body.center_of_mass).norm();
  }
  return (evidence.level + evidence.levelOfSimbody()) * rounding * sample.condition * sample.condition * size;
}

/// Returns nothing where no motor moves, or where the loops cannot follow to both sides.
std::optional<MechanismPower> powerAt(SimbodyMechanism& simbody, const MechanismSample& sample,
                                      const MechanismEvidence& evidence) {
  constexpr double share = 0.1, sum_of_weights = 2.1;  // 2 (4/5 + 1/5 + 4/105 + 1/280)
  constexpr int halvings = 8;
  const MotorMotion& motion = sample.motion;
  if (motion.qdot.isZero(0)) return std::nullopt;
  simbody.place(motion);
  const std::vector<double> y = simbody.state();
  const double losses = simbody.losses(), rounded = sum_of_weights * energyRounding(simbody, sample, evidence);
  const double length = evidence.scenario->mechanism->length();
  double h = share / std::max(sample.twist_size / length, std::sqrt(sample.twist_rate_size / length));
  double rate = std::nan(""), off = 0, before = std::nan("");
  for (int k = 0; k < halvings && std::isfinite(h); ++k, h /= 2) try {
      const double now = energyRate(simbody, y, motion, h), change = std::abs(now - before);
      before = now;
      if (std::isnan(change)) continue;
      rate = now, off = change + rounded / h;
      if (change <= rounded / h) break;
    } catch (const std::domain_error&) {
      before = std::nan("");
    }
  simbody.setState(motion.t, y.data());
  if (std::isnan(rate)) return std::nullopt;
  MechanismPower out;
  out.t = motion.t;
  out.error = std::abs(sample.subject.dot(motion.qdot) - rate - losses);
  out.size = sample.noc.cwiseProduct(motion.qdot).cwiseAbs().sum();
  out.given = sample.given.dot(motion.qdot.cwiseAbs());
  out.limit = out.given + off;
  for (Eigen::Index k = 0; k < motion.qdot.size(); ++k)
    out.limit +=
        evidence.limit(sample, k, evidence.levelOfSimbody()) / evidence.efforts_in(k) * std::abs(motion.qdot(k));
  return out;
}

}  // namespace

std::vector<MechanismPower> powersOf(const MechanismEvidence& evidence, const Deadline& deadline) {
  constexpr std::size_t instants = 12;  // each takes 16 placements or more
  std::vector<MechanismPower> out;
  SimbodyMechanism simbody(*evidence.scenario->mechanism);
  const std::size_t count = evidence.samples.size(), step = std::max<std::size_t>(1, count / instants);
  for (std::size_t i = 0; i < count; i += step) {
    deadline.require();
    if (const auto power = powerAt(simbody, evidence.samples[i], evidence)) out.push_back(*power);
  }
  return out;
}

}  // namespace ursula
