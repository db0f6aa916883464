#pragma once

// Internals of MujocoMechanism; only mujoco_mechanism*.cpp include it.

#include <vector>

#include "parts/engines/mechanism_closing.h"
#include "parts/engines/mujoco/mujoco_mechanism.h"
#include "parts/engines/mujoco/mujoco_text_internal.h"

namespace ursula::mujoco {

/// A step of the spanning tree of welds, outwards. Without a joint the weld is free.
struct WeldStep {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::size_t joint = none, from = 0, to = 0;
  bool reversed = false;  ///< from the joint's child to its parent
};
struct WeldTree {
  std::vector<WeldStep> steps;
  std::vector<std::size_t> cut;
};
/// Motors and loaded joints are in the tree before others, closures last; open joints never.
WeldTree weldTree(const Mechanism& mechanism, const WeldedMechanism& welded);

/// The tree in MuJoCo. Body w is weld w, with the world's axes at the reference pose and its origin in the centre.
Model treeModel(const Mechanism& mechanism, const WeldedMechanism& welded, const WeldTree& tree);
int bodyOf(const mjModel& model, std::size_t weld);

/// The tree's speeds.
class TreeSpeeds : public SpeedsOfWelds {
 public:
  TreeSpeeds(const Mechanism& mechanism, const WeldedMechanism& welded, const WeldTree& tree);

  Eigen::Index count() const override { return model_->nv; }
  bool isLinear(Eigen::Index i) const override;
  const WeldState& state(std::size_t weld) const override { return states_[weld]; }
  void step(const Eigen::VectorXd& by) override;
  void keep() override { kept_.assign(data_->qpos, data_->qpos + model_->nq); }
  void goBack() override;
  void setSpeeds(const Eigen::VectorXd& u) override;
  void addRow(std::size_t weld, const Vector6d& factors, Eigen::VectorXd& row) const override;
  Vector6d bias(std::size_t weld) const override { return biases_[weld]; }
  std::optional<Own> own(std::size_t joint, int index) const override;

  /// Returns M u̇ + bias of the placed state, with gravity on bodies that have weight.
  Eigen::VectorXd forces(const Eigen::VectorXd& accelerations);

 private:
  using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic>;
  struct OfTree {
    int joint = -1;  ///< in MuJoCo, of the first coordinate
    int count = 0;
    bool reversed = false;
  };
  void readPose();

  Vector3d gravity_;
  const WeldedMechanism& welded_;
  Model model_;
  Data data_;
  std::vector<OfTree> of_tree_;  ///< of each joint of the mechanism
  std::vector<int> bodies_;      ///< in MuJoCo, of each weld
  std::vector<WeldState> states_;
  std::vector<Jacobian> jacobians_;
  std::vector<Vector6d> biases_;
  std::vector<double> kept_;
};

}  // namespace ursula::mujoco
