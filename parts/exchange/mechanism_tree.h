#pragma once

#include "parts/exchange/model_graph.h"

namespace ursula::exchange {

/// Throws ImportError for what a mechanism has no words for: forces of a fluid, springs and Coulomb friction of balls,
/// free joints that rub.
void requireMechanism(const ModelGraph& graph);

/// Drops the joints between two bodies that stand still, and says so. Throws ImportError if a motor drives one.
void dropHeldJoints(ModelGraph& graph);

/// Lets the joints that are no closures form a tree from the bodies that stand still. Bodies that float together, with
/// no motor, are left out, as they have no effect on an effort. Throws ImportError if the machine itself floats.
void hangTree(ModelGraph& graph);

}  // namespace ursula::exchange
