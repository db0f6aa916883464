#include "validation/samples/simbody_samples.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "simbody/simbody_loop.h"
#include "validation/limits/engine_view.h"

namespace ursula {
namespace {

/// Approximate number of samples to use, because the mass matrix varies slowly.
constexpr std::size_t instants_of_direct = 31;
/// The pose moves by this share of the machine's length, less near singular poses, and the velocity by as much per
/// second. Errors in the accelerations' derivatives then exceed rounding.
constexpr double off_path = 1e-3;

DirectAnswer answerOf(SimbodyLoop& loop, const Motion<double>& state, const Vector6d& torques) {
  loop.accelerate(torques);
  const Motion<double> found = loop.platform();
  DirectAnswer out{state, torques, {}};
  out.twist_rate << found.omega_dot, found.p_ddot;
  return out;
}

/// A deviation that differs in every coordinate and from instant to instant.
Motion<double> deviated(const Conditions& sample, double sign) {
  const Conditioning& at = sample.conditioning;
  Eigen::Matrix<double, 12, 1> direction;
  for (int i = 0; i < 12; ++i) direction(i) = std::cos(1.0 + 2.3 * i + sample.motion.t);
  direction *= sign * off_path / direction.norm();
  const double pose = at.smallest_sine / at.kappa_B;
  Motion<double> out = sample.motion;
  const Vector3d turn = pose * direction.segment<3>(3);
  out.p += pose * at.length * direction.head<3>();
  out.Q = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * out.Q;
  out.p_dot += at.length * direction.segment<3>(6);
  out.omega += direction.tail<3>();
  return out;
}

}  // namespace

std::vector<DirectSample> runDirect(const Scenario& scenario, const std::vector<Conditions>& conditions,
                                    const std::vector<SimbodyAnswer>& simbody) {
  SimbodyLoop loop(*scenario.manipulator, SimbodyLoop::Topology::ball_per_leg, scenario.load);
  const std::size_t stride = std::max<std::size_t>(1, conditions.size() / instants_of_direct);
  std::vector<DirectSample> out;
  for (std::size_t k = 0; k < conditions.size(); k += stride) {
    const Vector6d& commanded = simbody[k].torques;
    DirectSample here;
    here.sample = k;
    loop.place(conditions[k].motion);
    for (std::size_t set = 0; set < here.commanded.size(); ++set) {
      Vector6d torques = commanded;
      if (set > 0) torques(static_cast<Eigen::Index>(set) - 1) += commanded.cwiseAbs().maxCoeff();
      here.commanded[set] = answerOf(loop, conditions[k].motion, torques);
    }
    for (const double sign : {1.0, -1.0}) try {
        const Motion<double> state = deviated(conditions[k], sign);
        loop.place(state);
        here.off_path.push_back(answerOf(loop, state, commanded));
      } catch (const std::domain_error&) {  // a leg cannot reach
      }
    out.push_back(here);
  }
  return out;
}

template <class Sample>
std::vector<ReactionSample> runReactions(const Scenario& scenario, const Subject& subject,
                                         const std::vector<Sample>& samples) {
  SimbodyLoop loop(*scenario.manipulator, SimbodyLoop::Topology::ball_per_leg, scenario.load);
  std::vector<ReactionSample> out(samples.size());
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const Motion<double>& motion = samples[k].motion;
    out[k].recovered = subject.reactions(motion);
    loop.place(motion);
    loop.accelerate(subject.torques(motion));
    const Reactions simbody = loop.reactions();
    for (std::size_t leg = 0; leg < leg_count; ++leg)
      out[k].errors[leg] = distance(out[k].recovered[leg], simbody[leg], samples[k].conditioning.length);
  }
  return out;
}

template std::vector<ReactionSample> runReactions(const Scenario&, const Subject&, const std::vector<Conditions>&);
template std::vector<ReactionSample> runReactions(const Scenario&, const Subject&, const std::vector<PointwiseSample>&);

}  // namespace ursula
