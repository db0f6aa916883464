#pragma once

#include <ode/ode.h>

#include <array>
#include <memory>
#include <vector>

#include "parts/engines/engine_machine.h"

namespace ursula::ode_engine {

/// Softness of ODE's constraints.
struct Softness {
  double erp = 0;  ///< share of an error that a step corrects
  double cfm = 0;  ///< 1/kg or 1/(kg·m²), times 1/s
};

/// The machine in ODE, where each link and the platform is a body with six coordinates. Universals, hinges and sliders
/// hold the legs, and balls close the loops. Body 1 of a joint is the outer one.
class OdeMachine : public EngineMachine {
 public:
  enum class Loops { open, closed };

  /// Builds the machine at the motion's pose. Throws std::runtime_error if a body has no inertia about some axis.
  OdeMachine(const Manipulator& from, const Motion<double>& motion, Loops loops, const Softness& softness);

  /// Sets the bodies to the motion with closed loops. Throws std::domain_error if a leg cannot reach.
  void set(const Motion<double>& motion, bool with_bias);
  /// Subtracts from all twists `h` times the twist rates that were set.
  void goBack(double h);
  /// Switches off ODE's gyroscopic moments, which are exact only to first order in the step, and adds the exact ones.
  void addGyroscopic();
  /// Makes a motor bring the leg's j-th coordinate to this rate within the next step, with any effort.
  void drive(int leg, int j, double rate);
  /// Returns the effort of the coordinate's motor in the last step.
  double effort(int leg, int j) const;

  const LegMotion& leg(int i) const { return states_[static_cast<std::size_t>(i)]; }
  double coordinate(int leg, int j) const override;  ///< counted from the pose at which the machine was built
  double rate(int leg, int j) const override;
  ChainBody platformBody() const override;
  double energy() override;
  void readMaps(PlacedTree& out) override;
  void addEffort(int leg, int j, double effort) override;
  void addWrench(const Vector6d& moment_and_force) override;
  void step(double h) override;

  int quick_iterations = 0;  ///< of ODE's quick step; 0 for its exact one

 private:
  struct Body {
    dBodyID id = nullptr;
    Vector3d center;  ///< mass centre in the body's frame
    double mass = 0;
    Matrix3d inertia;
  };
  struct Place {
    dJointID joint;
    int type;       ///< ODE's
    bool outer;     ///< the second axis of a universal
    dBodyID child;  ///< null parent: the world
    dBodyID parent;
  };
  struct EndOfWorld {
    void operator()(dxWorld* world) const { dWorldDestroy(world); }
  };

  Body bodyOf(double mass, const Vector3d& center, const Matrix3d& inertia);
  void setBody(const Body& body, const ChainBody& state);
  void addLeg(int index);
  Place placeOf(int leg, int j) const;
  Vector3d axis(int leg, int j) const;
  Vector3d anchor(int leg, int j) const;
  const Body& platform() const { return bodies_.back(); }

  std::unique_ptr<dxWorld, EndOfWorld> world_;
  std::vector<Body> bodies_;  ///< of leg i: 2i and 2i + 1; the platform
  std::vector<std::array<dJointID, 2>> joints_;
  std::vector<std::array<dJointFeedback, 2>> feedback_;
  std::vector<LegChain> chains_;
  std::vector<LegMotion> states_;
  ChainBody platform_state_;
};

}  // namespace ursula::ode_engine
