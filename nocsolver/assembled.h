#pragma once

#include "model/real50.h"
#include "nocsolver/paper_solver.h"

namespace ursula {

/// Section 3 of the paper with every matrix formed: what the fast roads of Solver never do, for tests, reactions and
/// reading. Rows run over the bodies as in (30a). Allocates; made for one motion.
template <class S>
class AssembledDynamics {
 public:
  using MatrixX = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  using VectorX = Eigen::Matrix<S, Eigen::Dynamic, 1>;

  /// `load` is an external wrench on the platform, [moment about P; force], in B. Throws as Solver does.
  AssembledDynamics(const Manipulator& manipulator, const Motion<S>& motion,
                    const Vector6<S>& load = Vector6<S>::Zero());

  const MatrixX& M() const { return M_; }          ///< (30b), 78 × 78
  const MatrixX& W() const { return W_; }          ///< (30b), 78 × 78
  const MatrixX& D() const { return D_; }          ///< velocity constraints D t = 0, 78 × 78 of rank 72
  const TwistShaping<S>& T() const { return T_; }  ///< (32a), 78 × 6
  const TwistShaping<S>& TRate() const { return T_rate_; }
  const VectorX& t() const { return t_; }  ///< (30a), 78
  const VectorX& tRate() const { return t_rate_; }

  const VectorX& gravityWrench() const { return w_g_; }      ///< w^g (45)
  const VectorX& dissipativeWrench() const { return w_d_; }  ///< w^d of (35): joint friction
  const VectorX& loadWrench() const { return w_e_; }
  /// w^a of (35): the motors' torques on the proximal links, about −uᵢ.
  VectorX actuatorWrench(const Vector6<S>& torques) const;
  /// w^n ≡ −Mṫ − WMt of (37), (38).
  VectorX inertiaWrench() const;
  /// w^N of (31): what is left of Newton and Euler when everything that works is taken off.
  VectorX constraintWrench(const Vector6<S>& torques) const;

  Matrix6<S> I() const;     ///< generalized inertia TᵀMT of (34)
  Matrix6<S> C() const;     ///< Tᵀ(MṪ + WMT) of (34)
  Vector6<S> tauG() const;  ///< τ^g of (36)
  Vector6<S> tauD() const;  ///< τ^d of (36)
  Vector6<S> tauLoad() const;
  /// φ̈ under `torques` by (36).
  Vector6<S> jointAccelerations(const Vector6<S>& torques) const;

 private:
  void setBodies(const BodyMotions<S>& bodies);
  void setFriction();
  void setConstraints(const Motion<S>& motion, const BodyMotions<S>& bodies);

  PaperSolver<S> solver_;
  PaperWorkspace<S> work_;
  MatrixX M_, W_, D_;
  TwistShaping<S> T_, T_rate_;
  VectorX t_, t_rate_, w_g_, w_d_, w_e_;
};

extern template class AssembledDynamics<double>;
extern template class AssembledDynamics<Real50>;

}  // namespace ursula
