#include "validation/limits/further_engines.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "simbody/simbody_loop.h"

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

std::unique_ptr<Engine> makeSimbodyTree(const Manipulator& manipulator, std::shared_ptr<const Load> load) {
  return std::make_unique<SimbodyTree>(manipulator, std::move(load));
}

std::vector<EngineKind> allEngines() {
  std::vector<EngineKind> out = {{"torque.twin", "Simbody, tree through leg 1",
                                  "Simbody's tree through leg 1, balls at the others", alwaysAvailable,
                                  makeSimbodyTree}};
  for (const EngineKind& engine : partEngines()) out.push_back(engine);
  if (out.size() > most_further_engines) throw std::logic_error("more further engines than most_further_engines");
  return out;
}

}  // namespace

const std::vector<EngineKind>& furtherEngines() {
  static const std::vector<EngineKind> all = allEngines();
  return all;
}

const EngineKind* furtherEngineOf(const std::string& check) {
  const std::vector<EngineKind>& all = furtherEngines();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& engine) { return check == engine.check; });
  return found == all.end() ? nullptr : &*found;
}

OfFurtherEngines<std::unique_ptr<Engine>> makeFurtherEngines(const Manipulator& manipulator,
                                                             const std::shared_ptr<const Load>& load) {
  OfFurtherEngines<std::unique_ptr<Engine>> out;
  const std::vector<EngineKind>& all = furtherEngines();
  for (std::size_t k = 0; k < all.size(); ++k)
    if (all[k].available()) out[k] = all[k].make(manipulator, load);
  return out;
}

}  // namespace ursula
