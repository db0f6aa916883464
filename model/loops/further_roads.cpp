#include "model/loops/further_roads.h"

#include <algorithm>
#include <utility>

#include "model/loops/maximal/maximal_loop.h"
#include "model/loops/mujoco/mujoco_loop.h"
#include "model/loops/simbody/simbody_loop.h"

namespace ursula {
namespace {

/// The same builder as the six balls', cut elsewhere.
class SimbodyTwin : public Road {
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
std::unique_ptr<Road> make(const Manipulator& manipulator, std::shared_ptr<const Load> load) {
  return std::make_unique<Kind>(manipulator, std::move(load));
}

bool always() { return true; }

constexpr OfFurtherRoads<RoadKind> roads = {{
    {"torque.twin", "Simbody, tree through leg 1", "Simbody's loop grown through leg 1, balls at the others", "Simbody",
     always, make<SimbodyTwin>},
    {"torque.maximal", "maximal coordinates", "links and platform in maximal coordinates with Lagrange multipliers",
     "maximal coordinates", always, make<MaximalLoop>},
    {"torque.mujoco", "MuJoCo", "MuJoCo's trees, closed by Lagrange multipliers", "MuJoCo", mujocoAvailable,
     make<MujocoLoop>},
}};

}  // namespace

const OfFurtherRoads<RoadKind>& furtherRoads() { return roads; }

const RoadKind* furtherRoadOf(const std::string& check) {
  const auto* found =
      std::find_if(roads.begin(), roads.end(), [&](const RoadKind& road) { return check == road.check; });
  return found == roads.end() ? nullptr : found;
}

OfFurtherRoads<std::unique_ptr<Road>> makeFurtherRoads(const Manipulator& manipulator,
                                                       const std::shared_ptr<const Load>& load) {
  OfFurtherRoads<std::unique_ptr<Road>> out;
  for (std::size_t k = 0; k < roads.size(); ++k)
    if (roads[k].available()) out[k] = roads[k].make(manipulator, load);
  return out;
}

}  // namespace ursula
