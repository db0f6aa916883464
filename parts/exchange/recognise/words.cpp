#include <fmt/format.h>

#include "parts/exchange/recognise/chains.h"

namespace ursula::exchange {

void requireWords(const ModelGraph& graph) {
  for (const OtherForce& force : graph.other_forces) throw ImportError(force.refusal, force.line);
  for (const GraphJoint& joint : graph.joints) {
    if (joint.stiffness != 0)
      refuseJoint(joint,
                  fmt::format(": a spring of stiffness {}, which a scenario has no words for, but in [mechanism]",
                              joint.stiffness));
    if (joint.kind == JointKind::free && joint.isLoaded())
      refuseJoint(joint,
                  fmt::format(": a free joint with damping {}, frictionloss {} and armature {}, which a scenario "
                              "has no key for; MJCF's <freejoint> takes none from defaults",
                              joint.damping, joint.friction, joint.rotor_inertia));
  }
}

}  // namespace ursula::exchange
