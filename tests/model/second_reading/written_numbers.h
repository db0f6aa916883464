#pragma once

// Reads numbers from toml++'s nodes for the second reading; it refuses nothing.

#include <toml++/toml.h>

#include <limits>

#include "model/manipulator.h"

namespace ursula::written {

inline constexpr double none = std::numeric_limits<double>::quiet_NaN();
using View = toml::node_view<const toml::node>;

inline double number(const View& node) { return node.value<double>().value_or(none); }

inline double numberOr(const View& node, double otherwise) { return node ? number(node) : otherwise; }

template <int N>
Eigen::Matrix<double, N, 1> numbers(const View& node) {
  Eigen::Matrix<double, N, 1> out = Eigen::Matrix<double, N, 1>::Constant(none);
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() != N) return out;
  for (int i = 0; i < N; ++i) out(i) = number(node[static_cast<std::size_t>(i)]);
  return out;
}

inline Vector3d vectorOr(const View& node, const Vector3d& otherwise) {
  return node ? Vector3d(numbers<3>(node)) : otherwise;
}

inline std::size_t sizeOf(const View& node) { return node.is_array() ? node.as_array()->size() : 0; }

/// Tensor entries: [xx, yy, zz] or [xx, yy, zz, xy, xz, yz].
inline Matrix3d tensor(const View& node) {
  const toml::array* array = node.as_array();
  if (array != nullptr && array->size() == 3) return numbers<3>(node).asDiagonal();
  const Vector6d entry = numbers<6>(node);
  Matrix3d out;
  out << entry(0), entry(3), entry(4),  //
      entry(3), entry(1), entry(5),     //
      entry(4), entry(5), entry(2);
  return out;
}

/// `[manipulator]` as its file has it.
ManipulatorParameters machineOf(const View& table);

}  // namespace ursula::written
