#pragma once

#include <Eigen/Core>
#include <optional>

// Eigen's factorisations of dynamic size compile slowly, so they are compiled once, here.

namespace ursula {

/// Returns the eigenvalues of a real square matrix; conjugates follow each other.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix);

struct EigenPairs {
  Eigen::VectorXcd values;   ///< conjugates follow each other, with the positive imaginary part first
  Eigen::MatrixXcd vectors;  ///< columns of norm 1
};

/// Returns the eigenvalues of a symmetric matrix, increasing.
Eigen::VectorXd symmetricEigenvalues(const Eigen::MatrixXd& matrix);

/// Returns nullopt if the iteration does not converge.
std::optional<EigenPairs> eigenPairs(const Eigen::MatrixXd& matrix);

/// Returns the rank by QR with column pivoting and Eigen's threshold.
int rankOf(const Eigen::MatrixXd& matrix);

/// Returns the x of the least |Ax − b| by QR with column pivoting.
Eigen::VectorXd leastSquaresSolution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// Returns the singular values, decreasing.
Eigen::VectorXd singularValues(const Eigen::MatrixXd& A);

/// Returns the whole V of A = UΣVᵀ; the singular values decrease.
Eigen::MatrixXd rightSingularVectors(const Eigen::MatrixXd& A);

/// Returns the solution of A X = B, n × p for A of m × n and B of m × p: by least squares, and of least norm.
Eigen::MatrixXd leastNormSolution(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// Returns A⁻¹ of an A of n × n that is not singular; of a singular one its numbers are not finite.
Eigen::MatrixXd inverseOf(const Eigen::MatrixXd& A);

/// Returns exp(A) by scaling, squaring and Padé's approximants.
Eigen::MatrixXd exponential(const Eigen::MatrixXd& A);

}  // namespace ursula
