#pragma once

#include "parts/engines/closed_mechanism.h"

namespace ursula::dart_engine {

/// A spanning tree; computeInverseDynamics gives the forces on its speeds.
BuildTree buildTree;

}  // namespace ursula::dart_engine
