#pragma once

#include <array>
#include <vector>

#include "model/manipulator.h"

namespace ursula {

/// One pose of a platform on six legs of given lengths; vectors in B.
struct UpsPose {
  Vector3d p = Vector3d::Zero();                 ///< position of M's origin, m
  Matrix3d Q = Matrix3d::Identity();             ///< orientation of M in B
  Eigen::Vector4d q = Eigen::Vector4d::UnitX();  ///< the same as a unit quaternion [w, x, y, z], w ≥ 0
  double residual = 0;                           ///< largest | |p + Q bᵢ − aᵢ| − dᵢ |, m
  int multiplicity = 1;                          ///< number of poses that rounding merges into this one
};

/// All real poses, at most 40, by decreasing w, x, y, z of the quaternion.
struct UpsPoses {
  std::vector<UpsPose> list;
  int counted = 0;      ///< complex poses found, with their multiplicities
  int at_infinity = 0;  ///< solutions that are no poses, for instance if joints coincide; 0 for most machines
  /// A sum of 40 proves that no pose is missing.
  bool complete() const { return counted + at_infinity == 40; }
};

/// Solves the direct kinematics of a general Stewart–Gough platform: returns every pose with |p + Q bᵢ − aᵢ| = dᵢ. Base
/// points aᵢ in B, platform points bᵢ in M, lengths dᵢ, all in m. docs/direct_kinematics.md explains the method.
/// Allocates. Throws UndeterminedPose if there are infinitely many, or nearly so; std::invalid_argument unless all
/// numbers are finite and no length is negative.
UpsPoses upsPoses(const std::array<Vector3d, 6>& base_points, const std::array<Vector3d, 6>& platform_points,
                  const Vector6d& lengths);

/// Returns whether each of six legs has one motor that, while it holds, keeps the leg's platform point on a sphere.
/// That is d of UPS (about the base point, of radius d), phi of RUS (about the crank's end), and d of PUS (about the
/// carriage). The last two have the rod's length as radius. Legs may be of different kinds; upsPoses() applies to these
/// machines.
bool tipsAreOnSpheres(const Manipulator& machine);
/// Returns every pose of such a machine for its driven coordinates, rad or m, in leg order. Throws as above.
UpsPoses upsPoses(const Manipulator& machine, const Vector6d& driven);
/// Returns whether inverse kinematics at this pose gives leg i's driven coordinate; i is 0-based. Otherwise the leg is
/// beyond its stroke (UPS), or bends the other way (RUS, PUS).
bool isOnItsBranch(const Leg& leg, double driven, const UpsPose& pose);
/// Returns the first leg, 0-based, of such a machine that is telescopic and whose length exceeds its stroke; −1 if
/// there is none.
int beyondStroke(const Manipulator& machine, const Vector6d& driven);

}  // namespace ursula
