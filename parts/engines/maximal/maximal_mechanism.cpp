#include <Eigen/Geometry>
#include <numeric>

#include "parts/engines/closed_mechanism.h"

namespace ursula {
namespace maximal {

/// Six speeds of each weld but the ground: [ω; v of the centre].
class FreeWelds : public SpeedsOfWelds {
 public:
  FreeWelds(const WeldedMechanism& welded, const Vector3d& gravity)
      : welded_(welded), gravity_(gravity), now_(welded.welds.size()) {
    for (std::size_t b = 0; b < now_.size(); ++b) now_[b].state.c = welded.welds[b].center - welded.welds[0].center;
  }

  Eigen::Index count() const override { return 6 * (static_cast<Eigen::Index>(now_.size()) - 1); }
  bool isLinear(Eigen::Index i) const override { return i % 6 >= 3; }
  const WeldState& state(std::size_t weld) const override { return now_[weld].state; }
  static Eigen::Index first(std::size_t weld) { return 6 * (static_cast<Eigen::Index>(weld) - 1); }

  void step(const Eigen::VectorXd& by) override {
    for (std::size_t b = 1; b < now_.size(); ++b) {
      const Vector3d turn = by.segment<3>(first(b));
      const double angle = turn.norm();
      if (angle > 0) now_[b].Q = (Eigen::Quaterniond(Eigen::AngleAxisd(angle, turn / angle)) * now_[b].Q).normalized();
      now_[b].state.R = now_[b].Q.toRotationMatrix();
      now_[b].state.c += by.segment<3>(first(b) + 3);
    }
  }
  void keep() override { kept_ = now_; }
  void goBack() override { now_ = kept_; }
  void setSpeeds(const Eigen::VectorXd& u) override {
    for (std::size_t b = 1; b < now_.size(); ++b) {
      now_[b].state.w = u.segment<3>(first(b));
      now_[b].state.v = u.segment<3>(first(b) + 3);
    }
  }
  void addRow(std::size_t weld, const Vector6d& factors, Eigen::VectorXd& row) const override {
    if (weld != 0) row.segment<6>(first(weld)) += factors;
  }
  Vector6d bias(std::size_t) const override { return Vector6d::Zero(); }
  std::optional<Own> own(std::size_t, int) const override { return std::nullopt; }
  bool isTree() const override { return false; }

  // [recipe]
  Eigen::VectorXd forces(const Eigen::VectorXd& accelerations) override {
    Eigen::VectorXd f(count());
    for (std::size_t b = 1; b < now_.size(); ++b) {
      const WeldState& at = now_[b].state;
      const Matrix3d I = at.R * welded_.welds[b].inertia * at.R.transpose();
      const Vector6d rate = accelerations.segment<6>(first(b));
      f.segment<3>(first(b)) = I * rate.head<3>() + at.w.cross(I * at.w);
      f.segment<3>(first(b) + 3) = welded_.welds[b].mass * (rate.tail<3>() - gravity_);
    }
    return f;
  }
  // [/recipe]

 private:
  struct Now {
    WeldState state;
    Eigen::Quaterniond Q = Eigen::Quaterniond::Identity();
  };
  const WeldedMechanism& welded_;
  Vector3d gravity_;
  std::vector<Now> now_, kept_;
};

}  // namespace maximal

BuiltTree buildMaximal(const Mechanism& mechanism, const WeldedMechanism& welded) {
  BuiltTree out{std::make_unique<maximal::FreeWelds>(welded, mechanism.gravity()), {}};
  out.cut.resize(mechanism.joints().size());
  std::iota(out.cut.begin(), out.cut.end(), std::size_t{0});
  return out;
}

}  // namespace ursula
