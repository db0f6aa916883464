// Asks MuJoCo for efforts of a closed loop as its users do, and lets it step one in time.

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <utility>

#include "parts/engines/closing.h"
#include "parts/engines/loop_engine.h"
#include "parts/engines/mujoco/mujoco_loop_internal.h"

namespace ursula {
namespace {

using mujoco::Connected, mujoco::dofOf, mujoco::VectorOfDofs;

/// MuJoCo's constraint parameters: solref has time constant and damping ratio; solimp has the impedance's minimum,
/// maximum and shape.
struct Softness {
  std::array<mjtNum, mjNREF> solref{};
  std::array<mjtNum, mjNIMP> solimp{};
};

Softness defaultSoftness() {
  Softness out;
  mj_defaultSolRefImp(out.solref.data(), out.solimp.data());
  return out;
}

constexpr double default_step = 0.002;  // s, MuJoCo's default

Rigidity rigidity(const std::string& name, double step, const Softness& softness) {
  return {name,
          step,
          0,
          {{"solref_timeconst", softness.solref[0]},
           {"solref_dampratio", softness.solref[1]},
           {"solimp_dmin", softness.solimp[0]},
           {"solimp_dmax", softness.solimp[1]}}};
}

Softness softnessOf(const Rigidity& rigidity) {
  Softness out = defaultSoftness();
  out.solref = {rigidity.settings.at(0).second, rigidity.settings.at(1).second};
  out.solimp[0] = rigidity.settings.at(2).second;
  out.solimp[1] = rigidity.settings.at(3).second;
  return out;
}

/// MuJoCo gives the sites' positions in the world's axes.
void readGaps(const mjData& data, int legs, PlacedTree& out) {
  for (int i = 0; i < legs; ++i)
    out.gaps[i] = Eigen::Map<const Vector3d>(data.site_xpos + 3 * mujoco::siteOnLeg(i)) -
                  Eigen::Map<const Vector3d>(data.site_xpos + 3 * mujoco::siteOnPlatform(legs, i));
}

/// Builds the machine at a pose, with loops that MuJoCo's `connect` closes at this softness.
Connected connected(const Manipulator& manipulator, const Vector3d& origin, const mjtNum* pose,
                    const Rigidity& rigidity) {
  const Softness softness = softnessOf(rigidity);
  Connected out = mujoco::connected(manipulator, origin, pose);
  for (int leg = 0; leg < manipulator.legCount(); ++leg) {
    std::copy(softness.solref.begin(), softness.solref.end(), out.model->eq_solref + mjNREF * leg);
    std::copy(softness.solimp.begin(), softness.solimp.end(), out.model->eq_solimp + mjNIMP * leg);
  }
  out.model->opt.timestep = rigidity.step;
  return out;
}

}  // namespace

/// MuJoCo raises time constants below two steps to two steps.
class MujocoStepped : public SteppedLoop {
 public:
  MujocoStepped(const Manipulator& manipulator, std::shared_ptr<const Load> load, const Rigidity& rigidity)
      : loop_(manipulator, std::move(load)), at_(loop_.impl()), rigidity_(rigidity) {}

  void start(const Motion<double>& motion) override {
    at_.place(motion);
    at_.move(motion);
    own_ = connected(at_.manipulator, at_.origin, at_.data->qpos, rigidity_);
    own_.model->opt.enableflags |= mjENBL_ENERGY;
    std::copy_n(at_.data->qpos, own_.model->nq, own_.data->qpos);
    std::copy_n(at_.data->qvel, own_.model->nv, own_.data->qvel);
    own_.data->time = motion.t;
    mj_forward(own_.model.get(), own_.data.get());
  }

  /// Friction and load are held over the step, too.
  void step(const Vector6d& efforts) override {
    mjData& data = *own_.data;
    VectorOfDofs applied = at_.given(*own_.model, data, platform());
    for (int m = 0; m < motor_count; ++m) {
      const Motor& motor = at_.manipulator.motors()[m];
      applied(dofOf(motor.leg, motor.joint)) += efforts(m);
    }
    std::copy_n(applied.data(), at_.dofs, data.qfrc_applied);
    mj_step(own_.model.get(), &data);
  }

  void read(State& out) override {
    out.q = forMotors(at_.manipulator, [&](const Motor& motor) {
      return own_.data->qpos[dofOf(motor.leg, motor.joint)] - (motor.joint == 0 ? at_.offset_of_phi[motor.leg] : 0);
    });
    mj_forward(own_.model.get(), own_.data.get());  // after a step only the positions are up to date
    out.p = platform().p;
    out.energy = own_.data->energy[0] + own_.data->energy[1];
    out.power =
        at_.given(*own_.model, *own_.data, platform()).dot(Eigen::Map<const VectorOfDofs>(own_.data->qvel, at_.dofs));
    at_.readMaps(*own_.model, *own_.data, out.tree);
    readGaps(*own_.data, at_.legs, out.tree);
  }

 private:
  /// Returns the instant and pose for load and friction.
  Motion<double> platform() const {
    Motion<double> out;
    out.t = own_.data->time;
    const double* q = own_.data->qpos + at_.leg_dofs;
    out.Q = Eigen::Quaterniond(q[3], q[4], q[5], q[6]).toRotationMatrix();
    out.p = at_.origin + Eigen::Map<const Vector3d>(q) - out.Q * at_.manipulator.platform().center_of_mass;
    return out;
  }

  MujocoLoop loop_;
  MujocoLoop::Impl& at_;
  Rigidity rigidity_;
  Connected own_;  ///< made at the start's pose
};

class MujocoCalls : public LoopEngine {
 public:
  MujocoCalls(const Manipulator& manipulator, std::shared_ptr<const Load> load)
      : LoopEngine(manipulator), load_(load), loop_(manipulator, std::move(load)), at_(loop_.impl()) {}

  const PlacedTree& tree(const Motion<double>& motion, Bias bias) override {
    at_.place(motion);
    at_.move(motion);
    if (bias == Bias::left_out) {
      Eigen::Map<VectorOfDofs> accelerations(at_.data->qacc, at_.dofs);
      accelerations.head(at_.leg_dofs) =
          -at_.G.leftCols(at_.leg_dofs).partialPivLu().solve(at_.G.rightCols<6>() * accelerations.tail<6>());
    }
    at_.readTree(motion, at_.forcesOfTree(), tree_);
    readGaps(*at_.data, at_.legs, tree_);
    return tree_;
  }

  std::vector<Rigidity> rigidities() const override {
    const Softness soft = defaultSoftness();
    Softness fast = soft, stiff = soft;
    fast.solref[0] = 2 * default_step;
    stiff.solimp[0] = stiff.solimp[1] = mjMAXIMP;
    Softness both = fast, short_step = stiff;
    both.solimp = stiff.solimp;
    short_step.solref[0] = default_step / 2;
    return {rigidity("default", default_step, soft), rigidity("shortest time constant", default_step, fast),
            rigidity("largest impedance", default_step, stiff), rigidity("both", default_step, both),
            rigidity("both at a quarter of the step", default_step / 4, short_step)};
  }

  std::unique_ptr<SteppedLoop> stepped(const Rigidity& rigidity) const override {
    return std::make_unique<MujocoStepped>(manipulator(), load_, rigidity);
  }

 protected:
  Vector6d ownInverse(const Motion<double>& motion, bool hard) override {
    Connected& own = hard ? hard_ : soft_;
    at_.place(motion);
    at_.move(motion);
    if (!own.model)
      own = connected(manipulator(), at_.origin, at_.data->qpos, hard ? rigidities().back() : rigidities().front());
    std::copy_n(at_.data->qpos, own.model->nq, own.data->qpos);
    std::copy_n(at_.data->qvel, at_.dofs, own.data->qvel);
    std::copy_n(at_.data->qacc, at_.dofs, own.data->qacc);
    mj_inverse(own.model.get(), own.data.get());
    const VectorOfDofs forces =
        Eigen::Map<const VectorOfDofs>(own.data->qfrc_inverse, at_.dofs) - at_.given(*own.model, *own.data, motion);
    return forMotors(manipulator(), [&](const Motor& motor) { return forces(dofOf(motor.leg, motor.joint)); });
  }

 private:
  std::shared_ptr<const Load> load_;
  MujocoLoop loop_;
  MujocoLoop::Impl& at_;
  PlacedTree tree_;
  Connected soft_, hard_;  ///< made at the pose of their first use
};

std::unique_ptr<LoopEngine> makeMujocoCalls(const Manipulator& manipulator, std::shared_ptr<const Load> load) {
  return std::make_unique<MujocoCalls>(manipulator, std::move(load));
}

}  // namespace ursula
