#pragma once

#include <Eigen/Core>
#include <cmath>

namespace ursula {

/// A number with its derivatives with respect to N variables, for the kernels. Comparisons use the number alone.
template <int N>
struct Dual {
  using Slopes = Eigen::Array<double, N, 1>;

  Dual() : Dual(0.0) {}
  Dual(double value) : v(value), d(Slopes::Zero()) {}  // a plain number is a constant
  Dual(double value, const Slopes& slopes) : v(value), d(slopes) {}

  explicit operator double() const { return v; }

  Dual& operator+=(const Dual& b) {
    v += b.v;
    d += b.d;
    return *this;
  }
  Dual& operator-=(const Dual& b) {
    v -= b.v;
    d -= b.d;
    return *this;
  }
  Dual& operator*=(const Dual& b) {
    d = d * b.v + v * b.d;
    v *= b.v;
    return *this;
  }
  Dual& operator/=(const Dual& b) {
    const double per = 1 / b.v;
    v *= per;
    d = (d - v * b.d) * per;
    return *this;
  }

  friend Dual operator+(Dual a, const Dual& b) { return a += b; }
  friend Dual operator-(Dual a, const Dual& b) { return a -= b; }
  friend Dual operator*(Dual a, const Dual& b) { return a *= b; }
  friend Dual operator/(Dual a, const Dual& b) { return a /= b; }
  friend Dual operator-(const Dual& a) { return {-a.v, -a.d}; }
  friend bool operator<(const Dual& a, const Dual& b) { return a.v < b.v; }
  friend bool operator>(const Dual& a, const Dual& b) { return a.v > b.v; }
  friend bool operator<=(const Dual& a, const Dual& b) { return a.v <= b.v; }
  friend bool operator>=(const Dual& a, const Dual& b) { return a.v >= b.v; }
  friend bool operator==(const Dual& a, const Dual& b) { return a.v == b.v; }
  friend bool operator!=(const Dual& a, const Dual& b) { return a.v != b.v; }

  friend Dual sqrt(const Dual& a) {
    const double root = std::sqrt(a.v);
    return {root, a.d * (0.5 / root)};
  }
  friend Dual abs(const Dual& a) { return a.v < 0 ? -a : a; }
  friend Dual tanh(const Dual& a) {
    const double value = std::tanh(a.v);
    return {value, a.d * (1 - value * value)};
  }

  double v;
  Slopes d;
};

}  // namespace ursula

namespace Eigen {

template <int N>
struct NumTraits<ursula::Dual<N>> : NumTraits<double> {
  using Real = ursula::Dual<N>;
  using NonInteger = ursula::Dual<N>;
  using Nested = ursula::Dual<N>;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = N,
    AddCost = N,
    MulCost = N
  };
};

}  // namespace Eigen
