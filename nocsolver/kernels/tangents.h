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

/// At least N numbers in as many registers as they take; what is beyond N is of no interest. One register, and the rest
/// as its base: compilers take no loop over an array apart as early as this.
template <class Isa, int N>
struct Tangents : Tangents<Isa, (N > Register<Isa>::lanes ? N - Register<Isa>::lanes : 0)> {
  using R = Register<Isa>;
  using Rest = Tangents<Isa, (N > R::lanes ? N - R::lanes : 0)>;
  static constexpr int lanes = R::lanes + Rest::lanes;
  typename R::Type part;

  Tangents() = default;
  Tangents(const typename R::Type& one, const Rest& rest) : Rest(rest), part(one) {}
  static Tangents all(double x) { return {R::all(x), Rest::all(x)}; }
  static Tangents load(const double* from) { return {R::load(from), Rest::load(from + R::lanes)}; }
  void store(double* to) const {
    R::store(part, to);
    rest().store(to + R::lanes);
  }
  const Rest& rest() const { return *this; }

  friend Tangents operator+(const Tangents& a, const Tangents& b) { return {a.part + b.part, a.rest() + b.rest()}; }
  friend Tangents operator-(const Tangents& a, const Tangents& b) { return {a.part - b.part, a.rest() - b.rest()}; }
  friend Tangents operator-(const Tangents& a) { return {-a.part, -a.rest()}; }
  friend Tangents operator*(double x, const Tangents& a) { return {R::all(x) * a.part, x * a.rest()}; }
};

/// None: what is left of a Dual is a number of its instruction set's own.
template <class Isa>
struct Tangents<Isa, 0> {
  static constexpr int lanes = 0;
  static Tangents all(double) { return {}; }
  static Tangents load(const double*) { return {}; }
  void store(double*) const {}
  friend Tangents operator+(const Tangents&, const Tangents&) { return {}; }
  friend Tangents operator-(const Tangents&, const Tangents&) { return {}; }
  friend Tangents operator-(const Tangents&) { return {}; }
  friend Tangents operator*(double, const Tangents&) { return {}; }
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
  // By members: compilers copy a trivial one as a block, and wait until all of it is written.
  Dual(const Dual& other) : v(other.v), d(other.d) {}
  Dual& operator=(const Dual& other) {
    v = other.v;
    d = other.d;
    return *this;
  }

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
  friend bool operator>(const Dual& a, const Dual& b) { return a.v > b.v; }
  friend bool operator<=(const Dual& a, const Dual& b) { return a.v <= b.v; }
  friend bool operator!=(const Dual& a, const Dual& b) { return a.v != b.v; }
};

template <class Isa>
using Value = Dual<Isa, 0>;

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
