#pragma once

#include "exchange/recognise/leg_numbers.h"

namespace ursula::exchange {

/// A tensor that a mass distribution can have, where the file's own digits are all that stands against it. With
/// `line_may_be_zero` the third entry may be zero. Throws ImportError where more is amiss.
Matrix3d snapped(const Matrix3d& inertia, double rounding, bool line_may_be_zero, const std::string& body, int line,
                 std::vector<Assumption>& assumptions);

/// Bodies as one link: `frame` in the world with its origin at the link's first end, its third axis along the link.
ImportedLink linkOf(const LegTask& task, const Group& link, const Eigen::Isometry3d& frame, double length,
                    bool line_may_be_zero, std::vector<Assumption>& assumptions);

/// Takes out of `link` the moment about the line of a body in it that spins freely, at no rate. Throws ImportError
/// where that is not the same: unequal transverse moments, a mass centre off the line.
void freeSpin(const LegTask& task, const Group& body, const Eigen::Isometry3d& frame, bool keep_moment,
              ImportedLink& link, std::vector<Assumption>& assumptions);

/// What is lost with the bodies of the joints' crosses, as a share of the leg's own; their masses go where they ride.
void lumpCrosses(const LegTask& task, const Vector3d& base_point, Group& proximal, const Group& distal, Group& platform,
                 std::vector<Assumption>& assumptions);

}  // namespace ursula::exchange
