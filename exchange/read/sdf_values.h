#pragma once

#include "exchange/read/xml.h"

namespace ursula::exchange {

/// Position and rotation of an element's <pose>; the identity without one.
Eigen::Isometry3d sdfPoseOf(const Element& element);

/// Reads <inertial>: mass, mass centre and tensor, for a body whose frame is known. SDF's defaults are said.
void takeSdfInertial(const Element& link, GraphBody& body, std::vector<Assumption>& assumptions);

/// Reads limits and friction of an <axis>; `endless` leaves the limits out. Throws ImportError for springs, mimic and
/// joints that cannot move.
void takeSdfMotion(const Element& joint_element, const Element& axis, bool endless, GraphJoint& joint,
                   std::vector<Assumption>& assumptions);

/// A word's text: of a child in SDF (`childText`), of an attribute in URDF (`attribute`).
using TextOfWord = std::string (*)(const Element&, const char*);
/// Reads lower and upper. "inf" and numbers of 1e16 and more mean no limit.
void takeRange(const Element& limit, TextOfWord text, GraphJoint& joint);
/// Reads damping and friction. Throws ImportError for one below zero.
void takeRubbing(const Element& joint_element, const Element& dynamics, TextOfWord text, GraphJoint& joint);

/// Lists the plugins of `element`, which may bring forces. Throws ImportError for those that couple joints.
void listPlugins(const Element& element, const std::string& of, std::vector<Assumption>& assumptions);

/// Refuses a <velocity_decay> in `element` above zero, and `factor`, which is URDF's word for it.
void refuseSdfDecay(const Element& element, const std::string& factor = "");

/// Refuses <include>, but for the usual light and floor of a world, which are listed.
void refuseSdfIncludes(const Element& scope, std::vector<Assumption>& assumptions);

}  // namespace ursula::exchange
