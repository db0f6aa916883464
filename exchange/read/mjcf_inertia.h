#pragma once

#include <functional>
#include <vector>

#include "exchange/model_graph.h"
#include "exchange/read/mjcf_settings.h"

namespace ursula::exchange {

/// Adds a geom's mass to a body. `at` is the geom's parent frame in the world; `get` returns its attributes. Throws
/// ImportError for shapes whose inertia is in another file.
void addGeom(const Element& geom, const MjcfCompiler& compiler, const Eigen::Isometry3d& at,
             const std::function<std::string(const char*)>& get, GraphBody& body);

/// Reads an <inertial>; `at` is the body's frame in the world.
void takeInertial(const Element& inertial, const MjcfCompiler& compiler, const Eigen::Isometry3d& at, GraphBody& body);

/// Applies balanceinertia, boundmass and boundinertia, and lists what they change. Throws ImportError for an invalid
/// tensor.
void boundInertia(const Element& element, const MjcfCompiler& compiler, GraphBody& body,
                  std::vector<Assumption>& assumptions);

}  // namespace ursula::exchange
