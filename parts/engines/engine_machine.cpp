#include "parts/engines/engine_machine.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "parts/engines/closing.h"

namespace ursula {
namespace {

class SteppedMachine : public SteppedLoop {
 public:
  SteppedMachine(std::shared_ptr<const Load> load, double step, const MakeEngineMachine& make)
      : load_(std::move(load)), step_(step), make_(make) {}

  void start(const Motion<double>& motion) override {
    time_ = motion.t;
    machine_ = make_(motion);
  }

  void step(const Vector6d& efforts) override {
    machine_->addFrictionAndLoad(load_.get(), time_);
    for (int m = 0; m < motor_count; ++m) {
      const Motor& motor = machine_->manipulator.motors()[m];
      machine_->addEffort(motor.leg, motor.joint, efforts(m));
    }
    machine_->step(step_);
    time_ += step_;
  }

  void read(State& out) override {
    out.q = forMotors(machine_->manipulator,
                      [&](const Motor& motor) { return machine_->coordinate(motor.leg, motor.joint); });
    out.p = machine_->position();
    out.energy = machine_->energy();
    out.power = machine_->powerOfFrictionAndLoad(load_.get(), time_);
    machine_->readMaps(out.tree);
  }

 private:
  std::shared_ptr<const Load> load_;
  double step_ = 0, time_ = 0;
  MakeEngineMachine make_;
  std::unique_ptr<EngineMachine> machine_;
};

}  // namespace

Vector6d EngineMachine::wrenchOf(const Load* load, double t) const {
  const Matrix3d Q = platformBody().frame.linear();
  Vector6d out = loadInBase(load, t, Q);
  out.head<3>() -= Vector3d(Q * origin_).cross(Vector3d(out.tail<3>()));
  return out;
}

void EngineMachine::addFrictionAndLoad(const Load* load, double t) {
  for (int i = 0; i < manipulator.legCount(); ++i) {
    const Vector3d acts = friction(i);
    for (int j = 0; j < 3; ++j) addEffort(i, j, acts(j));
  }
  addWrench(wrenchOf(load, t));
}

double EngineMachine::powerOfFrictionAndLoad(const Load* load, double t) const {
  const ChainBody body = platformBody();
  const Vector6d w = wrenchOf(load, t);
  double out = w.head<3>().dot(body.omega) + w.tail<3>().dot(body.velocity);
  for (int i = 0; i < manipulator.legCount(); ++i) out += friction(i).dot(rates(i));
  return out;
}

Vector3d EngineMachine::position() const {
  const Eigen::Isometry3d frame = platformBody().frame;
  return frame.translation() - frame.linear() * origin_;
}

std::unique_ptr<SteppedLoop> steppedMachine(const char* engine, const Manipulator& manipulator,
                                            std::shared_ptr<const Load> load, double step,
                                            const MakeEngineMachine& make) {
  if (hasRotors(manipulator)) throw std::runtime_error(fmt::format("{} moves no rotors", engine));
  return std::make_unique<SteppedMachine>(std::move(load), step, make);
}

double rotorForce(const Leg& leg, int j, double acceleration) {
  return leg.rotor_inertia.on(rowOf(leg.kind).coordinates[j]) * acceleration;
}

}  // namespace ursula
