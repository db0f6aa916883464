// Asks Bullet for efforts of a closed loop as its users do, and lets it step one in time. Debian lacks the headers of
// Bullet's inverse dynamics, so the multibodies give their masses and free accelerations instead.

#include <fmt/format.h>

#include <utility>

#include "parts/engines/bullet/bullet_machine_internal.h"

namespace ursula {
namespace {

using bullet_engine::BulletMachine, bullet_engine::BulletWorld;
using Solver = BulletWorld::Solver;

constexpr double usual_step = 1.0 / 240;  // s, Bullet's default
constexpr int usual_iterations = 10;
constexpr double usual_erp = 0.2, usual_cfm = 0;

class BulletCalls : public LoopEngine {
 public:
  BulletCalls(const Manipulator& manipulator, std::shared_ptr<const Load> load)
      : LoopEngine(manipulator), machine_(manipulator), load_(std::move(load)) {}

  const PlacedTree& tree(const Motion<double>& motion, Bias bias) override {
    machine_.set(motion, bias == Bias::kept);
    machine_.readMaps(tree_);
    for (int i = 0; i < manipulator().legCount(); ++i) {
      const LegMotion& state = machine_.leg(i);
      const Leg& leg = manipulator().leg(i);
      Vector3d& force = tree_.legs[static_cast<std::size_t>(i)].force;
      force = machine_.forces(i, state.accelerations) - frictionOn(leg, state.rates);
      for (int j = 0; j < 3; ++j) force(j) += rotorForce(leg, j, state.accelerations(j));
    }
    const ChainBody body = platformOf(motion);
    Vector6d u_dot;
    u_dot << motion.omega_dot, body.accelerationOf(body.frame * manipulator().platform().center_of_mass);
    tree_.force = machine_.platformForces(u_dot) - machine_.wrenchOf(load_.get(), motion.t);
    return tree_;
  }

  /// The solver is direct, so it has no iterations.
  std::vector<Rigidity> rigidities() const override {
    const auto of = [](const char* name, double step, double iterations, double erp, double cfm) {
      return Rigidity{name, step, 0, {{"iterations", iterations}, {"erp", erp}, {"cfm", cfm}}};
    };
    return {of("default", usual_step, usual_iterations, usual_erp, usual_cfm),
            of("many iterations", usual_step, 1000, usual_erp, usual_cfm),
            of("direct solver", usual_step, 0, usual_erp, usual_cfm),
            of("direct and short step", 0.001, 0, usual_erp, usual_cfm)};
  }

  std::unique_ptr<SteppedLoop> stepped(const Rigidity& rigidity) const override {
    return steppedMachine("Bullet", manipulator(), load_, rigidity.step,
                          [from = manipulator(), set = rigidity.settings](const Motion<double>& start) {
                            auto out = std::make_unique<BulletMachine>(from);
                            const int iterations = static_cast<int>(set[0].second);
                            out->world = std::make_unique<BulletWorld>(
                                *out, iterations > 0 ? Solver::gauss_seidel : Solver::dantzig, iterations,
                                set[1].second, set[2].second);
                            out->set(start, true);
                            return out;
                          });
  }

 protected:
  /// Steps once from the motion's own rates; the motors bring the coordinates to the rates at the step's end.
  Vector6d ownInverse(const Motion<double>& motion, bool hard) override {
    const double h = hard ? 1e-3 * usual_step : usual_step;
    machine_.world.reset();
    machine_.world = std::make_unique<BulletWorld>(machine_, hard ? Solver::dantzig : Solver::gauss_seidel,
                                                   usual_iterations, usual_erp, usual_cfm);
    machine_.set(motion, true);
    machine_.addFrictionAndLoad(load_.get(), motion.t);
    const Motors& motors = manipulator().motors();
    for (const Motor& motor : motors) {
      const LegMotion& state = machine_.leg(motor.leg);
      machine_.world->drive(motor.leg, motor.joint, state.rates(motor.joint) + h * state.accelerations(motor.joint));
    }
    machine_.step(h);
    Vector6d out;
    for (std::size_t m = 0; m < motors.size(); ++m) {
      const auto& [leg, joint, coordinate] = motors[m];
      out(static_cast<int>(m)) = machine_.world->effort(m, h) +
                                 rotorForce(manipulator().leg(leg), joint, machine_.leg(leg).accelerations(joint));
    }
    return out;
  }

 private:
  BulletMachine machine_;
  std::shared_ptr<const Load> load_;
  PlacedTree tree_;
};

std::unique_ptr<LoopEngine> makeBulletCalls(const Manipulator& manipulator, std::shared_ptr<const Load> load) {
  return std::make_unique<BulletCalls>(manipulator, std::move(load));
}

std::string versionOfBullet() { return fmt::format("{}.{:02}", btGetVersion() / 100, btGetVersion() % 100); }
const std::string bullet_version = versionOfBullet();

}  // namespace
}  // namespace ursula

extern "C" __attribute__((visibility("default")))
const ursula::EngineModule ursula_engine_module = {ursula::bullet_version.c_str(), ursula::makeBulletCalls};
