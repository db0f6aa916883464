#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "validation/subject/leg_points.h"
#include "validation/subject/subject.h"

namespace ursula {

/// One body of the machine in one motion, in B: the quantities for its part of the efforts.
struct BodyTerms {
  double mass = 0;                                        ///< kg
  Matrix3d inertia = Matrix3d::Zero();                    ///< about the mass centre, kg·m²
  Matrix3d R = Matrix3d::Identity();                      ///< its frame
  Vector3d c = Vector3d::Zero();                          ///< mass centre, m
  Vector3d from = Vector3d::Zero();                       ///< from the centre of its inner joint to the mass centre, m
  Vector3d line = Vector3d::Zero();                       ///< along a link, unit; zero for platform and carriage
  Vector3d sliding = Vector3d::Zero();                    ///< velocity along the previous link, m/s
  Vector6d twist = Vector6d::Zero(), twist_rate = twist;  ///< [ω; ċ], [ω̇; c̈]
  Vector6d bias = twist;                                  ///< part of its twist rate without joint accelerations
  Matrix6d T = Matrix6d::Zero();                          ///< its rows of (32a): twist per unit rates of the motors
  Vector3d gravity = Vector3d::Zero();                    ///< g, m/s²

  Vector3d omega() const { return twist.head<3>(); }
  /// [I ω̇ + ω × I ω; m c̈] for a twist rate, (38).
  Vector6d inertiaWrench(const Vector6d& rate) const;
  Vector6d gravityWrench() const;  ///< [0; m g], (45)
  /// The efforts of the motors that move the body and carry its weight.
  Vector6d efforts() const;
};

/// One leg detached from the platform, as an open chain.
struct OpenLeg {
  Leg numbers;
  BodyTerms proximal, distal;
  Matrix3d J = Matrix3d::Zero();  ///< velocity of B per unit rates of its coordinates
  Eigen::Matrix<double, 3, 6> P =
      Eigen::Matrix<double, 3, 6>::Zero();    ///< the same per unit of the platform's twist at P
  Vector3d efforts = Vector3d::Zero();        ///< of its coordinates, for its own links, rotors and friction
  Matrix3d mass = Matrix3d::Zero();           ///< of its links and rotors, in its coordinates
  Vector3d arm = Vector3d::Zero();            ///< Q b, m
  Vector3d bias = Vector3d::Zero();           ///< J̇ q̇ of its point B, m/s²
  Vector3d coriolis = Vector3d::Zero();       ///< the part of `bias` from sliding while turning
  Vector3d platform_bias = Vector3d::Zero();  ///< ω × (ω × Qb) of the platform's, m/s²

  /// The generalised force at P, [moment; force], of forces on the platform by these efforts of its coordinates.
  Vector6d atP(const Vector3d& of_coordinates) const;
};

/// The machine in one motion, body by body. It uses the NOC's kinematics and its own dynamics. Terms can be omitted
/// individually, and the loops can be closed in other ways.
struct MachineTerms {
  Motors motors = {};
  std::vector<OpenLeg> legs;
  BodyTerms platform;
  Vector6d platform_wrench = Vector6d::Zero();  ///< moment about P and force that move the platform, minus the load
  Matrix6d T_P = Matrix6d::Zero();              ///< of (24)
  Vector6d rate_at_P = Vector6d::Zero();        ///< [ω̇; p̈]
  Vector3d rho = Vector3d::Zero();              ///< from P to the platform's mass centre, in B

  /// The generalised force at P of platform, links and friction; the efforts are T_Pᵀ times it.
  Vector6d forceAtP() const;
  /// The efforts of errors in joint accelerations of J⁻¹ times the leg's `off`, m/s².
  Vector6d ofAccelerations(const std::function<Vector3d(const OpenLeg&)>& off) const;
};

/// [n; 0] and [0; f].
Vector6d momentWrench(const Vector3d& n);
Vector6d forceWrench(const Vector3d& f);

/// Throws PoseError like the NOC.
MachineTerms machineTerms(const Manipulator& machine, const std::shared_ptr<const Load>& load,
                          const Motion<double>& motion);

}  // namespace ursula
