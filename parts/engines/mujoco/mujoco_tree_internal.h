#pragma once

// Only mujoco_tree*.cpp include it.

#include <array>
#include <vector>

#include "parts/engines/mechanism_closing.h"
#include "parts/engines/mujoco/mujoco_text_internal.h"
#include "parts/engines/weld_tree.h"

namespace ursula::mujoco {

/// The tree in MuJoCo. Body w is weld w, with the world's axes at the reference pose and its origin in the centre.
Model treeModel(const Mechanism& mechanism, const WeldedMechanism& welded, const WeldTree& tree);
int bodyOf(const mjModel& model, std::size_t weld);
/// The same tree, with the cut joints closed by MuJoCo's own `connect` and `weld`: at its default softness, or as hard
/// as it allows. Throws std::domain_error for a slide or a universal joint.
Model connectedModel(const Mechanism& mechanism, const WeldedMechanism& welded, const WeldTree& tree, bool hard,
                     bool with_rotors = false);

/// The tree's speeds.
class TreeSpeeds : public SpeedsOfWelds {
 public:
  /// Keeps its first two arguments.
  TreeSpeeds(const Mechanism& mechanism, const WeldedMechanism& welded, WeldTree tree);

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
  Eigen::VectorXd forces(const Eigen::VectorXd& accelerations) override;
  Eigen::VectorXd ownInverse(const Eigen::VectorXd& accelerations, bool hard) override;
  std::vector<Rigidity> rigidities() const override;
  void startTime(const Rigidity& rigidity) override;
  Eigen::VectorXd stepTime(const Eigen::VectorXd& forces) override;

 private:
  using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic>;
  struct OfTree {
    int joint = -1;  ///< in MuJoCo, of the first coordinate
    int count = 0;
    bool reversed = false;
  };
  void readPose();

  struct Connected {
    Model model;
    Data data;
  };

  const Mechanism& mechanism_;
  const WeldedMechanism& welded_;
  WeldTree tree_;
  Model model_;
  Data data_;
  std::vector<OfTree> of_tree_;  ///< of each joint of the mechanism
  std::vector<int> bodies_;      ///< in MuJoCo, of each weld
  std::vector<WeldState> states_;
  std::vector<Jacobian> jacobians_;
  std::vector<Vector6d> biases_;
  std::vector<double> kept_;
  std::array<Connected, 2> connected_;  ///< soft and hard; made on first use
  Connected moved_;                     ///< in time
};

}  // namespace ursula::mujoco
