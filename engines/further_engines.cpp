#include "engines/further_engines.h"

#include <algorithm>
#include <utility>

#include "engines/maximal/maximal_loop.h"
#include "engines/mujoco/mujoco_loop.h"
#include "engines/simbody/simbody_loop.h"

namespace ursula {
namespace {

/// The same builder as the six balls', cut elsewhere.
class SimbodyTwin : public Engine {
 public:
  SimbodyTwin(const Manipulator& manipulator, std::shared_ptr<const Load> load)
      : loop_(manipulator, SimbodyLoop::Topology::tree_through_leg_1, std::move(load)) {}

  Vector6d inverseDynamics(const Motion<double>& motion) override {
    loop_.place(motion);
    return loop_.inverseDynamics();
  }

 private:
  SimbodyLoop loop_;
};

template <typename Kind>
std::unique_ptr<Engine> make(const Manipulator& manipulator, std::shared_ptr<const Load> load) {
  return std::make_unique<Kind>(manipulator, std::move(load));
}

bool always() { return true; }

constexpr OfFurtherEngines<EngineKind> engines = {{
    {"torque.twin", "Simbody, tree through leg 1", "Simbody's loop grown through leg 1, balls at the others", "Simbody",
     always, make<SimbodyTwin>},
    {"torque.maximal", "maximal coordinates", "links and platform in maximal coordinates with Lagrange multipliers",
     "maximal coordinates", always, make<MaximalLoop>},
    {"torque.mujoco", "MuJoCo", "MuJoCo's trees, closed by Lagrange multipliers", "MuJoCo", mujocoAvailable,
     make<MujocoLoop>},
}};

}  // namespace

const OfFurtherEngines<EngineKind>& furtherEngines() { return engines; }

const EngineKind* furtherEngineOf(const std::string& check) {
  const auto* found =
      std::find_if(engines.begin(), engines.end(), [&](const EngineKind& engine) { return check == engine.check; });
  return found == engines.end() ? nullptr : found;
}

OfFurtherEngines<std::unique_ptr<Engine>> makeFurtherEngines(const Manipulator& manipulator,
                                                             const std::shared_ptr<const Load>& load) {
  OfFurtherEngines<std::unique_ptr<Engine>> out;
  for (std::size_t k = 0; k < engines.size(); ++k)
    if (engines[k].available()) out[k] = engines[k].make(manipulator, load);
  return out;
}

}  // namespace ursula
