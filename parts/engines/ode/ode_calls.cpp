// Asks ODE for efforts of a closed loop as its users do, and lets it step one in time. ODE has no inverse dynamics: a
// step with driven joints takes its place.

#include <Eigen/Cholesky>
#include <utility>

#include "parts/engines/closing.h"
#include "parts/engines/ode/ode_machine_internal.h"

namespace ursula {
namespace {

using ode_engine::OdeMachine, ode_engine::Softness;

constexpr Softness usual = {0.2, 1e-10};  // ODE's defaults in double precision
constexpr double usual_step = 0.001;      // s

class OdeCalls : public LoopEngine {
 public:
  OdeCalls(const Manipulator& manipulator, std::shared_ptr<const Load> load)
      : LoopEngine(manipulator), load_(std::move(load)) {}

  const PlacedTree& tree(const Motion<double>& motion, Bias bias) override {
    OdeMachine& machine = machineFor(tree_machine_, motion, OdeMachine::Loops::open, {});
    stepTo(machine, motion, bias);
    for (int i = 0; i < manipulator().legCount(); ++i)
      for (int j = 0; j < 3; ++j) tree_.legs[static_cast<std::size_t>(i)].force(j) = effort(machine, i, j);
    setPlatform(motion);
    machine.set(motion, true);
    machine.readMaps(tree_);
    return tree_;
  }

  /// ODE has no default step.
  std::vector<Rigidity> rigidities() const override {
    const auto of = [](const char* name, double step, double erp, double cfm, double quick) {
      return Rigidity{name, step, 0, {{"erp", erp}, {"cfm", cfm}, {"quick_iterations", quick}}};
    };
    return {of("default", usual_step, usual.erp, usual.cfm, 0),
            of("all of the error a step", usual_step, 1, usual.cfm, 0), of("soft", usual_step, usual.erp, 1e-6, 0),
            of("quick step", usual_step, usual.erp, usual.cfm, 20),
            of("twice the step", 2 * usual_step, usual.erp, usual.cfm, 0)};
  }

  std::unique_ptr<SteppedLoop> stepped(const Rigidity& rigidity) const override {
    return steppedMachine("ODE", manipulator(), load_, rigidity.step,
                          [from = manipulator(), set = rigidity.settings](const Motion<double>& start) {
                            auto out = std::make_unique<OdeMachine>(from, start, OdeMachine::Loops::closed,
                                                                    Softness{set[0].second, set[1].second});
                            out->quick_iterations = static_cast<int>(set[2].second);
                            return out;
                          });
  }

 protected:
  /// Steps once from the motion's own twists; the motors bring the coordinates to the rates at the step's end.
  Vector6d ownInverse(const Motion<double>& motion, bool hard) override {
    OdeMachine& machine = hard ? machineFor(hard_machine_, motion, OdeMachine::Loops::closed, {usual.erp, 0})
                               : machineFor(soft_machine_, motion, OdeMachine::Loops::closed, usual);
    const double h = hard ? 1e-3 * usual_step : usual_step;
    machine.set(motion, true);
    machine.addFrictionAndLoad(load_.get(), motion.t);
    for (const Motor& motor : manipulator().motors())
      machine.drive(motor.leg, motor.joint,
                    machine.leg(motor.leg).rates(motor.joint) + h * machine.leg(motor.leg).accelerations(motor.joint));
    machine.step(h);
    return forMotors(manipulator(), [&](const Motor& motor) { return effort(machine, motor.leg, motor.joint); });
  }

 private:
  OdeMachine& machineFor(std::unique_ptr<OdeMachine>& machine, const Motion<double>& motion, OdeMachine::Loops loops,
                         const Softness& softness) {
    if (!machine) machine = std::make_unique<OdeMachine>(manipulator(), motion, loops, softness);
    return *machine;
  }

  /// Every coordinate has a motor. A step from v − h a to v gives the forces for the acceleration a exactly, whatever h
  /// is, because v satisfies the joints' constraints at this pose.
  void stepTo(OdeMachine& machine, const Motion<double>& motion, Bias bias) {
    constexpr double h = 1;  // s
    machine.set(motion, bias == Bias::kept);
    for (int i = 0; i < manipulator().legCount(); ++i)
      for (int j = 0; j < 3; ++j) machine.drive(i, j, machine.leg(i).rates(j));
    machine.addFrictionAndLoad(load_.get(), motion.t);
    machine.addGyroscopic();
    machine.goBack(h);
    machine.step(h);
  }

  /// The effort of the last step, with the rotor's.
  double effort(const OdeMachine& machine, int leg, int j) const {
    return machine.effort(leg, j) + rotorForce(manipulator().leg(leg), j, machine.leg(leg).accelerations(j));
  }

  /// The platform's force follows from Newton and Euler, because no joint of ODE acts on it.
  void setPlatform(const Motion<double>& motion) {
    const Platform& of = manipulator().platform();
    const ChainBody body = platformOf(motion);
    const Vector3d r = motion.Q * of.center_of_mass;
    const Matrix3d inertia = motion.Q * of.inertia * motion.Q.transpose();
    const Vector3d force = of.mass * (body.accelerationOf(motion.p + r) - manipulator().gravity());
    const Vector3d spin = inertia * motion.omega;
    tree_.force << inertia * motion.omega_dot + motion.omega.cross(spin) + r.cross(force), force;
    tree_.force -= loadInBase(load_.get(), motion.t, motion.Q);
  }

  std::shared_ptr<const Load> load_;
  std::unique_ptr<OdeMachine> tree_machine_, soft_machine_, hard_machine_;
  PlacedTree tree_;
};

std::unique_ptr<LoopEngine> makeOdeCalls(const Manipulator& manipulator, std::shared_ptr<const Load> load) {
  return std::make_unique<OdeCalls>(manipulator, std::move(load));
}

}  // namespace
}  // namespace ursula

extern "C" __attribute__((visibility("default")))
const ursula::EngineModule ursula_engine_module = {dODE_VERSION, ursula::makeOdeCalls};
