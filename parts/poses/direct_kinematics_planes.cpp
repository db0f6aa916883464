#include "parts/poses/direct_kinematics_parts.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

// With Q written in a quaternion q, homogeneous of degree two, and |q|² instead of 1:
//   xᵢᵀ(|q|² p + Q(q) bᵢ − |q|² aᵢ) = 0,  i = 1…6                                    first component of (13)
//   xᵢᵀQ(q)bᵢ = qᵀMᵢq,  Mᵢ = [ xᵢᵀbᵢ      (bᵢ × xᵢ)ᵀ                  ]
//                            [ bᵢ × xᵢ    xᵢbᵢᵀ + bᵢxᵢᵀ − (xᵢᵀbᵢ) 1   ]              (a)
//   NᵀX = 0, N 6 × 3:  qᵀSₖq = 0,  Sₖ = Σᵢ Nᵢₖ (Mᵢ − xᵢᵀaᵢ 1),  k = 1…3              (b)

namespace ursula::direct {
namespace {

constexpr double eps = Eigen::NumTraits<double>::epsilon();

/// The ten entries of a symmetric 4 × 4 matrix, scaled so that dot products are Frobenius products.
using Symmetric = Eigen::Matrix<double, 10, 1>;

Symmetric packed(const Eigen::Matrix4d& S) {
  const double root = std::sqrt(2.0);
  Symmetric out;
  out << S.diagonal(), root * S(0, 1), root * S(0, 2), root * S(0, 3), root * S(1, 2), root * S(1, 3), root * S(2, 3);
  return out;
}

Eigen::Matrix4d unpacked(const Symmetric& s) {
  const double root = std::sqrt(0.5);
  Eigen::Matrix4d S;
  S << s(0), root * s(4), root * s(5), root * s(6),  //
      root * s(4), s(1), root * s(7), root * s(8),   //
      root * s(5), root * s(7), s(2), root * s(9),   //
      root * s(6), root * s(8), root * s(9), s(3);
  return S;
}

/// (a) minus xᵀa |q|².
Eigen::Matrix4d planeQuadric(const Vector3d& x, const Vector3d& a, const Vector3d& b) {
  const double xb = x.dot(b);
  Eigen::Matrix4d M;
  M(0, 0) = xb;
  M.block<3, 1>(1, 0) = b.cross(x);
  M.block<1, 3>(0, 1) = M.block<3, 1>(1, 0).transpose();
  M.block<3, 3>(1, 1) = x * b.transpose() + b * x.transpose();
  M.diagonal().tail<3>().array() -= xb;
  M.diagonal().array() -= x.dot(a);
  return M;
}

template <class Qr>
double pivotRatio(const Qr& qr) {
  const auto pivots = qr.matrixQR().diagonal().cwiseAbs();
  return pivots.maxCoeff() > 0 ? pivots.minCoeff() / pivots.maxCoeff() : 0;
}

}  // namespace

Matrix3d rotation(const Eigen::Vector4d& q) { return Eigen::Quaterniond(q(0), q(1), q(2), q(3)).toRotationMatrix(); }

Planes::Planes(const MachineParameters<double>& model, const Vector6d& phi) : model_(model) {
  for (int i = 0; i < leg_count; ++i) {
    const LegModel<double>& leg = model.legs[i];
    const double cosine = std::cos(phi(i)), sine = std::sin(phi(i));
    x_[i] = cosine * leg.x_hat + sine * leg.z_hat;  // (paper, eq. 1)
    z_[i] = cosine * leg.z_hat - sine * leg.x_hat;
    size_ = std::max(size_, leg.a.norm());
  }
}

Vector6d Planes::mismatch(const PlacedPlatform& pose) const {
  const Matrix3d Q = rotation(pose.q);
  Vector6d out;
  for (int i = 0; i < leg_count; ++i) {
    const LegModel<double>& leg = model_.legs[i];
    out(i) = x(i).dot(pose.p + Q * leg.b - leg.a);  // (paper, eq. 13)
  }
  return out;
}

/// The bound of three products of three terms each; none exceeds the sum of all lengths.
double Planes::rounding(const PlacedPlatform& pose) const { return 9 * eps * (pose.p.norm() + model_.length + size_); }

double Planes::newtonStep(const Vector6d& mismatch, PlacedPlatform& pose, int& orientation) const {
  const Matrix3d Q = rotation(pose.q);
  Matrix6d B;  // of (23), moments over the machine's length
  for (int i = 0; i < leg_count; ++i) {
    const Vector3d Qb = Q * model_.legs[i].b;
    B.row(i) << Qb.cross(x(i)).transpose() / model_.length, x(i).transpose();  // (paper, eq. 23)
  }
  const Eigen::PartialPivLU<Matrix6d> lu(B);
  const Vector6d step = -lu.solve(mismatch);
  orientation = lu.determinant() > 0 ? 1 : -1;
  const Vector3d half = step.head<3>() / (2 * model_.length);
  const double w = pose.q(0);
  const Vector3d v = pose.q.tail<3>();
  pose.q += Eigen::Vector4d(-half.dot(v), w * half.x(), w * half.y(), w * half.z());
  pose.q.tail<3>() += half.cross(v);
  pose.q.normalize();
  pose.p += step.tail<3>();
  return step.norm();
}

Eigen::Matrix<double, leg_count, 3> Planes::normals() const {
  Eigen::Matrix<double, leg_count, 3> X;
  for (int i = 0; i < leg_count; ++i) X.row(i) = x(i).transpose();
  return X;
}

/// (b)
Elimination Planes::eliminateP() const {
  Elimination out;
  const Eigen::ColPivHouseholderQR<Eigen::Matrix<double, leg_count, 3>> X(normals());
  out.normals = pivotRatio(X);
  const Matrix6d all = X.householderQ();
  Eigen::Matrix<double, 10, leg_count> packed_planes;
  for (int i = 0; i < leg_count; ++i) {
    const LegModel<double>& leg = model_.legs[i];
    packed_planes.col(i) = packed(planeQuadric(x(i), leg.a, leg.b));
  }
  const Eigen::Matrix<double, 10, 3> three = packed_planes * all.rightCols<3>();
  const Eigen::ColPivHouseholderQR<Eigen::Matrix<double, 10, 3>> qr(three);
  out.independence = pivotRatio(qr);
  const Eigen::Matrix<double, 10, 3> orthonormal = qr.householderQ() * Eigen::Matrix<double, 10, 3>::Identity();
  for (int k = 0; k < 3; ++k) out.quadrics.S[k] = unpacked(orthonormal.col(k));
  return out;
}

Vector3d Planes::p(const Eigen::Vector4d& q) const {
  const Vector6d right = -mismatch({Vector3d::Zero(), q});
  return normals().householderQr().solve(right);
}

}  // namespace ursula::direct
