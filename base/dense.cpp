#include "base/dense.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <unsupported/Eigen/MatrixFunctions>

namespace ursula {
namespace {

using Solver = Eigen::EigenSolver<Eigen::MatrixXd>;

}  // namespace

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix) { return Solver(matrix, false).eigenvalues(); }

Eigen::VectorXd symmetricEigenvalues(const Eigen::MatrixXd& matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
}

std::optional<EigenPairs> eigenPairs(const Eigen::MatrixXd& matrix) {
  const Solver solver(matrix);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return EigenPairs{solver.eigenvalues(), solver.eigenvectors()};
}

int rankOf(const Eigen::MatrixXd& matrix) {
  return static_cast<int>(Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(matrix).rank());
}

Eigen::VectorXd leastSquaresSolution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(A).solve(b);
}

Eigen::VectorXd singularValues(const Eigen::MatrixXd& A) {
  return Eigen::JacobiSVD<Eigen::MatrixXd>(A).singularValues();
}

Eigen::MatrixXd rightSingularVectors(const Eigen::MatrixXd& A) {
  return Eigen::JacobiSVD<Eigen::MatrixXd>(A, Eigen::ComputeFullV).matrixV();
}

Eigen::MatrixXd leastNormSolution(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(A).solve(B);
}

Eigen::MatrixXd inverseOf(const Eigen::MatrixXd& A) { return A.inverse(); }

Eigen::MatrixXd exponential(const Eigen::MatrixXd& A) { return A.exp(); }

}  // namespace ursula
