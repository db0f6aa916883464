#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "model/motor_trajectory.h"
#include "parts/engines/joint_rows.h"
#include "parts/engines/ranked_factors.h"
#include "parts/engines/recipe.h"

namespace ursula {

/// Speeds u of welded bodies, free or in trees, and how their poses follow. An engine provides it.
class SpeedsOfWelds {
 public:
  virtual ~SpeedsOfWelds() = default;
  virtual Eigen::Index count() const = 0;
  /// Returns whether speed i is a length over time.
  virtual bool isLinear(Eigen::Index i) const = 0;
  virtual const WeldState& state(std::size_t weld) const = 0;  ///< twists are those of the last setSpeeds()

  // --- configurations ---
  virtual void step(const Eigen::VectorXd& by) = 0;  ///< moves by u over a unit of time
  virtual void keep() = 0;                           ///< remembers the configuration
  virtual void goBack() = 0;                         ///< to the one remembered

  // --- rates ---
  virtual void setSpeeds(const Eigen::VectorXd& u) = 0;
  /// Adds factors · Jacobian of the weld's twist.
  virtual void addRow(std::size_t weld, const Vector6d& factors, Eigen::VectorXd& row) const = 0;
  /// Returns the weld's twist rate without accelerations u̇.
  virtual Vector6d bias(std::size_t weld) const = 0;

  /// A coordinate that is one of the engine's own.
  struct Own {
    Eigen::Index speed = 0;
    double sign = 1, value = 0;  ///< value from the reference pose
  };
  virtual std::optional<Own> own(std::size_t joint, int index) const = 0;
  /// Returns whether coordinates of joints are speeds of its own.
  virtual bool isTree() const { return true; }

  // --- forces ---
  /// Returns M u̇ + bias of the placed state; gravity acts on the whole mass of each weld, in its centre.
  virtual Eigen::VectorXd forces(const Eigen::VectorXd& accelerations) = 0;
  /// Returns the same by the engine's own inverse dynamics, with its own closures of the cut joints. Throws
  /// std::domain_error with the reason if it has none for this machine.
  virtual Eigen::VectorXd ownInverse(const Eigen::VectorXd& accelerations, bool hard);

  // --- in time, with the engine's own closures of the cut joints ---
  /// Returns the settings of the loops' rigidity, the default first; empty if it moves no loops.
  virtual std::vector<Rigidity> rigidities() const { return {}; }
  /// Begins at the placed state with its speeds. Throws std::domain_error with the reason if it cannot hold the loops.
  virtual void startTime(const Rigidity& rigidity);
  /// Moves by a step under forces on the speeds, which are held. Returns the new speeds; the states are the new ones.
  virtual Eigen::VectorXd stepTime(const Eigen::VectorXd& forces);
};

/// Places a mechanism by Newton's method with the motors' coordinates prescribed, and finds its speeds and their rates
/// from the rows of its joints, of which any number may be redundant. A weld that motors and joints leave free to spin
/// about its own line has no absolute spin about it: what nothing drives stays at rest.
class MechanismClosing {
 public:
  /// `cut`: the joints that the engine's speeds do not hold by themselves. Throws std::domain_error if the loops cannot
  /// be closed near the reference pose. Keeps its arguments.
  MechanismClosing(const Mechanism& mechanism, const WeldedMechanism& welded, const std::vector<std::size_t>& cut,
                   SpeedsOfWelds& speeds);

  /// Whether the accelerations satisfy G u̇ = −Ġu, or G u̇ = 0 as is often taken.
  enum class Bias { kept, left_out };
  /// Continues the last configuration, in smaller steps where it must. Throws std::domain_error with a joint's name.
  void place(const MotorMotion& motion, Bias bias = Bias::kept);
  /// Returns the largest error of a closure, m; angles count by the machine's length.
  double gap() const;

  /// Takes the engine's state and these speeds, without accelerations.
  void take(const Eigen::VectorXd& u);
  Eigen::VectorXd motorValues() const;
  /// Returns Sᵀ times the efforts.
  Eigen::VectorXd onSpeeds(const Eigen::VectorXd& efforts) const;
  /// Returns the kinetic energy of the loaded joints' rotors, J.
  double energyOfRotors() const;

  const Eigen::VectorXd& speeds() const { return u_; }
  const Eigen::VectorXd& accelerations() const { return u_dot_; }
  /// Returns the forces of damping, friction, springs and rotors on the speeds.
  Eigen::VectorXd loads() const;
  /// Returns efforts by Nᵀ f, with u = N q̇; f are the forces on the speeds that are left to balance.
  Eigen::VectorXd effortsByComplement(const Eigen::VectorXd& f) const;
  /// Returns the same by multipliers of all rows: Gᵀλ + Sᵀτ = f.
  Eigen::VectorXd effortsByMultipliers(const Eigen::VectorXd& f) const;
  /// Returns f on the motors' own coordinates. Throws std::domain_error if the speeds have none.
  Eigen::VectorXd atMotors(const Eigen::VectorXd& f) const;
  /// Returns the motors' share of the smallest forces that move the machine as f does: (Nᵀ N)⁻¹ Nᵀ f.
  Eigen::VectorXd leastEfforts(const Eigen::VectorXd& f) const;

 private:
  struct Form {
    Eigen::VectorXd J;
    double value = 0, bias = 0;
  };
  Form formOf(const JointRow& row, bool with_bias) const;
  Form formOf(std::size_t coordinate, bool with_bias) const;
  Eigen::Index rowCount() const { return static_cast<Eigen::Index>(rows_.size()); }
  Eigen::Index motorCount() const { return static_cast<Eigen::Index>(mechanism_.motorCount()); }
  Eigen::MatrixXd allRows(Eigen::Index motors) const;
  Eigen::VectorXd errors(const Eigen::VectorXd* target) const;
  /// N of u = N q̇, by S N = 1 and G N = 0.
  Eigen::MatrixXd complement() const;
  bool newton(const Eigen::VectorXd& target);
  /// Moves the speeds' configuration to mechanism.start(), if there is one.
  void goToStart(const WeldedMechanism& welded);
  void close();
  void holdSpins(const WeldedMechanism& welded);
  void moveTo(const MotorMotion& motion);
  const std::string& worstJoint() const;

  const Mechanism& mechanism_;
  SpeedsOfWelds& speeds_;
  std::vector<JointRow> rows_;
  std::vector<JointCoordinate> coordinates_;  ///< those of the motors first
  mutable std::vector<double> near_;          ///< the last angles, which say the number of turns
  std::vector<double> near_kept_;
  Eigen::VectorXd row_scale_, column_scale_;  ///< rows are divided, columns multiplied
  std::unique_ptr<RankedFactors> factors_;
  Eigen::VectorXd u_, u_dot_;
};

}  // namespace ursula
