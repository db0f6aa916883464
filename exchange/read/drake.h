#pragma once

#include <functional>
#include <string>

#include "exchange/model_graph.h"
#include "exchange/read/xml.h"

namespace ursula::exchange {

/// Drake's own elements in SDF and URDF.

/// A body's index by its name.
using BodyByName = std::function<std::size_t(const Element&, const std::string&)>;

/// `<drake:ball_constraint>` of a model, as closures. Throws ImportError for others that act: bushings, distances.
void readDrakeConstraints(const Element& model, ModelGraph& graph, const BodyByName& body);

/// `<drake:rotor_inertia>` times the square of `<drake:gear_ratio>`, which is 1 where it is not there; 0 without a
/// rotor.
double drakeRotorInertia(const Element& element);

}  // namespace ursula::exchange
