// Asks DART for efforts of a closed loop as its users do, and lets it step one in time.

#include <dart/config.hpp>
#include <dart/constraint/DynamicJointConstraint.hpp>
#include <stdexcept>
#include <utility>

#include "parts/engines/closing.h"
#include "parts/engines/dart/dart_machine_internal.h"
#include "parts/engines/dart/dart_tree_internal.h"

namespace ursula {
namespace {

using dart::constraint::DynamicJointConstraint;
using dart_engine::DartMachine;

class DartStepped : public SteppedLoop {
 public:
  DartStepped(const Manipulator& manipulator, std::shared_ptr<const Load> load, const Rigidity& rigidity)
      : manipulator_(manipulator), load_(std::move(load)), rigidity_(rigidity) {
    if (hasRotors(manipulator)) throw std::runtime_error("DART moves no rotors");
  }

  void start(const Motion<double>& motion) override {
    time_ = motion.t;
    machine_ = std::make_unique<DartMachine>(manipulator_);
    machine_->move(motion, true);
    machine_->close(rigidity_);
  }

  void step(const Vector6d& efforts) override {
    machine_->addFrictionAndLoad(load_.get(), time_);
    for (int m = 0; m < motor_count; ++m) {
      const Motor& motor = manipulator_.motors()[static_cast<std::size_t>(m)];
      machine_->addEffort(motor.leg, motor.joint, efforts(m));
    }
    machine_->step();
    time_ += rigidity_.step;
  }

  void read(State& out) override {
    out.q = forMotors(manipulator_, [&](const Motor& motor) { return machine_->coordinate(motor.leg, motor.joint); });
    out.p = machine_->platform->getWorldTransform().translation();
    out.energy = machine_->energy();
    out.power = machine_->powerOfFrictionAndLoad(load_.get(), time_);
    machine_->readMaps(out.tree);
  }

 private:
  Manipulator manipulator_;
  std::shared_ptr<const Load> load_;
  Rigidity rigidity_;
  double time_ = 0;
  std::unique_ptr<DartMachine> machine_;
};

class DartCalls : public LoopEngine {
 public:
  DartCalls(const Manipulator& manipulator, std::shared_ptr<const Load> load)
      : LoopEngine(manipulator), machine_(manipulator), load_(std::move(load)) {}

  const PlacedTree& tree(const Motion<double>& motion, Bias bias) override {
    machine_.move(motion, bias == Bias::kept);
    machine_.readMaps(tree_);
    machine_.skeleton->computeInverseDynamics();
    for (int i = 0; i < manipulator().legCount(); ++i) {
      const Vector3d acts = machine_.friction(i);
      const auto index = static_cast<std::size_t>(i);
      const auto& coordinates = rowOf(manipulator().leg(i).kind).coordinates;
      for (int j = 0; j < 3; ++j) {
        const auto [joint, which] = machine_.legs[index].place(j);
        tree_.legs[index].force(j) = joint->getForce(which) - acts(j) +
                                     manipulator().leg(i).rotor_inertia.on(coordinates[static_cast<std::size_t>(j)]) *
                                         joint->getAcceleration(which);
      }
    }
    const Vector6d load = loadInBase(load_.get(), motion.t, motion.Q);
    for (std::size_t k = 0; k < 6; ++k) tree_.force(static_cast<int>(k)) = machine_.free->getForce(k);
    tree_.force.head<3>() -= motion.Q.transpose() * load.head<3>();
    tree_.force.tail<3>() -= motion.Q.transpose() * load.tail<3>();
    return tree_;
  }

  std::vector<Rigidity> rigidities() const override {
    const double erp = DynamicJointConstraint::getErrorReductionParameter(),
                 cfm = DynamicJointConstraint::getConstraintForceMixing();
    constexpr double step = 0.001;  // s, DART's default
    const auto of = [](const char* name, double over, double e, double c) {
      return Rigidity{name, over, 0, {{"erp", e}, {"cfm", c}}};
    };
    return {of("default", step, erp, cfm), of("all of the error a step", step, 1, cfm),
            of("a hundredth mixed in", step, erp, 0.01), of("twice the step", 2 * step, erp, cfm)};
  }

  std::unique_ptr<SteppedLoop> stepped(const Rigidity& rigidity) const override {
    return std::make_unique<DartStepped>(manipulator(), load_, rigidity);
  }

 private:
  DartMachine machine_;
  std::shared_ptr<const Load> load_;
  PlacedTree tree_;
};

std::unique_ptr<LoopEngine> makeCalls(const Manipulator& manipulator, std::shared_ptr<const Load> load) {
  return std::make_unique<DartCalls>(manipulator, std::move(load));
}

}  // namespace
}  // namespace ursula

extern "C" __attribute__((visibility("default")))
const ursula::EngineModule ursula_engine_module = {DART_VERSION, ursula::makeCalls, ursula::dart_engine::buildTree};
