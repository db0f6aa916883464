#pragma once

#include <functional>
#include <string>

#include "exchange/model_graph.h"
#include "exchange/read/xml.h"

namespace ursula::exchange {

/// Drake's own elements in SDF and URDF.

/// A body's index by its name.
using BodyByName = std::function<std::size_t(const Element&, const std::string&)>;

/// Reads a model's `<drake:ball_constraint>` as closures. Throws ImportError for other active elements: bushings,
/// distances.
void readDrakeConstraints(const Element& model, ModelGraph& graph, const BodyByName& body);

/// Returns `<drake:rotor_inertia>` times the square of `<drake:gear_ratio>` (1 if missing); 0 without a rotor.
double drakeRotorInertia(const Element& element);

}  // namespace ursula::exchange
