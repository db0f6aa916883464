#pragma once

#include <functional>
#include <memory>

#include "parts/engines/leg_motion.h"
#include "parts/engines/loop_engine.h"

namespace ursula {

/// Legs and platform in an engine that moves bodies and joints in time, but lacks rotors, friction and loads; in B, SI.
/// Efforts and wrenches add up until the next step.
class EngineMachine {
 public:
  /// `origin` is that of the platform's body in M.
  explicit EngineMachine(const Manipulator& from, const Vector3d& origin = Vector3d::Zero())
      : manipulator(from), origin_(origin) {}
  virtual ~EngineMachine() = default;
  EngineMachine(const EngineMachine&) = delete;
  EngineMachine& operator=(const EngineMachine&) = delete;

  virtual double coordinate(int leg, int j) const = 0;
  virtual double rate(int leg, int j) const = 0;
  /// The platform's motion, with the axes of M; its origin is where the engine applies wrenches.
  virtual ChainBody platformBody() const = 0;
  virtual double energy() = 0;  ///< kinetic and potential, J
  virtual void readMaps(PlacedTree& out) = 0;
  virtual void addEffort(int leg, int j, double effort) = 0;
  virtual void addWrench(const Vector6d& moment_and_force) = 0;
  /// Throws std::runtime_error if the engine gives up.
  virtual void step(double h) = 0;

  Vector3d friction(int leg) const { return frictionOn(manipulator.leg(leg), rates(leg)); }
  /// Returns [moment; force] of the load at the platform body's origin.
  Vector6d wrenchOf(const Load* load, double t) const;
  void addFrictionAndLoad(const Load* load, double t);
  double powerOfFrictionAndLoad(const Load* load, double t) const;  ///< W
  Vector3d position() const;                                        ///< of P

  Manipulator manipulator;

 private:
  Vector3d rates(int leg) const { return {rate(leg, 0), rate(leg, 1), rate(leg, 2)}; }

  Vector3d origin_;
};

/// Makes a machine with closed loops at a motion.
using MakeEngineMachine = std::function<std::unique_ptr<EngineMachine>(const Motion<double>& start)>;

/// Returns the machine under time stepping. Throws std::runtime_error, in the name of `engine`, if motors have rotors.
std::unique_ptr<SteppedLoop> steppedMachine(const char* engine, const Manipulator& manipulator,
                                            std::shared_ptr<const Load> load, double step,
                                            const MakeEngineMachine& make);

/// j q̈ of a rotor on the leg's j-th coordinate.
double rotorForce(const Leg& leg, int j, double acceleration);

}  // namespace ursula
