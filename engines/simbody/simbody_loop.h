#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "engines/open_tree.h"
#include "model/joint_reactions.h"
#include "model/joint_variables.h"
#include "model/load.h"
#include "model/manipulator.h"
#include "model/motion.h"

namespace ursula {

/// The manipulator as a closed loop in Simbody, built of raw parameters alone: per leg two mobilizers of
/// Universal, Pin and Slider as its kind has them, the platform, and Ball constraints that close the loops. It never
/// sees the solver: joint variables come from vector geometry and from Simbody's own constraint Jacobian.
///
/// Vectors in B, SI; efforts (here called torques) are conjugate to the rates of the driven coordinates. Not
/// thread-safe: one loop for each thread.
class SimbodyLoop {
 public:
  enum class Topology {
    six_balls,           ///< platform free, a ball for each leg: of six 24 − 18 = 6 degrees of freedom
    tree_through_leg_1,  ///< platform hangs on leg 1, the other legs' balls: of six 21 − 15 = 6
  };

  /// The largest error over the balls.
  struct Closure {
    double position = 0;  ///< m
    double velocity = 0;  ///< m/s
  };

  struct Energy {
    double kinetic = 0, potential = 0;  ///< J
  };

  /// Power that flows into the machine, W.
  struct Power {
    double actuators = 0, friction = 0, load = 0;
  };

  using TorqueHistory = std::function<Vector6d(double t)>;

  /// `load` acts on the platform; null for none.
  explicit SimbodyLoop(const Manipulator& manipulator, Topology topology = Topology::six_balls,
                       std::shared_ptr<const Load> load = nullptr);
  ~SimbodyLoop();
  SimbodyLoop(SimbodyLoop&&) noexcept;
  SimbodyLoop& operator=(SimbodyLoop&&) noexcept;

  // --- state ---

  /// Puts the platform into `motion`; each leg follows by vector geometry with its branch, the rates and
  /// accelerations by Simbody's constraint Jacobian and bias. Returns the joint motion found. Throws std::domain_error
  /// where a leg cannot reach and std::runtime_error where Simbody's constraints do not determine the rates.
  JointMotion place(const Motion<double>& motion);

  /// Puts platform and joints into a given state, whether or not the loops close.
  void place(const Motion<double>& motion, const JointMotion& joint_motion);

  /// Of the state that was placed or set.
  JointMotion joints() const;
  Motion<double> platform() const;  ///< accelerations are those last placed or found
  Closure closure() const;
  /// The largest acceleration at which a ball's gap opens after accelerate(), m/s²: rounding, and nothing else. Only
  /// for six_balls.
  double gapAcceleration() const;
  Energy energy() const;

  /// Pose, twist and twist rate of the 13 bodies' mass centres at the accelerations last placed or found.
  BodyMotions<double> bodies() const;

  // --- dynamics ---

  /// Torques for the accelerations last placed: Simbody's residual forces projected on the actuated coordinates with
  /// its constraint Jacobian. N·m.
  Vector6d inverseDynamics() const;

  /// The platform's accelerations and the joints' under these torques: with six balls by elimination of the legs'
  /// coordinates from Simbody's mass matrix and forces, else by realize(Acceleration), which drops multipliers where
  /// links are nearly massless. They are then the accelerations last found.
  void accelerate(const Vector6d& torques);

  /// The platform's twist rate [ω̇; p̈] by Simbody's own realize(Acceleration), less that by accelerate(), under these
  /// torques. It is rounding, except where Simbody drops multipliers. Only for six_balls.
  Vector6d ownTwistRateError(const Vector6d& torques);

  /// Forces and moments at the joints after accelerate(). Only for six_balls.
  Reactions reactions() const;

  // --- as somebody who has the joints' motion and wants numbers alone would ask Simbody; six_balls only ---

  /// Nothing is realized.
  void coordinates(const Motion<double>& motion, const JointMotion& joint_motion, TreeCoordinates& out) const;

  /// By realize(Velocity), calcResidualForceIgnoringConstraints and calcGTranspose; speeds of the platform are [ω; ṗ].
  void openTree(const TreeCoordinates& at, OpenTree& out);

  /// The platform's twist rate [ω̇; p̈] under efforts, by realize(Acceleration). Accelerations in `at` are not read.
  Vector6d twistRate(const TreeCoordinates& at, const Vector6d& efforts);

  // --- as a system of ordinary differential equations: x = [q, u] ---

  int stateSize() const;
  std::vector<double> state() const;
  /// Sets time and state.
  void setState(double t, const double* x);
  /// ẋ at (t, x) under `torques`. With six balls the legs' coordinates are eliminated by the balls' constraints; else
  /// by realize(Acceleration).
  void derivative(double t, const double* x, const Vector6d& torques, double* x_dot);
  /// Power at the state last differentiated, under its torques.
  Power power() const;

  /// What Simbody's own RungeKuttaMerson makes of the state last placed under a torque history.
  struct Counters {
    long derivative_evaluations = 0;
    int steps = 0;
    bool gave_up = false;
  };
  /// `observe(t)` is called at 0, at each of `instants` (increasing, > 0) and sees the loop in that state.
  /// Constraint projection is Simbody's default.
  Counters integrateRungeKuttaMerson(double accuracy, const TorqueHistory& torques, const std::vector<double>& instants,
                                     const std::function<void(double)>& observe);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ursula
