// Reads MJCF by MuJoCo's XML reference, without MuJoCo, so it also reads files newer than the installed version.

#include <fmt/format.h>

#include <set>

#include "base/text.h"
#include "parts/exchange/read/mjcf_parts.h"

namespace ursula::exchange {
namespace {

const std::set<std::string> known_in_mujoco = wordsOf(
    "compiler option size visual statistic default asset worldbody contact equality actuator sensor keyframe custom "
    "tendon deformable extension");
const std::set<std::string> known_in_body = wordsOf("body joint freejoint inertial geom site camera light frame");

const std::set<std::string> known_of_joint = wordsOf(
    "name class type group pos axis springdamper limited solreflimit solimplimit stiffness range margin ref springref "
    "armature damping frictionloss solreffriction solimpfriction user align actuatorfrcrange actuatorfrclimited "
    "actuatorgravcomp");

const std::set<std::string> known_of_inertial =
    wordsOf("pos quat axisangle euler xyaxes zaxis mass diaginertia fullinertia");
const std::set<std::string> known_of_body =
    wordsOf("name childclass mocap pos quat axisangle euler xyaxes zaxis gravcomp user sleep");

const std::map<std::string, JointKind> kinds_in_mjcf = {{"hinge", JointKind::revolute},
                                                        {"slide", JointKind::prismatic},
                                                        {"ball", JointKind::ball},
                                                        {"free", JointKind::free}};

/// The frame and the class to which an element's numbers refer.
struct Place {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();  ///< in the world
  std::string childclass;
};

class MjcfReader {
 public:
  explicit MjcfReader(const Element& root) : root_(root) {
    graph_.format = ModelFormat::mjcf;
    graph_.name = attribute(root, "model");
    graph_.bodies.emplace_back();
    graph_.bodies[0].name = "world";
    graph_.bodies[0].fixed = true;
    named_.bodies["world"] = 0;
  }

  ModelGraph read() {
    refuseParts();
    listUnknown(root_, known_in_mujoco, graph_.assumptions);
    eachChild(root_, "compiler", [this](const Element& e) { compiler_.read(e); });
    readMjcfOptions(root_, graph_);
    defaults_.read(root_);
    eachChild(root_, "worldbody",
              [this](const Element& e) { readChildren(e, 0, Place(), Eigen::Isometry3d::Identity()); });
    scaleMasses();
    readMjcfClosures(root_, defaults_, named_, graph_);
    readSmoothing();
    readMjcfActuators(root_, defaults_, named_, graph_);
    refuseCompensation();
    readKeyframes();
    return graph_;
  }

 private:
  void refuseParts() const {
    for (const char* name : {"tendon", "deformable", "extension"})
      eachChild(root_, name, [&](const Element& part) {
        if (const Element* first = part.FirstChildElement())
          refuse(*first, fmt::format("of <{}>, which a scenario has no words for; {}", name, without_it));
      });
  }

  void readKeyframes() {
    eachChild(root_, "keyframe", [this](const Element& keys) {
      eachChild(keys, "key", [this](const Element& key) {
        graph_.keyframes.push_back({attribute(key, "name"), attribute(key, "qpos"), key.GetLineNum()});
      });
    });
    if (!graph_.keyframes.empty()) graph_.assumptions.push_back({keyframes_left_out, "<keyframe>"});
  }

  Eigen::Isometry3d placeOf(const Element& element, const MjcfGet& get) const {
    const std::string pos = get("pos");
    return placed(pos.empty() ? Vector3d::Zero() : vectorOf(element, pos, "pos"),
                  mjcfOrientation(element, compiler_, get));
  }

  Eigen::Isometry3d ownPlace(const Element& element) const {
    return placeOf(element, [&](const char* name) { return attribute(element, name); });
  }

  /// Visits the elements of a body, including those inside its <frame>s.
  template <class Visit>
  void eachContent(const Element& element, const Place& place, const Visit& visit) const {
    eachChild(element, nullptr, [&](const Element& e) {
      if (known_in_body.count(e.Name()) == 0)
        refuse(e, fmt::format("in {}, which is not read; mj_saveLastXML writes a model without it", named(element)));
      if (std::string(e.Name()) != "frame") return visit(e, place);
      Place inner = place;
      inner.frame = place.frame * ownPlace(e);
      if (const std::string own = attribute(e, "childclass"); !own.empty()) inner.childclass = own;
      eachContent(e, inner, visit);
    });
  }

  /// Reads inertia, geoms, sites and child bodies of the body with index `body`, whose parent has the frame `outer`.
  void readChildren(const Element& element, std::size_t body, const Place& place, const Eigen::Isometry3d& outer) {
    const Element* inertial = onlyChild(element, "inertial");
    if (inertial != nullptr) listUnknownAttributes(*inertial, known_of_inertial, graph_.assumptions);
    const bool from_geoms = compiler_.from_geom == MjcfCompiler::FromGeom::yes ||
                            (compiler_.from_geom == MjcfCompiler::FromGeom::automatic && inertial == nullptr);
    if (body != 0 && !from_geoms && inertial != nullptr)
      takeInertial(*inertial, compiler_, place.frame, graph_.bodies[body]);
    bool has_geoms = false;
    eachContent(element, place, [&](const Element& e, const Place& at) {
      const std::string kind = e.Name();
      const auto get = [&](const char* name) { return defaults_.get(e, at.childclass, name); };
      if (body == 0 && (kind == "joint" || kind == "freejoint" || kind == "inertial"))
        refuse(e, "of the world, which does not move; expected one of a body");
      if (kind == "geom" && body != 0 && from_geoms && isOfNoEffect(body, get))
        has_geoms = true;
      else if (kind == "geom" && body != 0 && from_geoms)
        has_geoms = addGeom(e, compiler_, at.frame, get, graph_.bodies[body]) || has_geoms;
      if (kind == "inertial" && e.Parent() != &element) refuse(e, "within a <frame>, expected it in the body itself");
      if (kind == "site" && !attribute(e, "name").empty()) {
        const Eigen::Isometry3d own = get("fromto").empty() ? placeOf(e, get) : mjcfFromTo(e, get("fromto")).frame;
        if (!named_.sites.emplace(attribute(e, "name"), MjcfSite{body, at.frame * own}).second)
          refuse(e, "a second site of that name, expected names of their own");
      }
    });
    // A body without geoms keeps its own numbers, whatever inertiafromgeom says.
    if (has_geoms && inertial != nullptr && graph_.bodies[body].mass == 0)
      refuse(*inertial, "inertiafromgeom=\"true\" puts geoms without mass in its place, expected geoms with mass");
    if (body != 0 && from_geoms && inertial != nullptr && !has_geoms)
      takeInertial(*inertial, compiler_, place.frame, graph_.bodies[body]);
    // MuJoCo's compiler gives a body without inertia its own position once more, which matters if boundmass adds mass.
    if (body != 0 && inertial == nullptr && !has_geoms)
      graph_.bodies[body].center_of_mass = place.frame * (outer.inverse() * place.frame).translation();
    if (body != 0) boundInertia(element, compiler_, graph_.bodies[body], graph_.assumptions);
    eachContent(element, place, [&](const Element& e, const Place& at) {
      if (std::string(e.Name()) == "body") readBody(e, body, at);
    });
  }

  /// Returns whether a geom's mass is that of a mesh on a body that is fixed to the world, and says so.
  bool isOfNoEffect(std::size_t body, const MjcfGet& get) {
    const bool is_mesh = !get("mesh").empty() || get("type") == "mesh" || get("type") == "sdf";
    if (!is_mesh || still_.count(body) == 0 || compiler_.total_mass > 0) return false;
    graph_.assumptions.push_back(
        {"The mass of this body's mesh is left out: the body stands still", graph_.bodies[body].name});
    return true;
  }

  void readBody(const Element& element, std::size_t parent, const Place& around) {
    Place place = around;
    place.frame = around.frame * ownPlace(element);
    if (const std::string own = attribute(element, "childclass"); !own.empty()) {
      defaults_.requireClass(element, own);
      place.childclass = own;
    }
    listUnknownAttributes(element, known_of_body, graph_.assumptions);
    const std::string name = named_.nameOf(element, "body");
    if (attribute(element, "mocap") == "true") {
      for (const char* joint : {"joint", "freejoint"})
        if (element.FirstChildElement(joint) != nullptr) refuse(element, "mocap and a joint, expected one of them");
      graph_.assumptions.push_back({"This body is moved from outside (mocap); it was taken to stand still", name});
    }
    const std::size_t body = addFrames(element, name, parent, place);
    if (!named_.bodies.emplace(name, body).second)
      refuse(element, "a second body of that name, expected names of their own");
    graph_.bodies[body].weightless = isCompensated(element);
    readChildren(element, body, place, graph_.bodies[parent].frame);
  }

  /// Gravity compensation that counts as a motor's effort would have to be taken from the effort.
  void noteCompensated(const Element& element, const MjcfGet& get, const GraphJoint& joint) {
    if (get("actuatorgravcomp") == "true") compensating_.emplace_back(&element, joint.name);
  }

  void refuseCompensation() const {
    for (const GraphBody& body : graph_.bodies)
      if (body.weightless && !compensating_.empty())
        refuse(*compensating_[0].first,
               fmt::format("actuatorgravcomp: what holds body {} (gravcomp) is a part of this motor's effort, which a "
                           "scenario has no words for; expected a file without one of the two",
                           shown(body.name)));
  }

  std::size_t addBody(const Element& element, const std::string& name, const Eigen::Isometry3d& frame) {
    GraphBody out;
    out.name = name;
    out.line = element.GetLineNum();
    out.frame = frame;
    out.center_of_mass = frame.translation();
    graph_.bodies.push_back(out);
    return graph_.bodies.size() - 1;
  }

  /// Adds the body, and massless frames between its joints, which act in their order.
  std::size_t addFrames(const Element& element, const std::string& name, std::size_t parent, const Place& place) {
    std::vector<std::pair<const Element*, Place>> joints;
    eachContent(element, place, [&](const Element& e, const Place& at) {
      if (std::string(e.Name()) == "joint" || std::string(e.Name()) == "freejoint") joints.emplace_back(&e, at);
    });
    std::size_t body = 0;
    for (std::size_t k = 0; k < joints.size(); ++k, parent = body) {
      const bool last = k + 1 == joints.size();
      body = addBody(last ? element : *joints[k].first,
                     last ? name : fmt::format("{} (before its joint {})", name, k + 2), place.frame);
      addJoint(*joints[k].first, joints[k].second, parent, body);
    }
    if (!joints.empty()) return body;
    GraphJoint fixed = jointAt(element, name + " (fixed)");
    fixed.parent = parent;
    fixed.child = addBody(element, name, place.frame);
    fixed.centre = fixed.centre_of_child = place.frame.translation();
    graph_.joints.push_back(fixed);
    if (still_.count(parent) != 0) still_.insert(fixed.child);
    return fixed.child;
  }

  void addJoint(const Element& element, const Place& at, std::size_t parent, std::size_t child) {
    const bool free = std::string(element.Name()) == "freejoint";
    const auto get = [&](const char* name) {
      return free ? std::string() : defaults_.get(element, at.childclass, name);
    };
    GraphJoint joint = jointAt(element, named_.nameOf(element, "joint"));
    joint.parent = parent;
    joint.child = child;
    const std::string type = free ? "free" : get("type").empty() ? "hinge" : get("type");
    const auto kind = kinds_in_mjcf.find(type);
    if (kind == kinds_in_mjcf.end())
      refuse(element, fmt::format("type '{}', expected hinge, slide, ball or free", shown(type)));
    joint.kind = kind->second;
    const std::string pos = get("pos"), axis = get("axis");
    joint.centre = joint.centre_of_child =
        joint.kind == JointKind::free ? at.frame.translation()
                                      : at.frame * (pos.empty() ? Vector3d::Zero() : vectorOf(element, pos, "pos"));
    joint.axis[0] = at.frame.linear() *
                    directionOf(element, axis.empty() ? Vector3d::UnitZ() : vectorOf(element, axis, "axis"), "axis");
    listUnknownAttributes(element, known_of_joint, graph_.assumptions);
    takeMjcfNumbers(element, compiler_, get, joint);
    noteCompensated(element, get, joint);
    if (!attribute(element, "name").empty() && !named_.joints.emplace(joint.name, graph_.joints.size()).second)
      refuse(element, "a second joint of that name, expected names of their own");
    graph_.joints.push_back(joint);
  }

  /// Reads the smoothing speeds of friction that `ursula export` wrote: NAME_smoothing_speed in <custom>.
  void readSmoothing() {
    const std::string end = "_smoothing_speed";
    eachChild(root_, "custom", [&](const Element& custom) {
      eachChild(custom, "numeric", [&](const Element& e) {
        const std::string name = attribute(e, "name");
        const std::size_t at = name.size() > end.size() ? name.size() - end.size() : 0;
        const auto found = named_.joints.find(name.substr(0, at));
        if (found != named_.joints.end() && name.substr(at) == end)
          graph_.joints[found->second].smoothing_speed = numberOf(e, attribute(e, "data"), "data");
      });
    });
  }

  void scaleMasses() {
    double sum = 0;
    for (const GraphBody& body : graph_.bodies) sum += body.mass;
    if (!(compiler_.total_mass > 0) || !(sum > 0)) return;
    const double scale = compiler_.total_mass / sum;
    for (GraphBody& body : graph_.bodies) {
      body.mass *= scale;
      body.inertia *= scale;
      body.inertia_rounding *= scale;
    }
    graph_.assumptions.push_back(
        {"All masses and inertias were scaled, as settotalmass says", "<compiler>", scale, "1"});
  }

  const Element& root_;
  MjcfCompiler compiler_;
  MjcfDefaults defaults_;
  MjcfNamed named_;
  std::set<std::size_t> still_ = {0};                                 ///< bodies that are fixed to the world
  std::vector<std::pair<const Element*, std::string>> compensating_;  ///< joints with actuatorgravcomp
  ModelGraph graph_;
};

}  // namespace

ModelGraph readMjcf(const Element& root) { return MjcfReader(root).read(); }

}  // namespace ursula::exchange
