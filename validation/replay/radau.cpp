#include "validation/replay/radau.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "base/dense.h"

namespace ursula {
namespace {

constexpr int stages = 9;
constexpr int most_iterations = 15;
/// The last iteration may change this share of the tolerance. Iterations that shrink less than the second factor are
/// stopped.
constexpr double solved = 0.1, slowest = 0.7;
constexpr double eps = std::numeric_limits<double>::epsilon();

using Complex = std::complex<double>;
using Nodes = Eigen::Matrix<double, stages, 1>;
using Square = Eigen::Matrix<double, stages, stages>;
using Stages = Eigen::Matrix<double, Eigen::Dynamic, stages>;

/// Legendre's polynomials on [0, 1].
double legendre(int k, double x) { return std::legendre(static_cast<unsigned>(k), 2 * x - 1); }

double integralOfLegendre(int k, double x) {
  return k == 0 ? x : (legendre(k + 1, x) - legendre(k - 1, x)) / (2 * (2 * k + 1));
}

/// The constants of the method.
struct Method {
  Nodes node;
  Square A;            ///< A f is the integral to each node of the polynomial with values f at the nodes
  Square coefficient;  ///< coefficients of Legendre's polynomials from values at the nodes
  Eigen::Matrix<Complex, stages, 1> eigenvalues;  ///< eigenvalues of A
  Eigen::Matrix<Complex, stages, stages> vectors, inverse;

  Method() {
    placeNodes();
    Square values, integrals;
    for (int i = 0; i < stages; ++i)
      for (int k = 0; k < stages; ++k) {
        values(i, k) = legendre(k, node(i));
        integrals(i, k) = integralOfLegendre(k, node(i));
      }
    coefficient = inverseOf(values);
    A = integrals * coefficient;
    const EigenPairs pairs = eigenPairs(A).value();
    eigenvalues = pairs.values;
    vectors = pairs.vectors;
    inverse = pairs.vectors.inverse();
  }

 private:
  /// The zeros of P_s − P_{s−1}; the last is 1.
  void placeNodes() {
    const auto f = [](double x) { return legendre(stages, x) - legendre(stages - 1, x); };
    constexpr int pieces = 1000;
    int found = 0;
    for (int k = 0; k + 1 < pieces && found < stages - 1; ++k) {
      double a = double(k) / pieces, b = double(k + 1) / pieces;
      if (f(a) * f(b) > 0) continue;
      while (b - a > eps * b) {
        const double middle = (a + b) / 2;
        if (middle == a || middle == b) break;
        (f(a) * f(middle) <= 0 ? b : a) = middle;
      }
      node(found++) = (a + b) / 2;
    }
    node(stages - 1) = 1;
  }
};

const Method& method() {
  static const Method radau;
  return radau;
}

Eigen::Map<const Eigen::VectorXd> mapped(const std::vector<double>& x) {
  return {x.data(), static_cast<Eigen::Index>(x.size())};
}

/// Solves Δ − h J Δ Aᵀ = R in A's eigenvectors, one of each conjugate pair.
class Newton {
 public:
  Newton(const Eigen::MatrixXd& jacobian, double h) {
    const Method& m = method();
    const auto one = Eigen::MatrixXcd::Identity(jacobian.rows(), jacobian.cols());
    for (int k = 0; k < stages; ++k)
      if (m.eigenvalues(k).imag() >= 0) {
        of_.push_back(k);
        factors_.emplace_back(one - h * m.eigenvalues(k) * jacobian.cast<Complex>());
      }
  }

  Stages solve(const Stages& residual) const {
    const Method& m = method();
    const Eigen::MatrixXcd right = residual.cast<Complex>() * m.inverse.transpose();
    Stages out = Stages::Zero(residual.rows(), stages);
    for (std::size_t k = 0; k < of_.size(); ++k) {
      const Eigen::VectorXcd y = factors_[k].solve(right.col(of_[k]));
      const double share = m.eigenvalues(of_[k]).imag() > 0 ? 2 : 1;
      out += share * (y * m.vectors.col(of_[k]).transpose()).real();
    }
    return out;
  }

 private:
  std::vector<int> of_;
  std::vector<Eigen::PartialPivLU<Eigen::MatrixXcd>> factors_;
};

template <class Changes>
double largest(const Changes& changes, const Eigen::ArrayXd& scale) {
  const Eigen::ArrayXXd shares = changes.eval().array().colwise() / scale;
  return shares.abs().template maxCoeff<Eigen::PropagateNaN>();
}

Eigen::MatrixXd jacobianOf(const RadauStep::Rate& rate, const std::vector<double>& x, double t,
                           const std::vector<double>& at_start) {
  const auto n = static_cast<Eigen::Index>(x.size());
  Eigen::MatrixXd out(n, n);
  std::vector<double> near = x, changed(x.size());
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double step = std::sqrt(eps) * (1 + std::abs(x[k]));  // coordinates are of order one
    near[k] = x[k] + step;
    rate(near, changed, t);
    out.col(static_cast<Eigen::Index>(k)) = (mapped(changed) - mapped(at_start)) / (near[k] - x[k]);
    near[k] = x[k];
  }
  return out;
}

}  // namespace

void RadauStep::differentiate(const Rate& rate, const std::vector<double>& x, double t) {
  at_start_.resize(x.size());
  rate(x, at_start_, t);
  jacobian_ = jacobianOf(rate, x, t, at_start_);
}

std::optional<double> RadauStep::tryStep(const Rate& rate, std::vector<double>& x, double t, double h,
                                         const Tolerance& tolerance) {
  const Method& m = method();
  differentiate(rate, x, t);
  const Newton newton(jacobian_, h);
  const auto n = static_cast<Eigen::Index>(x.size());
  const Eigen::ArrayXd size_of_x = mapped(x).array().abs();
  const Eigen::ArrayXd scale = tolerance.absolute + tolerance.relative * size_of_x;
  Stages Z = h * mapped(at_start_) * m.node.transpose(), F(n, stages);
  double before = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    evaluate(rate, x, t, h, Z, F);
    const Stages change = newton.solve(h * F * m.A.transpose() - Z);
    Z += change;
    const double size = largest(change, scale);
    // Changes fall by a constant factor until only rounding remains.
    const bool rounding = size >= before / 4 && largest(change, tolerance.absolute + size_of_x) <= 100 * eps;
    if (size <= solved || rounding) {
      const double error = largest(h * F * m.coefficient.bottomRows<2>().transpose(), scale);
      if (error <= 1) Eigen::Map<Eigen::VectorXd>(x.data(), n) += Z.col(stages - 1);
      return error;
    }
    if (!(size < slowest * before) && iteration > 1) return std::nullopt;
    before = size;
  }
  return std::nullopt;
}

void RadauStep::evaluate(const Rate& rate, const std::vector<double>& x, double t, double h, const Eigen::MatrixXd& Z,
                         Eigen::Ref<Eigen::MatrixXd> F) {
  std::vector<double> stage(x.size()), found(x.size());
  for (int i = 0; i < stages; ++i) {
    for (std::size_t k = 0; k < x.size(); ++k) stage[k] = x[k] + Z(static_cast<Eigen::Index>(k), i);
    rate(stage, found, t + method().node(i) * h);
    F.col(i) = mapped(found);
  }
}

double RadauStep::noiseInError() { return method().coefficient.bottomRows<2>().cwiseAbs().rowwise().sum().maxCoeff(); }

std::vector<double> RadauStep::instants(double t, double h) {
  std::vector<double> out = {t};
  for (int i = 0; i < stages; ++i) out.push_back(t + method().node(i) * h);
  return out;
}

double changeOfStep(const std::optional<double>& error) {
  if (!error) return 0.4;
  return std::clamp(0.85 * std::pow(*error, -1.0 / stages), 0.2, 3.0);
}

}  // namespace ursula
