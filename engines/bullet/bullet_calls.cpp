// Asks Bullet for efforts of a closed loop as its users do, and lets it step one in time. Debian lacks the headers of
// Bullet's inverse dynamics, so the multibodies give their masses and free accelerations instead.

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "engines/bullet/bullet_machine_internal.h"
#include "engines/engine_module.h"

namespace ursula {
namespace {

using bullet_engine::BulletMachine, bullet_engine::BulletWorld;
using Solver = BulletWorld::Solver;

constexpr double usual_step = 1.0 / 240;  // s, Bullet's default
constexpr int usual_iterations = 10;
constexpr double usual_erp = 0.2, usual_cfm = 0;

class BulletStepped : public SteppedLoop {
 public:
  BulletStepped(const Manipulator& manipulator, std::shared_ptr<const Load> load, const Rigidity& rigidity)
      : machine_(manipulator),
        load_(std::move(load)),
        step_(rigidity.step),
        world_(machine_, rigidity.settings[0].second > 0 ? Solver::gauss_seidel : Solver::dantzig,
               static_cast<int>(rigidity.settings[0].second), rigidity.settings[1].second,
               rigidity.settings[2].second) {
    for (const Motor& motor : manipulator.motors())
      if (manipulator.leg(motor.leg).rotor_inertia.on(motor.coordinate) != 0)
        throw std::runtime_error("Bullet moves no rotors");
  }

  void start(const Motion<double>& motion) override {
    time_ = motion.t;
    machine_.set(motion, true);
  }

  void step(const Vector6d& efforts) override {
    machine_.addFrictionAndLoad(load_.get(), time_);
    for (int m = 0; m < motor_count; ++m) machine_.body(motor(m).leg).addJointTorque(motor(m).joint, efforts(m));
    world_.step(step_);
    time_ += step_;
  }

  void read(State& out) override {
    for (int m = 0; m < motor_count; ++m) out.q(m) = machine_.body(motor(m).leg).getJointPos(motor(m).joint);
    out.p = machine_.position();
    out.energy = machine_.energy();
    out.power = machine_.powerOfFrictionAndLoad(load_.get(), time_);
    machine_.readMaps(out.tree);
  }

 private:
  const Motor& motor(int m) const { return machine_.manipulator.motors()[static_cast<std::size_t>(m)]; }

  BulletMachine machine_;
  std::shared_ptr<const Load> load_;
  double step_ = 0, time_ = 0;
  BulletWorld world_;
};

class BulletCalls : public LoopEngine {
 public:
  BulletCalls(const Manipulator& manipulator, std::shared_ptr<const Load> load)
      : LoopEngine(manipulator), machine_(manipulator), load_(std::move(load)) {}

  const PlacedTree& tree(const Motion<double>& motion, Bias bias) override {
    machine_.set(motion, bias == Bias::kept);
    machine_.readMaps(tree_);
    for (int i = 0; i < manipulator().legCount(); ++i) {
      const LegState& state = machine_.leg(i);
      const Leg& leg = manipulator().leg(i);
      Vector3d& force = tree_.legs[static_cast<std::size_t>(i)].force;
      force = machine_.forces(i, state.accelerations) - frictionOn(leg, state.rates);
      for (int j = 0; j < 3; ++j)
        force(j) +=
            leg.rotor_inertia.on(rowOf(leg.kind).coordinates[static_cast<std::size_t>(j)]) * state.accelerations(j);
    }
    const ChainBody body = platformOf(motion);
    Vector6d u_dot;
    u_dot << motion.omega_dot, body.accelerationOf(body.frame * manipulator().platform().center_of_mass);
    tree_.force = machine_.platformForces(u_dot) - machine_.loadAtCenter(load_.get(), motion.t);
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
    return std::make_unique<BulletStepped>(manipulator(), load_, rigidity);
  }

 protected:
  /// Steps once from the motion's own rates; the motors bring the coordinates to the rates at the step's end.
  Vector6d ownInverse(const Motion<double>& motion, bool hard) override {
    const double h = hard ? 1e-3 * usual_step : usual_step;
    BulletWorld world(machine_, hard ? Solver::dantzig : Solver::gauss_seidel, usual_iterations, usual_erp, usual_cfm);
    machine_.set(motion, true);
    machine_.addFrictionAndLoad(load_.get(), motion.t);
    const Motors& motors = manipulator().motors();
    for (const Motor& motor : motors) {
      const LegState& state = machine_.leg(motor.leg);
      world.drive(motor.leg, motor.joint, state.rates(motor.joint) + h * state.accelerations(motor.joint));
    }
    world.step(h);
    Vector6d out;
    for (std::size_t m = 0; m < motors.size(); ++m)
      out(static_cast<int>(m)) =
          world.effort(m, h) + manipulator().leg(motors[m].leg).rotor_inertia.on(motors[m].coordinate) *
                                   machine_.leg(motors[m].leg).accelerations(motors[m].joint);
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
