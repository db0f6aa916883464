#include "exchange/write/machine_model.h"

#include <algorithm>

namespace ursula::exchange {

const GraphJoint* carrierOf(const ModelGraph& graph, std::size_t body) {
  const auto found = std::find_if(graph.joints.begin(), graph.joints.end(),
                                  [body](const GraphJoint& joint) { return !joint.closure && joint.child == body; });
  return found == graph.joints.end() ? nullptr : &*found;
}

std::vector<Limb> limbsOf(const ModelGraph& graph) {
  std::vector<Limb> out;
  for (std::size_t body = 0; body < graph.bodies.size(); ++body) {
    if (graph.bodies[body].fixed || graph.bodies[body].mass == 0) continue;
    Limb limb{body, body, {}};
    do {
      const GraphJoint* joint = carrierOf(graph, limb.parent);
      if (joint == nullptr) break;
      limb.joints.insert(limb.joints.begin(), static_cast<std::size_t>(joint - graph.joints.data()));
      limb.parent = joint->parent;
    } while (!graph.bodies[limb.parent].fixed && graph.bodies[limb.parent].mass == 0);
    out.push_back(limb);
  }
  return out;
}

}  // namespace ursula::exchange
