#include <BulletDynamics/Featherstone/btMultiBodyJointMotor.h>
#include <BulletDynamics/Featherstone/btMultiBodyMLCPConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyPoint2Point.h>
#include <BulletDynamics/MLCPSolvers/btDantzigSolver.h>

#include <stdexcept>

#include "parts/engines/bullet/bullet_machine_internal.h"

namespace ursula::bullet_engine {

BulletWorld::BulletWorld(BulletMachine& machine, Solver solver, int iterations, double erp, double cfm)
    : machine_(machine) {
  if (solver == Solver::dantzig) {
    direct_ = std::make_unique<btDantzigSolver>();
    solver_ = std::make_unique<btMultiBodyMLCPConstraintSolver>(direct_.get());
  } else {
    solver_ = std::make_unique<btMultiBodyConstraintSolver>();
  }
  world_ = std::make_unique<btMultiBodyDynamicsWorld>(&dispatcher_, &broadphase_, solver_.get(), &configuration_);
  const Vector3d& g = machine.manipulator.gravity();
  world_->setGravity(btVector3(g.x(), g.y(), g.z()));
  btContactSolverInfo& info = world_->getSolverInfo();
  info.m_numIterations = iterations;
  info.m_erp = info.m_erp2 = erp;
  info.m_globalCfm = cfm;
  add(machine.platform());
  for (int i = 0; i < machine.manipulator.legCount(); ++i) {
    add(machine.body(i));
    balls_.push_back(std::make_unique<btMultiBodyPoint2Point>(&machine.body(i), 2, &machine.platform(), -1,
                                                              machine.tip(i), machine.platformPoint(i)));
    balls_.back()->setMaxAppliedImpulse(unlimited);
    balls_.back()->finalizeMultiDof();
    world_->addMultiBodyConstraint(balls_.back().get());
  }
}

/// Bullet makes islands of colliders, and silently ignores constraints of bodies without one. If islands are not split,
/// it ignores all constraints of multibodies.
void BulletWorld::add(btMultiBody& body) {
  world_->addMultiBody(&body);
  for (int link = -1; link < body.getNumLinks(); ++link) {
    colliders_.push_back(std::make_unique<btMultiBodyLinkCollider>(&body, link));
    colliders_.back()->setCollisionShape(&shape_);
    colliders_.back()->setActivationState(DISABLE_DEACTIVATION);
    world_->addCollisionObject(colliders_.back().get(), 0, 0);
    if (link < 0)
      body.setBaseCollider(colliders_.back().get());
    else
      body.getLink(link).m_collider = colliders_.back().get();
  }
}

void BulletWorld::remove(btMultiBody& body) {
  world_->removeMultiBody(&body);
  body.setBaseCollider(nullptr);
  for (int link = 0; link < body.getNumLinks(); ++link) body.getLink(link).m_collider = nullptr;
}

BulletWorld::~BulletWorld() {
  for (const auto& of : {&balls_, &motors_})
    for (const auto& each : *of) world_->removeMultiBodyConstraint(each.get());
  for (const auto& each : colliders_) world_->removeCollisionObject(each.get());
  for (int i = 0; i < machine_.manipulator.legCount(); ++i) remove(machine_.body(i));
  remove(machine_.platform());
}

void BulletWorld::drive(int leg, int j, double rate) {
  motors_.push_back(std::make_unique<btMultiBodyJointMotor>(&machine_.body(leg), j, rate, unlimited));
  motors_.back()->finalizeMultiDof();
  world_->addMultiBodyConstraint(motors_.back().get());
}

void BulletMachine::step(double h) {
  world->step(h);
  if (!position().allFinite()) throw std::runtime_error("Bullet's state is not finite");
}

BulletMachine::~BulletMachine() { world.reset(); }  // while its bodies are there

double BulletWorld::effort(std::size_t motor, double h) const { return motors_[motor]->getAppliedImpulse(0) / h; }

}  // namespace ursula::bullet_engine
