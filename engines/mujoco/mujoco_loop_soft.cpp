// Direct dynamics with MuJoCo's own constraints, which are soft by design.

#include <algorithm>
#include <stdexcept>

#include "engines/mujoco/mujoco_loop_internal.h"

namespace ursula {

using mujoco::dofOf;

double MujocoLoop::softImpedance() { return mjMAXIMP; }

Vector6d MujocoLoop::softTwistRate(const TreeCoordinates& at, const Vector6d& efforts) {
  Impl& loop = *impl_;
  if (!loop.connected.model) {
    loop.connected.model = mujoco::buildModel(loop.manipulator, loop.origin, mujoco::Closure::connected);
    loop.connected.data.reset(mj_makeData(loop.connected.model.get()));
    if (!loop.connected.data) throw std::runtime_error("MuJoCo: no memory for its data");
  }
  const mjModel* model = loop.connected.model.get();
  mjData* data = loop.connected.data.get();
  std::copy(at.q.begin(), at.q.end(), data->qpos);
  std::copy(at.u.begin(), at.u.end(), data->qvel);
  const mujoco::VectorOfDofs given = loop.given(*model, *data, at.motion);
  std::copy_n(given.data(), loop.dofs, data->qfrc_applied);
  for (int m = 0; m < motor_count; ++m) {
    const Motor& motor = loop.manipulator.motors()[static_cast<std::size_t>(m)];
    data->qfrc_applied[dofOf(motor.leg, motor.joint)] += efforts(m);
  }
  mj_forward(model, data);
  return loop.twistRate(at.motion, Eigen::Map<const Vector6d>(data->qacc + loop.leg_dofs));
}

}  // namespace ursula
