#include "parts/engines/maximal/maximal_mechanism.h"

#include <numeric>

#include "parts/engines/mechanism_closing.h"

namespace ursula {
namespace maximal {

/// Six speeds of each weld but the ground: [ω; v of the centre].
class FreeWelds : public SpeedsOfWelds {
 public:
  explicit FreeWelds(const WeldedMechanism& welded) : now_(welded.welds.size()) {
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

 private:
  struct Now {
    WeldState state;
    Eigen::Quaterniond Q = Eigen::Quaterniond::Identity();
  };
  std::vector<Now> now_, kept_;
};

inline std::vector<std::size_t> allJoints(const Mechanism& mechanism) {
  std::vector<std::size_t> out(mechanism.joints().size());
  std::iota(out.begin(), out.end(), std::size_t{0});
  return out;
}

}  // namespace maximal

struct MaximalMechanism::Impl {
  explicit Impl(const Mechanism& of)
      : mechanism(of),
        welded(mechanism),
        speeds(welded),
        closing(mechanism, welded, maximal::allJoints(mechanism), speeds) {}

  Mechanism mechanism;
  WeldedMechanism welded;
  maximal::FreeWelds speeds;
  MechanismClosing closing;
};

MaximalMechanism::MaximalMechanism(const Mechanism& mechanism) : impl_(std::make_unique<Impl>(mechanism)) {}
MaximalMechanism::~MaximalMechanism() = default;

Eigen::VectorXd MaximalMechanism::inverseDynamics(const MotorMotion& motion) {
  Impl& m = *impl_;
  m.closing.place(motion);
  Eigen::VectorXd f = -m.closing.loads();
  for (std::size_t b = 1; b < m.welded.welds.size(); ++b) {
    const WeldedBodies& weld = m.welded.welds[b];
    const WeldState& state = m.speeds.state(b);
    const Vector6d rate = m.closing.accelerations().segment<6>(maximal::FreeWelds::first(b));
    const Matrix3d I = state.R * weld.inertia * state.R.transpose();
    const Vector3d weight = weld.weight * m.mechanism.gravity();
    f.segment<3>(maximal::FreeWelds::first(b)) +=
        I * rate.head<3>() + state.w.cross(I * state.w) - (state.R * weld.weight_arm).cross(weight);
    f.segment<3>(maximal::FreeWelds::first(b) + 3) += weld.mass * rate.tail<3>() - weight;
  }
  return m.closing.effortsByMultipliers(f);
}

}  // namespace ursula
