#include <utility>

#include "engines/further_engines.h"
#include "engines/simbody/simbody_loop.h"

namespace ursula {
namespace {

/// SimbodyLoop with the platform on leg 1, so the loops are cut elsewhere.
class SimbodyTree : public Engine {
 public:
  SimbodyTree(const Manipulator& manipulator, std::shared_ptr<const Load> load)
      : loop_(manipulator, SimbodyLoop::Topology::tree_through_leg_1, std::move(load)) {}

  Vector6d inverseDynamics(const Motion<double>& motion) override {
    loop_.place(motion);
    return loop_.inverseDynamics();
  }

 private:
  SimbodyLoop loop_;
};

}  // namespace

std::unique_ptr<Engine> makeSimbodyTree(const Manipulator& manipulator, std::shared_ptr<const Load> load) {
  return std::make_unique<SimbodyTree>(manipulator, std::move(load));
}

}  // namespace ursula
