#pragma once

#include <functional>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "parts/exchange/read/xml.h"

#include "base/scalar.h"

namespace ursula::exchange {

/// The settings of <compiler> for reading numbers.
struct MjcfCompiler {
  bool degrees = true;
  std::string euler = "xyz";  ///< lower case: about the rotated axes; upper case: about fixed axes
  bool auto_limits = true;
  enum class FromGeom { no, yes, automatic } from_geom = FromGeom::automatic;
  int least_group = 0, most_group = 5;
  bool balance_inertia = false;
  double least_mass = 0, least_inertia = 0, total_mass = -1;

  void read(const Element& compiler);
  double angle(double value) const { return degrees ? value * pi / 180 : value; }
};

/// Classes of <default>, each with everything that it inherits: class, element, attribute.
class MjcfDefaults {
 public:
  void read(const Element& root);
  /// Returns the effective attribute: the element's own, else that of its class, of the nearest childclass, or of the
  /// main class; "" if none gives it. `kind` is the element's name in <default>, its own name if empty.
  std::string get(const Element& element, const std::string& childclass, const char* name,
                  const std::string& kind = "") const;
  void requireClass(const Element& at, const std::string& name) const;

 private:
  using Attributes = std::map<std::string, std::string>;
  using Class = std::map<std::string, Attributes>;
  void read(const Element& element, const Class& inherited, bool top);

  std::map<std::string, Class> classes_;
  std::string main_ = "main";
  std::size_t inherited_ = 0;  ///< number of entries in all classes, because entries are copied down
};

/// Returns the effective text of an attribute; "" if nothing gives it.
using MjcfGet = std::function<std::string(const char*)>;

/// Reads the <option>s of a model: gravity, and forces of a fluid. Throws ImportError for flags that switch off what
/// the file says elsewhere.
void readMjcfOptions(const Element& root, ModelGraph& graph);

/// Returns the orientation by quat, axisangle, euler, xyaxes or zaxis. Throws ImportError if more than one is given.
Matrix3d mjcfOrientation(const Element& element, const MjcfCompiler& compiler, const MjcfGet& get);

/// A shape between two points: its frame, and half of its length.
struct MjcfFromTo {
  Eigen::Isometry3d frame;
  double half = 0;
};
MjcfFromTo mjcfFromTo(const Element& element, const std::string& points);

/// Adds a geom's mass to a body. Returns whether the geom is in the groups that give inertia. `at` is the geom's parent
/// frame in the world; `get` returns its attributes. Throws ImportError for shapes whose inertia is in another file.
bool addGeom(const Element& geom, const MjcfCompiler& compiler, const Eigen::Isometry3d& at, const MjcfGet& get,
             GraphBody& body);

/// Reads an <inertial>; `at` is the body's frame in the world.
void takeInertial(const Element& inertial, const MjcfCompiler& compiler, const Eigen::Isometry3d& at, GraphBody& body);

/// Applies balanceinertia, boundmass and boundinertia, and lists what they change. Throws ImportError for an invalid
/// tensor.
void boundInertia(const Element& element, const MjcfCompiler& compiler, GraphBody& body, Assumptions& assumptions);

/// Reads reference, spring, friction, armature and range of a joint whose kind is known. Throws ImportError for
/// springdamper.
void takeMjcfNumbers(const Element& element, const MjcfCompiler& compiler, const MjcfGet& get, GraphJoint& joint);

/// Returns whether gravcomp takes the whole gravity off a body. Throws ImportError for a part of it.
bool isCompensated(const Element& body);

/// Said of a file with keyframes.
constexpr const char* keyframes_left_out =
    "Keyframes are left out: the initial pose is the one that the bodies are written in";

struct MjcfSite {
  std::size_t body = 0;
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();  ///< in the world
};

/// The names that the tree gave: indices of the graph's bodies and joints, and sites.
struct MjcfNamed {
  std::unordered_map<std::string, std::size_t> bodies, joints;
  std::unordered_map<std::string, MjcfSite> sites;
  std::unordered_map<std::string, int> unnamed;  ///< how many there are of each of nameOf()'s names

  /// Returns an element's name; without one, a name of its own.
  std::string nameOf(const Element& element, const std::string& kind);
};

/// Adds the joints of <equality>, which close the tree's loops. Throws ImportError.
void readMjcfClosures(const Element& root, const MjcfDefaults& defaults, MjcfNamed& named, ModelGraph& graph);

/// Marks the joints that <actuator> drives. Throws ImportError.
void readMjcfActuators(const Element& root, const MjcfDefaults& defaults, const MjcfNamed& named, ModelGraph& graph);

}  // namespace ursula::exchange
