#include "validation/samples/direct_samples.h"

#include <algorithm>

#include "model/loops/simbody/simbody_loop.h"

namespace ursula {
namespace {

/// Of the samples, about as many: the mass matrix changes slowly.
constexpr std::size_t instants_of_direct = 31;

Vector6d accelerationsOf(SimbodyLoop& loop, const Vector6d& torques) {
  loop.accelerate(torques);
  const Motion<double> found = loop.platform();
  Vector6d out;
  out << found.omega_dot, found.p_ddot;
  return out;
}

}  // namespace

std::vector<DirectSample> runDirect(const Scenario& scenario, const std::vector<PointwiseSample>& samples) {
  SimbodyLoop loop(*scenario.manipulator, SimbodyLoop::Topology::six_balls, scenario.load);
  const std::size_t stride = std::max<std::size_t>(1, samples.size() / instants_of_direct);
  std::vector<DirectSample> out;
  for (std::size_t k = 0; k < samples.size(); k += stride) {
    const Vector6d& commanded = samples[k].torques_simbody;
    loop.place(samples[k].motion);
    DirectSample here;
    here.sample = k;
    for (std::size_t set = 0; set < here.torques.size(); ++set) {
      here.torques[set] = commanded;
      if (set > 0) here.torques[set](static_cast<Eigen::Index>(set) - 1) += commanded.cwiseAbs().maxCoeff();
      here.accelerations[set] = accelerationsOf(loop, here.torques[set]);
    }
    out.push_back(here);
  }
  return out;
}

}  // namespace ursula
