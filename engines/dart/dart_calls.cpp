// Asks DART for efforts of a closed loop as its users do, and lets it step one in time.

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <dart/config.hpp>
#include <dart/constraint/BallJointConstraint.hpp>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/simulation/World.hpp>
#include <stdexcept>
#include <utility>

#include "engines/dart/dart_machine_internal.h"
#include "engines/engine_module.h"
#include "engines/leg_motion.h"
#include "engines/loop_engine.h"

namespace ursula {
namespace {

namespace dd = dart::dynamics;
using dart::constraint::DynamicJointConstraint;
using dart_engine::DartLeg, dart_engine::DartMachine;

/// DART's world moves the loop, with its ball constraints and semi-implicit steps.
class DartStepped : public SteppedLoop {
 public:
  DartStepped(const Manipulator& manipulator, std::shared_ptr<const Load> load, const Rigidity& rigidity)
      : machine_(manipulator), load_(std::move(load)), rigidity_(rigidity), world_(dart::simulation::World::create()) {
    for (const Motor& motor : manipulator.motors())
      if (manipulator.leg(motor.leg).rotor_inertia.on(motor.coordinate) != 0)
        throw std::runtime_error("DART moves no rotors");
    world_->setGravity(manipulator.gravity());
    world_->setTimeStep(rigidity.step);
    world_->addSkeleton(machine_.skeleton);
  }

  void start(const Motion<double>& motion) override {
    machine_.move(motion, true);
    chooseUnit();
    world_->setTime(motion.t);
    for (std::size_t i = 0; i < machine_.legs.size(); ++i) {
      const DartLeg& leg = machine_.legs[i];
      world_->getConstraintSolver()->addConstraint(std::make_shared<dart::constraint::BallJointConstraint>(
          leg.distal, machine_.platform, leg.distal->getWorldTransform() * leg.tip));
    }
  }

  /// DART's constants are global, so each step sets them.
  void step(const Vector6d& efforts) override {
    DynamicJointConstraint::setErrorReductionParameter(rigidity_.settings.at(0).second);
    DynamicJointConstraint::setConstraintForceMixing(rigidity_.settings.at(1).second);
    for (std::size_t i = 0; i < machine_.legs.size(); ++i) {
      const Vector3d acts = machine_.friction(static_cast<int>(i));
      for (std::size_t j = 0; j < 3; ++j) {
        const auto [joint, which] = machine_.legs[i].place(j);
        joint->setForce(which, unit_ * acts(static_cast<int>(j)));
      }
    }
    for (int m = 0; m < motor_count; ++m) {
      const auto [joint, which] = place(m);
      joint->setForce(which, joint->getForce(which) + unit_ * efforts(m));
    }
    const Vector6d load =
        unit_ * loadInBase(load_.get(), world_->getTime(), machine_.platform->getWorldTransform().linear());
    machine_.platform->addExtForce(load.tail<3>(), Vector3d::Zero(), false, true);
    machine_.platform->addExtTorque(load.head<3>(), false);
    world_->step();
    if (!machine_.skeleton->getPositions().allFinite()) throw std::runtime_error("DART's state is not finite");
  }

  void read(State& out) override {
    for (int m = 0; m < motor_count; ++m) {
      const auto [joint, which] = place(m);
      out.q(m) = joint->getPosition(which);
    }
    // DART's own potential energy assumes masses at the bodies' origins.
    const dd::SkeletonPtr& skeleton = machine_.skeleton;
    out.energy =
        (skeleton->computeKineticEnergy() - skeleton->getMass() * world_->getGravity().dot(skeleton->getCOM())) / unit_;
    out.p = machine_.platform->getWorldTransform().translation();
    const Vector6d load = loadInBase(load_.get(), world_->getTime(), machine_.platform->getWorldTransform().linear());
    out.power = load.head<3>().dot(machine_.platform->getAngularVelocity()) +
                load.tail<3>().dot(machine_.platform->getLinearVelocity());
    for (std::size_t i = 0; i < machine_.legs.size(); ++i) {
      const Vector3d acts = machine_.friction(static_cast<int>(i));
      for (std::size_t j = 0; j < 3; ++j) {
        const auto [joint, which] = machine_.legs[i].place(j);
        out.power += acts(static_cast<int>(j)) * joint->getVelocity(which);
      }
    }
    machine_.readMaps(out.tree);
  }

 private:
  /// DART ends the process if its constraints' matrix is not symmetric to 1e-6. This unit of mass brings the matrix's
  /// entries near 1. All forces are in that unit.
  void chooseUnit() {
    PlacedTree tree;
    machine_.readMaps(tree);
    const Eigen::MatrixXd M = machine_.skeleton->getMassMatrix();
    for (std::size_t i = 0; i < machine_.legs.size(); ++i) {
      const auto first = static_cast<Eigen::Index>(machine_.legs[i].joints[0]->getIndexInSkeleton(0));
      const Matrix3d& J = tree.legs[i].J;
      unit_ = std::max(i == 0 ? 0 : unit_, (J * M.block<3, 3>(first, first).inverse() * J.transpose()).norm());
    }
    if (!std::isfinite(unit_) || !(unit_ > 0)) throw std::runtime_error("DART moves no legs without mass");
    for (dd::BodyNode* body : machine_.skeleton->getBodyNodes()) {
      const dd::Inertia& inertia = body->getInertia();
      body->setInertia(
          dd::Inertia(unit_ * inertia.getMass(), inertia.getLocalCOM(), Matrix3d(unit_ * inertia.getMoment())));
    }
  }

  std::pair<dd::Joint*, std::size_t> place(int m) const {
    const Motor& motor = machine_.manipulator.motors()[static_cast<std::size_t>(m)];
    return machine_.legs[static_cast<std::size_t>(motor.leg)].place(static_cast<std::size_t>(motor.joint));
  }

  DartMachine machine_;
  std::shared_ptr<const Load> load_;
  Rigidity rigidity_;
  dart::simulation::WorldPtr world_;
  double unit_ = 1;  ///< factor on masses and forces, 1/kg
};

class DartCalls : public LoopEngine {
 public:
  DartCalls(const Manipulator& manipulator, std::shared_ptr<const Load> load)
      : LoopEngine(manipulator), machine_(manipulator), load_(std::move(load)) {}

  const PlacedTree& tree(const Motion<double>& motion, Bias bias) override {
    machine_.move(motion, bias == Bias::kept);
    machine_.readMaps(tree_);
    machine_.skeleton->computeInverseDynamics();
    for (std::size_t i = 0; i < machine_.legs.size(); ++i) {
      const Vector3d acts = machine_.friction(static_cast<int>(i));
      const Leg& leg = manipulator().leg(static_cast<int>(i));
      for (std::size_t j = 0; j < 3; ++j) {
        const auto [joint, which] = machine_.legs[i].place(j);
        const auto row = static_cast<int>(j);
        tree_.legs[i].force(row) = joint->getForce(which) - acts(row) +
                                   leg.rotor_inertia.on(rowOf(leg.kind).coordinates[j]) * joint->getAcceleration(which);
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
const ursula::EngineModule ursula_engine_module = {DART_VERSION, ursula::makeCalls};
