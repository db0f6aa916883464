#pragma once

#include "exchange/recognise/leg_numbers.h"

namespace ursula::exchange {

/// Returns a physically possible tensor if only the rounding of the file's digits makes it impossible. With
/// `line_may_be_zero` the third entry may be zero. Throws ImportError for larger errors.
Matrix3d snapped(const Matrix3d& inertia, double rounding, bool line_may_be_zero, const std::string& body, int line,
                 std::vector<Assumption>& assumptions);

/// Combines bodies into one link. `frame` is in the world, with its origin at the link's first end and its third axis
/// along it.
ImportedLink linkOf(const LegTask& task, const Group& link, const Eigen::Isometry3d& frame, double length,
                    bool line_may_be_zero, std::vector<Assumption>& assumptions);

/// Makes `link` exactly round with `keep_moment`, as `spin = "free"` asks; else removes from it the moment about the
/// line of a freely spinning body, at zero rate. Throws ImportError if that changes the dynamics: unequal transverse
/// moments, a mass centre off the line.
void freeSpin(const LegTask& task, const Group& body, const Eigen::Isometry3d& frame, bool keep_moment,
              ImportedLink& link, std::vector<Assumption>& assumptions);

/// Reports the loss from the joints' crosses as a share of the leg's moments; adds their masses to the bodies they ride
/// on.
void lumpCrosses(const LegTask& task, const Vector3d& base_point, Group& proximal, const Group& distal, Group& platform,
                 std::vector<Assumption>& assumptions);

}  // namespace ursula::exchange
