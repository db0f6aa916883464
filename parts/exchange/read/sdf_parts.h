#pragma once

#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

#include "parts/exchange/read/xml.h"

namespace ursula::exchange {

/// Frames of an SDF file: their relative poses, with names per model.
class SdfFrames {
 public:
  static constexpr std::size_t world = 0;
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  enum class Kind { world, model, link, joint, frame };

  struct Frame {
    Kind kind = Kind::world;
    const Element* element = nullptr;
    std::size_t scope = 0;  ///< the model frame with the visible names
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    std::string relative_to;    ///< resolved in `scope`; if empty, `parent` applies
    std::size_t parent = none;  ///< default of `relative_to`
    std::size_t body = none;    ///< body of a link
    std::string attached_to;    ///< for a frame: the frame that has its body
  };

  SdfFrames();
  /// Adds a frame under its name to a scope. Throws ImportError if the name exists already.
  std::size_t add(const std::string& name, Frame frame);
  bool has(std::size_t scope, const std::string& name) const { return names_[scope].count(name) != 0; }
  /// Finds "a::b", "__model__", "world". Throws ImportError if there is no such frame.
  std::size_t find(const Element& at, std::size_t scope, const std::string& name, const char* what) const;

  /// Throws ImportError for a pose relative to itself, and for a frame attached to nothing or to itself, used or not.
  void requireSound();
  /// Returns the pose in the world. Throws ImportError for a circle.
  Eigen::Isometry3d inWorld(std::size_t frame);
  /// Returns the body of a link, a frame, a joint's child or a model's first link; `none` for the world.
  std::size_t bodyOf(const Element& at, std::size_t frame) const;

  Frame& operator[](std::size_t i) { return frames_[i]; }

 private:
  std::size_t parentOf(std::size_t i) const;

  std::vector<Frame> frames_;
  std::vector<std::unordered_map<std::string, std::size_t>> names_;  ///< one map per frame that is a scope
  std::vector<char> done_;
  std::vector<Eigen::Isometry3d> in_world_;
};

/// Returns position and rotation of an element's <pose>; the identity without one.
Eigen::Isometry3d sdfPoseOf(const Element& element);

/// Notes the added mass of a fluid in a link's <inertial>, which the user may leave out.
void noteAddedMass(const Element& link, ModelGraph& graph);

/// Reads <inertial>: mass, mass centre and tensor, for a body whose frame is known. SDF's defaults become assumptions.
void takeSdfInertial(const Element& link, GraphBody& body, Assumptions& assumptions);

/// Reads limits, friction, spring, motor and rotor of an <axis>; `endless` leaves the limits out. Throws ImportError
/// for mimic and joints that cannot move.
void takeSdfMotion(const Element& joint_element, const Element& axis, bool endless, GraphJoint& joint,
                   Assumptions& assumptions);

/// Reads lower and upper. "inf" and numbers of 1e16 and more mean no limit.
void takeRange(const Element& limit, TextOfWord text, GraphJoint& joint);
/// Throws ImportError if the lower limit is above the upper one.
void requireRange(const Element& element, const GraphJoint& joint);
/// Reads damping and friction. Throws ImportError for one below zero.
void takeRubbing(const Element& joint_element, const Element& dynamics, TextOfWord text, GraphJoint& joint);

/// Reads a spring's texts, which may be empty. Throws ImportError for a stiffness below zero.
void takeSpring(const Element& joint_element, const std::string& stiffness, const std::string& reference,
                GraphJoint& joint);

/// Lists the plugins of `element`, which may bring forces. Throws ImportError for those whose file name has "mimic" or
/// "spring", as they couple joints or pull at them.
void listPlugins(const Element& element, const std::string& of, Assumptions& assumptions);

/// Refuses a <velocity_decay> in `element` above zero. `factor` is the text of URDF's element for the same.
void refuseSdfDecay(const Element& element, const std::string& factor = "");

/// Reads the gravity of a world or, up to version 1.5, of its physics, and says SDF's default. Throws for a second one.
void readSdfGravity(const Element& top, int minor, ModelGraph& graph);

/// Refuses <include>, but for the usual light and floor of a world, which are listed.
void refuseSdfIncludes(const Element& scope, Assumptions& assumptions);

/// Drake's own elements follow, which stand in SDF and URDF.

/// A body's index by its name.
using BodyByName = std::function<std::size_t(const Element&, const std::string&)>;

/// Reads a model's `<drake:ball_constraint>` as closures. Throws ImportError for other active elements: bushings,
/// distances.
void readDrakeConstraints(const Element& model, ModelGraph& graph, const BodyByName& body);

/// Returns `<drake:rotor_inertia>` times the square of `<drake:gear_ratio>` (1 if missing); 0 without a rotor.
double drakeRotorInertia(const Element& element);

}  // namespace ursula::exchange
