#pragma once

// A scalar of the kernels with as many doubles as a register has lanes. Internal, for sources compiled for one
// instruction set. Every name here depends on the set, so no linker mixes them.

#include <Eigen/Core>
#include <xsimd/xsimd.hpp>

namespace ursula {

template <class Isa>
struct Pack {
  using Batch = xsimd::batch<double, Isa>;
  using Mask = xsimd::batch_bool<double, Isa>;
  static constexpr int lanes = static_cast<int>(Batch::size);

  Pack() = default;
  Pack(double value) : v(value) {}  // NOLINT(google-explicit-constructor): Eigen converts scalars this way
  explicit Pack(const Batch& batch) : v(batch) {}

  Pack& operator+=(const Pack& b) { return *this = *this + b; }
  Pack& operator-=(const Pack& b) { return *this = *this - b; }
  Pack& operator*=(const Pack& b) { return *this = *this * b; }
  Pack& operator/=(const Pack& b) { return *this = *this / b; }
  friend Pack operator-(const Pack& a) { return Pack(-a.v); }
  friend Pack operator+(const Pack& a, const Pack& b) { return Pack(a.v + b.v); }
  friend Pack operator-(const Pack& a, const Pack& b) { return Pack(a.v - b.v); }
  friend Pack operator*(const Pack& a, const Pack& b) { return Pack(a.v * b.v); }
  friend Pack operator/(const Pack& a, const Pack& b) { return Pack(a.v / b.v); }
  friend Mask operator<(const Pack& a, const Pack& b) { return a.v < b.v; }
  friend Mask operator>(const Pack& a, const Pack& b) { return a.v > b.v; }
  friend Mask operator>=(const Pack& a, const Pack& b) { return a.v >= b.v; }
  friend Pack abs(const Pack& a) { return Pack(xsimd::abs(a.v)); }
  friend Pack sqrt(const Pack& a) { return Pack(xsimd::sqrt(a.v)); }
  /// Clamps to ±40, where tanh is ±1 to the last bit. xsimd converts the exponent to an integer, which fails for NaN
  /// and infinity.
  friend Pack tanh(const Pack& a) {
    const Batch bounded = xsimd::min(xsimd::max(a.v, Batch(-40.0)), Batch(40.0));
    return Pack(xsimd::select(xsimd::isnan(a.v), a.v, xsimd::tanh(bounded)));
  }
  friend Pack min(const Pack& a, const Pack& b) { return Pack(xsimd::min(a.v, b.v)); }
  friend Pack max(const Pack& a, const Pack& b) { return Pack(xsimd::max(a.v, b.v)); }
  friend Pack select(const Mask& mask, const Pack& a, const Pack& b) { return Pack(xsimd::select(mask, a.v, b.v)); }

  Batch v;
};

}  // namespace ursula

namespace Eigen {
template <class Isa>
struct NumTraits<ursula::Pack<Isa>> : GenericNumTraits<ursula::Pack<Isa>> {
  using Real = ursula::Pack<Isa>;
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
