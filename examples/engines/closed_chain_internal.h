#pragma once

// Efforts of a machine with closed loops, asked of MuJoCo: trees of hinges, slides and balls, a free platform, and a
// <connect> for each loop. A rod between two balls is free to spin; it is kept from it, by the smallest rates. With the
// coordinates q of all joints, the gaps g of the loops and G = [G_L G_P] = ∂g/∂q,
//
//   G_L q̇_L = −G_P q̇_P                                                          (1)
//   G_L q̈_L = −G_P q̈_P − Ġq̇                                                     (2)
//   Gᵀλ + Sτ = M q̈ + bias − passive                                             (3)
//
// Rows of (3) without a motor give λ, those with one give τ. MuJoCo's own constraints are soft and have no part.

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "examples/engines/solver_lines_internal.h"

namespace closed_chain {

class Machine {
 public:
  /// Throws std::runtime_error with MuJoCo's words.
  explicit Machine(const std::string& file) {
    mju_user_error = mju_user_warning = [](const char* words) { throw std::runtime_error(words); };
    char error[1000] = "";
    model_.reset(mj_loadXML(file.c_str(), nullptr, error, sizeof error));
    if (!model_ || error[0] != '\0') throw std::runtime_error("MuJoCo: " + std::string(error));
    data_.reset(mj_makeData(model_.get()));
    for (int joint = 0; joint < model_->njnt; ++joint)
      if (model_->jnt_type[joint] == mjJNT_FREE) free_ = joint;
    if (free_ < 0) throw std::runtime_error("expected a platform with a free joint");
    platform_ = model_->jnt_dofadr[free_];
    for (int dof = 0; dof < model_->nv; ++dof)
      if (dof < platform_ || dof >= platform_ + 6) legs_.push_back(dof);
    if (static_cast<int>(legs_.size()) < gaps()) throw std::runtime_error("expected as many leg coordinates as gaps");
  }

  mjModel& model() { return *model_; }
  mjData& data() { return *data_; }
  int gaps() const { return 3 * model_->neq; }

  /// Distances that the loops are open by, at the state that is set; stacked.
  Eigen::VectorXd gap() {
    mj_kinematics(model_.get(), data_.get());
    mj_comPos(model_.get(), data_.get());
    Eigen::VectorXd out(gaps());
    for (int e = 0; e < model_->neq; ++e) out.segment<3>(3 * e) = point(e, 0) - point(e, 1);
    return out;
  }

  /// Puts the legs to the platform by Newton's method, from the file's pose in small steps: the answer does not depend
  /// on earlier ones. Throws where the loops do not close.
  void place(const Motion& motion) {
    mj_resetData(model_.get(), data_.get());
    double* pose = data_->qpos + model_->jnt_qposadr[free_];
    const Eigen::Vector3d start = Eigen::Map<Eigen::Vector3d>(pose);
    const Eigen::Quaterniond turned(pose[3], pose[4], pose[5], pose[6]);
    constexpr int steps = 24;
    for (int step = 1; step <= steps; ++step) {
      const double share = static_cast<double>(step) / steps;
      const Eigen::Quaterniond q = step == steps ? motion.q : turned.slerp(share, motion.q);
      Eigen::Map<Eigen::Vector3d>{pose} = start + share * (motion.p - start);
      Eigen::Map<Eigen::Vector4d>{pose + 3} << q.w(), q.x(), q.y(), q.z();
      for (int k = 0; k < (step == steps ? 6 : 2); ++k) {
        const Eigen::VectorXd open = gap();
        solveLegs(-open, Eigen::VectorXd::Zero(6), true);
      }
    }
    if (!(gap().cwiseAbs().maxCoeff() < 1e-9)) throw std::runtime_error("the loops cannot be closed at this pose");
  }

  /// Sets rates and accelerations of all joints, by (1) and (2).
  void move(const Motion& motion, Recipe recipe) {
    const Eigen::Matrix3d to_own =
        recipe == Recipe::global_angular ? Eigen::Matrix3d::Identity() : motion.q.conjugate().toRotationMatrix();
    Eigen::VectorXd rates(6), accelerations(6);
    rates << motion.v, to_own * motion.w;
    accelerations << motion.a, to_own * motion.alpha;
    gap();
    setLegs(data_->qvel, solveLegs(Eigen::VectorXd::Zero(gaps()), rates, false), rates);
    mj_comVel(model_.get(), data_.get());
    setLegs(data_->qacc, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(legs_.size())), Eigen::VectorXd::Zero(6));
    bias_ = gapAcceleration();
    if (recipe == Recipe::no_bias) bias_.setZero();
    setLegs(data_->qacc, solveLegs(-bias_, accelerations, false), accelerations);
  }

  /// In the order of the file's actuators. Places and moves first.
  Eigen::VectorXd efforts(const Motion& motion, Recipe recipe = Recipe::exact) {
    place(motion);
    move(motion, recipe);
    const int nv = model_->nv, motors = model_->nu;
    const Eigen::VectorXd wanted = recipe == Recipe::inverse ? byInverse() : forces();
    std::vector<int> driven;
    for (int k = 0; k < motors; ++k) driven.push_back(model_->jnt_dofadr[model_->actuator_trnid[2 * k]]);
    Eigen::MatrixXd S = Eigen::MatrixXd::Zero(nv, motors);
    for (int k = 0; k < motors; ++k) S(driven[static_cast<std::size_t>(k)], k) = model_->actuator_gear[6 * k];
    const Efforts found = effortsOf(recipe, jacobian(), S, wanted);  // (3)
    if (recipe == Recipe::exact || recipe == Recipe::no_bias || recipe == Recipe::global_angular)
      multipliers_ = found.multipliers;
    return found.motors;
  }
  /// Forces λ of the loops that the last exact answer found, N, stacked as the gaps are.
  const Eigen::VectorXd& multipliers() const { return multipliers_; }
  /// Ġq̇ where it last moved, m/s².
  const Eigen::VectorXd& bias() const { return bias_; }

  Eigen::MatrixXd jacobian() {
    using Rows = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor>;
    const int nv = model_->nv;
    Eigen::MatrixXd out(gaps(), nv);
    Rows first(3, nv), second(3, nv);
    for (int e = 0; e < model_->neq; ++e) {
      mj_jac(model_.get(), data_.get(), first.data(), nullptr, point(e, 0).data(), bodyOf(e, 0));
      mj_jac(model_.get(), data_.get(), second.data(), nullptr, point(e, 1).data(), bodyOf(e, 1));
      out.middleRows<3>(3 * e) = first - second;
    }
    return out;
  }

 private:
  struct Free {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* data) const { mj_deleteData(data); }
  };

  int bodyOf(int e, int side) const { return side == 0 ? model_->eq_obj1id[e] : model_->eq_obj2id[e]; }
  Eigen::Vector3d point(int e, int side) const {
    const int body = bodyOf(e, side);
    const Eigen::Map<const Eigen::Vector3d> anchor(model_->eq_data + mjNEQDATA * e + 3 * side);
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> R(data_->xmat + 9 * body);
    return Eigen::Map<const Eigen::Vector3d>(data_->xpos + 3 * body) + R * anchor;
  }

  /// The smallest x of G_L x = right − G_P free; added to the coordinates where `step`.
  Eigen::VectorXd solveLegs(const Eigen::VectorXd& right, const Eigen::VectorXd& free, bool step) {
    const Eigen::MatrixXd G = jacobian();
    Eigen::MatrixXd G_L(gaps(), legs_.size());
    for (Eigen::Index k = 0; k < G_L.cols(); ++k) G_L.col(k) = G.col(legs_[static_cast<std::size_t>(k)]);
    const Eigen::VectorXd wanted = right - G.middleCols(platform_, 6) * free;
    const Eigen::VectorXd x = G_L.rows() == G_L.cols() ? Eigen::VectorXd(G_L.partialPivLu().solve(wanted))
                                                       : G_L.completeOrthogonalDecomposition().solve(wanted);
    if (!step) return x;
    Eigen::VectorXd all(model_->nv);
    setLegs(all.data(), x, Eigen::VectorXd::Zero(6));
    mj_integratePos(model_.get(), data_->qpos, all.data(), 1);
    return x;
  }

  void setLegs(double* to, const Eigen::VectorXd& of_legs, const Eigen::VectorXd& of_platform) {
    for (std::size_t k = 0; k < legs_.size(); ++k) to[legs_[k]] = of_legs(static_cast<Eigen::Index>(k));
    Eigen::Map<Eigen::VectorXd>(to + platform_, 6) = of_platform;
  }

  /// At the rates and accelerations that are set.
  Eigen::VectorXd gapAcceleration() {
    mj_rnePostConstraint(model_.get(), data_.get());
    Eigen::VectorXd out(gaps());
    for (int e = 0; e < model_->neq; ++e) out.segment<3>(3 * e) = pointAcceleration(e, 0) - pointAcceleration(e, 1);
    return out;
  }

  Eigen::Vector3d pointAcceleration(int e, int side) {
    const int body = bodyOf(e, side);
    Eigen::Matrix<double, 6, 1> velocity, acceleration;  // [angular; linear]
    mj_objectVelocity(model_.get(), data_.get(), mjOBJ_XBODY, body, velocity.data(), 0);
    mj_objectAcceleration(model_.get(), data_.get(), mjOBJ_XBODY, body, acceleration.data(), 0);
    const Eigen::Vector3d arm = point(e, side) - Eigen::Map<const Eigen::Vector3d>(data_->xpos + 3 * body);
    const Eigen::Vector3d w = velocity.head<3>(), alpha = acceleration.head<3>();
    return acceleration.tail<3>() + alpha.cross(arm) + w.cross(w.cross(arm));
  }

  /// M q̈ + bias − passive. mj_rne has no armature. Dry friction is taken as sharp, and as none at rest.
  Eigen::VectorXd forces() {
    const int nv = model_->nv;
    Eigen::VectorXd out(nv);
    mj_passive(model_.get(), data_.get());
    mj_rne(model_.get(), data_.get(), 1, out.data());
    for (int dof = 0; dof < nv; ++dof) {
      const double rate = data_->qvel[dof], sign = rate > 0 ? 1 : rate < 0 ? -1 : 0;
      out(dof) += model_->dof_armature[dof] * data_->qacc[dof] - data_->qfrc_passive[dof] +
                  model_->dof_frictionloss[dof] * sign;
    }
    return out;
  }

  Eigen::VectorXd byInverse() {
    mj_inverse(model_.get(), data_.get());
    return Eigen::Map<const Eigen::VectorXd>(data_->qfrc_inverse, model_->nv);
  }

  std::unique_ptr<mjModel, Free> model_;
  std::unique_ptr<mjData, Free> data_;
  int free_ = -1, platform_ = 0;  ///< the platform's joint, and its first coordinate's rate
  std::vector<int> legs_;         ///< rates of the other coordinates
  Eigen::VectorXd multipliers_, bias_;
};

}  // namespace closed_chain
