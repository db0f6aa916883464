#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "model/joint_variables.h"
#include "model/load.h"
#include "model/manipulator.h"
#include "model/motion.h"
#include "model/open_tree.h"

namespace ursula {

/// The manipulator as a closed loop in Simbody, built from raw parameters only. Each leg has two mobilizers (Universal,
/// Pin, Slider) according to its kind; Ball constraints join the platform. It never uses the solver: joint variables
/// come from vector geometry and Simbody's constraint Jacobian.
///
/// Vectors are in B, SI; efforts (here called torques) are conjugate to the rates of the driven coordinates. Not
/// thread-safe; each thread needs its own.
class SimbodyLoop {
 public:
  enum class Topology {
    ball_per_leg,        ///< free platform, one ball per leg; with six legs 24 − 18 = 6 degrees of freedom
    tree_through_leg_1,  ///< platform on leg 1, balls at the other legs; with six legs 21 − 15 = 6
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

  /// `load` acts on the platform; null for no load.
  explicit SimbodyLoop(const Manipulator& manipulator, Topology topology = Topology::ball_per_leg,
                       std::shared_ptr<const Load> load = nullptr);
  ~SimbodyLoop();
  SimbodyLoop(SimbodyLoop&&) noexcept;
  SimbodyLoop& operator=(SimbodyLoop&&) noexcept;

  // --- state ---

  /// Moves the platform to `motion`; vector geometry places the legs, each on its own branch. Rates and accelerations
  /// follow from Simbody's constraint Jacobian and bias. Returns the joint motion. Throws std::domain_error if a leg
  /// cannot reach, and std::runtime_error if the constraints do not determine the rates.
  JointMotion place(const Motion<double>& motion);

  /// Sets platform and joints to a given state, whether or not the loops close.
  void place(const Motion<double>& motion, const JointMotion& joint_motion);

  /// Returns the joints of the state last placed or set.
  JointMotion joints() const;
  Motion<double> platform() const;  ///< its accelerations are the last placed or computed ones
  Closure closure() const;
  /// Returns the largest acceleration, m/s², at which a ball's gap opens after accelerate(): rounding only. Only for
  /// ball_per_leg.
  double gapAcceleration() const;
  Energy energy() const;

  /// Returns pose, twist and twist rate of all bodies' mass centres at the last placed or computed accelerations.
  BodyMotions<double> bodies() const;

  // --- dynamics ---

  /// Returns the torques for the last placed accelerations, N·m: Simbody's residual forces projected on the actuated
  /// coordinates with its constraint Jacobian.
  Vector6d inverseDynamics() const;

  /// Computes the accelerations of platform and joints under these torques. With a ball at each leg it eliminates the
  /// legs' coordinates from Simbody's mass matrix and forces. Otherwise it uses realize(Acceleration), which drops
  /// multipliers if links are nearly massless.
  void accelerate(const Vector6d& torques);

  /// Returns the platform's twist rate [ω̇; p̈] by Simbody's own realize(Acceleration) minus that by accelerate(),
  /// under these torques. The difference is rounding unless Simbody drops multipliers. Only for ball_per_leg.
  Vector6d ownTwistRateError(const Vector6d& torques);

  /// Returns forces and moments at the joints after accelerate(). Only for ball_per_leg.
  Reactions reactions() const;

  // --- how a user who has the joints' motion and needs only numbers would call Simbody; ball_per_leg only ---

  /// Fills `out` for openTree() and twistRate(); realizes nothing.
  void coordinates(const Motion<double>& motion, const JointMotion& joint_motion, TreeCoordinates& out) const;

  /// Computes the open tree by realize(Velocity), calcResidualForceIgnoringConstraints and calcGTranspose; the
  /// platform's speeds are [ω; ṗ].
  void openTree(const TreeCoordinates& at, OpenTree& out);

  /// Returns the platform's twist rate [ω̇; p̈] under efforts, by realize(Acceleration). Ignores accelerations in `at`.
  Vector6d twistRate(const TreeCoordinates& at, const Vector6d& efforts);

  // --- as a system of ordinary differential equations: x = [q, u] ---

  int stateSize() const;
  std::vector<double> state() const;
  /// Sets time and state.
  void setState(double t, const double* x);
  /// Computes ẋ at (t, x) under `torques`. With a ball at each leg the balls' constraints eliminate the legs'
  /// coordinates; otherwise it uses realize(Acceleration).
  void derivative(double t, const double* x, const Vector6d& torques, double* x_dot);
  /// Returns the power at the last differentiated state, under its torques.
  Power power() const;

  /// What an integration by Simbody's own RungeKuttaMerson took.
  struct Counters {
    long derivative_evaluations = 0;
    int steps = 0;
    bool gave_up = false;
  };
  /// Integrates from the last placed state under a torque history. Calls `observe(t)` with the loop in that state, at 0
  /// and at each of `instants` (increasing, > 0). Constraint projection is Simbody's default. No step is longer than
  /// `longest_step` seconds; 0 for any.
  Counters integrateRungeKuttaMerson(double accuracy, const TorqueHistory& torques, const std::vector<double>& instants,
                                     const std::function<void(double)>& observe, double longest_step = 0);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Returns the version of the loaded library, "3.7.0".
std::string simbodyVersion();

}  // namespace ursula
