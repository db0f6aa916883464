#pragma once

// First derivatives along with a number, as a scalar of the kernels: forward differentiation (Griewank, Walther,
// Evaluating Derivatives, 2nd ed., 2008, sect. 3.1). Internal, for sources that are compiled for one instruction set
// each: every name here depends on it, so that no linker mixes them.

#include <cmath>

#include <Eigen/Core>
#include <xsimd/xsimd.hpp>

namespace ursula::kernel {

/// Where there is no instruction set of ours: one number in a register.
struct OneByOne {};

template <class Isa>
struct Register {
  using Type = xsimd::batch<double, Isa>;
  static Type all(double x) { return Type(x); }
  static Type load(const double* from) { return Type::load_unaligned(from); }
  static void store(const Type& x, double* to) { x.store_unaligned(to); }
  static constexpr int lanes = static_cast<int>(Type::size);
};
template <>
struct Register<OneByOne> {
  using Type = double;
  static double all(double x) { return x; }
  static double load(const double* from) { return *from; }
  static void store(double x, double* to) { *to = x; }
  static constexpr int lanes = 1;
};

/// At least N numbers in as many registers as they take; what is beyond N is of no interest.
template <class Isa, int N>
struct Tangents {
  using R = Register<Isa>;
  static constexpr int registers = (N + R::lanes - 1) / R::lanes, lanes = registers * R::lanes;
  typename R::Type part[registers];

  static Tangents all(double x) {
    Tangents out;
    for (auto& one : out.part) one = R::all(x);
    return out;
  }
  static Tangents load(const double* from) {
    Tangents out;
    for (int k = 0; k < registers; ++k) out.part[k] = R::load(from + k * R::lanes);
    return out;
  }
  void store(double* to) const {
    for (int k = 0; k < registers; ++k) R::store(part[k], to + k * R::lanes);
  }

  friend Tangents operator+(const Tangents& a, const Tangents& b) {
    Tangents out;
    for (int k = 0; k < registers; ++k) out.part[k] = a.part[k] + b.part[k];
    return out;
  }
  friend Tangents operator-(const Tangents& a, const Tangents& b) {
    Tangents out;
    for (int k = 0; k < registers; ++k) out.part[k] = a.part[k] - b.part[k];
    return out;
  }
  friend Tangents operator-(const Tangents& a) {
    Tangents out;
    for (int k = 0; k < registers; ++k) out.part[k] = -a.part[k];
    return out;
  }
  friend Tangents operator*(double x, const Tangents& a) {
    Tangents out;
    const auto factor = R::all(x);
    for (int k = 0; k < registers; ++k) out.part[k] = factor * a.part[k];
    return out;
  }
};

/// A number with N derivatives.
template <class Isa, int N>
struct Dual {
  using T = Tangents<Isa, N>;
  double v;
  T d;

  Dual() = default;
  Dual(double value) : v(value), d(T::all(0)) {}  // NOLINT(google-explicit-constructor): as Eigen makes its scalars
  Dual(double value, const T& tangents) : v(value), d(tangents) {}

  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }
  Dual& operator/=(const Dual& b) { return *this = *this / b; }
  friend Dual operator-(const Dual& a) { return {-a.v, -a.d}; }
  friend Dual operator+(const Dual& a, const Dual& b) { return {a.v + b.v, a.d + b.d}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.v - b.v, a.d - b.d}; }
  friend Dual operator*(const Dual& a, const Dual& b) { return {a.v * b.v, b.v * a.d + a.v * b.d}; }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double per_b = 1 / b.v, ratio = a.v * per_b;
    return {ratio, per_b * (a.d - ratio * b.d)};
  }
  friend Dual sqrt(const Dual& a) {
    const double root = std::sqrt(a.v);
    return {root, (0.5 / root) * a.d};
  }
  friend Dual tanh(const Dual& a) {
    const double value = std::tanh(a.v);
    return {value, (1 - value * value) * a.d};
  }
  friend Dual abs(const Dual& a) { return a.v < 0 ? -a : a; }
  friend bool operator<(const Dual& a, const Dual& b) { return a.v < b.v; }
};

}  // namespace ursula::kernel

namespace Eigen {
template <class Isa, int N>
struct NumTraits<ursula::kernel::Dual<Isa, N>> : GenericNumTraits<ursula::kernel::Dual<Isa, N>> {
  using Real = ursula::kernel::Dual<Isa, N>;
  using NonInteger = Real;
  using Literal = Real;
  using Nested = Real;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
};
}  // namespace Eigen
