#pragma once

#include "exchange/recognise/leg_numbers.h"

namespace ursula::exchange {

/// Copies friction, motors and rotors to the coordinates of a leg whose frames are known: base axis, and the rotations
/// of its links' frames, in the world. Says where a motor's coordinate in the file grows the other way. Throws
/// ImportError for a rotor without a motor.
void takeLegDynamics(const LegTask& task, const Vector3d& base_axis, const Matrix3d& proximal, const Matrix3d& distal,
                     ImportedLeg& leg, std::vector<Assumption>& assumptions);

/// The lengths of a telescopic leg between which it may move, m.
struct Stroke {
  double least = 0, most = 0;
  bool from_file = false;  ///< else a third of the leg's length either way
};

/// Reads the stroke from a slide's limits. The leg's line is `along`, its length at the initial pose is `length`.
Stroke strokeOf(const LegTask& task, const Primitive& slide, const Vector3d& along, double length,
                std::vector<Assumption>& assumptions);

}  // namespace ursula::exchange
