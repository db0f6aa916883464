#pragma once

#include <string>
#include <vector>

#include "exchange/model_graph.h"

namespace ursula::exchange {

/// Bodies without relative motion, which form one rigid body of the machine.
struct Group {
  std::vector<std::size_t> bodies;  ///< in the order of the file
  std::string name;                 ///< the name of the heaviest body
  int line = 0;
  bool fixed = false;
  double mass = 0;
  Vector3d center_of_mass = Vector3d::Zero();  ///< in the world
  Matrix3d inertia = Matrix3d::Zero();         ///< about the mass centre, world axes
  double inertia_rounding = 0;
  bool weightless = false;  ///< some of its mass has no gravity

  bool isFrame() const { return mass == 0 && inertia.isZero(0); }
  /// The tensor about `point`.
  Matrix3d inertiaAbout(const Vector3d& point) const;
  /// Adds another body by the parallel-axis rule.
  void add(double mass_of_it, const Vector3d& center, const Matrix3d& inertia_of_it);
};

/// m ([r]·[r] 1 − r rᵀ)
Matrix3d pointInertia(double mass, const Vector3d& r);

/// The machine's rigid bodies; only moving joints remain between them.
struct Groups {
  std::vector<Group> groups;
  std::vector<std::size_t> group_of;  ///< the group of each body

  explicit Groups(const ModelGraph& graph);
  /// Returns the group of the named body. Throws ImportError with the nearest name if there is none.
  std::size_t named(const ModelGraph& graph, const std::string& name, const std::string& option) const;
};

}  // namespace ursula::exchange
