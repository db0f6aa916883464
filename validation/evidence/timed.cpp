#include "validation/evidence/timed.h"

#include <memory>
#include <utility>

namespace ursula {
namespace {

class TimedTrajectory : public Trajectory {
 public:
  TimedTrajectory(std::shared_ptr<const Trajectory> motion, const Deadline& deadline)
      : motion_(std::move(motion)), deadline_(deadline) {}

  std::string kind() const override { return motion_->kind(); }
  double duration() const override { return motion_->duration(); }
  Motion<double> at(double t) const override {
    deadline_.require();
    return motion_->at(t);
  }
  const ExactTrajectory* exact() const override { return motion_->exact(); }
  std::unique_ptr<Trajectory> relativeTo(const Vector3d& origin) const override {
    std::shared_ptr<const Trajectory> there = motion_->relativeTo(origin);
    return there ? std::make_unique<TimedTrajectory>(std::move(there), deadline_) : nullptr;
  }
  const std::vector<double>& knots() const override { return motion_->knots(); }

 private:
  std::shared_ptr<const Trajectory> motion_;
  Deadline deadline_;
};

}  // namespace

Scenario timed(const Scenario& scenario, const Deadline& deadline) {
  if (!deadline.isSet()) return scenario;
  Scenario out = scenario;
  out.trajectory = std::make_shared<const TimedTrajectory>(scenario.trajectory, deadline);
  return out;
}

}  // namespace ursula
