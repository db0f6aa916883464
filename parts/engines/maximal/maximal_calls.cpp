// Asks maximal coordinates for efforts of a closed loop. They have no time stepping.

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <utility>

#include "parts/engines/loop_engine.h"
#include "parts/engines/maximal/maximal_loop.h"

namespace ursula {
namespace {

/// Returns the velocities of a point, `arm` from the mass centre, for twists [ω; ċ] in columns.
template <class Twists>
auto velocities(const Twists& twists, const Vector3d& arm) {
  Eigen::Matrix<double, 3, Twists::ColsAtCompileTime> out;
  for (int k = 0; k < twists.cols(); ++k)
    out.col(k) = twists.col(k).template tail<3>() + Vector3d(twists.col(k).template head<3>()).cross(arm);
  return out;
}

}  // namespace

class MaximalCalls : public LoopEngine {
 public:
  MaximalCalls(const Manipulator& manipulator, std::shared_ptr<const Load> load)
      : LoopEngine(manipulator), loop_(manipulator, std::move(load)) {}

  const PlacedTree& tree(const Motion<double>& motion, Bias bias) override {
    move(motion, bias);
    const Eigen::VectorXd wrenches = loop_.unbalanced(motion);
    for (int i = 0; i < manipulator().legCount(); ++i) addLeg(i, wrenches);
    for (const Motor& motor : manipulator().motors())
      tree_.legs[motor.leg].force(motor.joint) +=
          manipulator().leg(motor.leg).rotor_inertia.on(motor.coordinate) * loop_.accelerationOf(motor);
    tree_.force = wrenches.tail<6>();
    return tree_;
  }

 protected:
  Vector6d closed(const Motion<double>& motion, Bias bias) override {
    move(motion, bias);
    return loop_.balance(motion);
  }

 private:
  using Square = Eigen::Matrix<double, 12, 12>;

  void move(const Motion<double>& motion, Bias bias) {
    loop_.place(motion);
    loop_.solveMotion(motion, bias == Bias::kept);
  }

  /// K = [Gᵀ S] belongs to the leg's two bodies. The last rows of K⁻¹ are the bodies' twists for unit rates of the
  /// leg's joints.
  void addLeg(int i, const Eigen::VectorXd& wrenches) {
    constexpr int rows = 9;  // constraints of the leg's own joints come before its ball's
    const int legs = manipulator().legCount(), second = 6 * (legs + i);
    Square K;
    K.topLeftCorner<6, rows>() = loop_.G_.block<rows, 6>(12 * i, 6 * i).transpose();
    K.bottomLeftCorner<6, rows>() = loop_.G_.block<rows, 6>(12 * i, second).transpose();
    const auto& coordinates = rowOf(manipulator().leg(i).kind).coordinates;
    for (int j = 0; j < 3; ++j) {
      Eigen::VectorXd unit = Eigen::VectorXd::Zero(loop_.coordinates());
      loop_.addEffort({i, j, coordinates[j]}, unit);
      K.col(rows + j) << unit.segment<6>(6 * i), unit.segment<6>(second);
    }
    Eigen::Matrix<double, 12, 1> on_leg;
    on_leg << wrenches.segment<6>(6 * i), wrenches.segment<6>(second);
    const Eigen::Matrix<double, 12, 3> twists = Square(K.inverse()).bottomRows<3>().transpose();

    const Leg& from = manipulator().leg(i);
    const BodyMotion<double>& distal = loop_.bodies_[legs + i];
    const Vector3d& B = loop_.legs_[i].B;
    const Vector3d arm = distal.R * (Vector3d(0, 0, from.distal.length) - from.distalCenter());
    OpenTree::Leg& leg = tree_.legs[i];
    leg.force = twists.transpose() * on_leg;
    leg.J = velocities(Eigen::Matrix<double, 6, 3>(twists.bottomRows<6>()), arm);
    leg.P = velocities(Matrix6d(Matrix6d::Identity()), B - loop_.bodies_.back().c);
    tree_.gaps[i] = distal.c + arm - B;
  }

  MaximalLoop loop_;
  PlacedTree tree_;
};

std::unique_ptr<LoopEngine> makeMaximalCalls(const Manipulator& manipulator, std::shared_ptr<const Load> load) {
  return std::make_unique<MaximalCalls>(manipulator, std::move(load));
}

}  // namespace ursula
