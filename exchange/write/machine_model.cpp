#include "exchange/write/machine_model.h"

#include <algorithm>

namespace ursula::exchange {

const GraphJoint* carrierOf(const ModelGraph& graph, std::size_t body) {
  const auto found = std::find_if(graph.joints.begin(), graph.joints.end(),
                                  [body](const GraphJoint& joint) { return !joint.closure && joint.child == body; });
  return found == graph.joints.end() ? nullptr : &*found;
}

std::vector<TreeBody> treeBodiesOf(const ModelGraph& graph) {
  std::vector<TreeBody> out;
  for (std::size_t body = 0; body < graph.bodies.size(); ++body) {
    if (graph.bodies[body].fixed || graph.bodies[body].mass == 0) continue;
    TreeBody tree_body{body, body, {}};
    do {
      const GraphJoint* joint = carrierOf(graph, tree_body.parent);
      if (joint == nullptr) break;
      tree_body.joints.insert(tree_body.joints.begin(), static_cast<std::size_t>(joint - graph.joints.data()));
      tree_body.parent = joint->parent;
    } while (!graph.bodies[tree_body.parent].fixed && graph.bodies[tree_body.parent].mass == 0);
    out.push_back(tree_body);
  }
  return out;
}

}  // namespace ursula::exchange
