#include "model/quaternions.h"

#include <Eigen/Geometry>

namespace ursula {

std::vector<Eigen::Vector4d> quaternions(const std::vector<Motion<double>>& motions) {
  std::vector<Eigen::Vector4d> out;
  out.reserve(motions.size());
  for (const Motion<double>& motion : motions) {
    const Eigen::Quaterniond q(motion.Q);
    Eigen::Vector4d next(q.w(), q.x(), q.y(), q.z());
    if (out.empty() ? next(0) < 0 : next.dot(out.back()) < 0) next = -next;
    out.push_back(next);
  }
  return out;
}

}  // namespace ursula
