#pragma once

#include <string>
#include <vector>

#include "nocsolver/loops/loop_state.h"

namespace ursula::loops {

/// The equations by which a cut joint closes its loop, g = 0. Lengths are divided by the machine's, so that each row is
/// an angle.
class Closures {
 public:
  Closures(const Mechanism& mechanism, const LoopTree& tree);

  int rows() const { return rows_; }
  /// Returns the joint of a row.
  std::size_t jointOf(int row) const { return joint_of_row_[row]; }

  /// g of the placed frames.
  void errors(const Frames& frames, VectorXd& g) const;
  /// G, rows × rates: ġ = G u.
  void jacobian(const Frames& frames, MatrixXd& G) const;
  /// Ġu: g̈ = G u̇ + Ġu, for frames moved with u̇ = 0.
  void bias(const Frames& frames, VectorXd& bias) const;

 private:
  struct Cut {
    std::size_t joint = 0;
    JointKind kind = JointKind::ball;
    int parent = -1, child = -1;   ///< elements
    Vector3d on_parent, on_child;  ///< points at the reference pose
    Matrix3d turn;
    std::array<Vector3d, 2> axis;    ///< on the parent's side
    std::array<Vector3d, 2> across;  ///< with the first axis an orthogonal frame
    double universal_cosine = 0;
    int first = 0;  ///< its first row
  };

  static int rowsOf(JointKind kind);
  template <class Row>
  void eachRow(const Frames& frames, const Cut& cut, const Row& row) const;

  std::vector<Cut> cuts_;
  std::vector<std::size_t> joint_of_row_;
  double length_ = 1;
  int rows_ = 0;
};

}  // namespace ursula::loops
