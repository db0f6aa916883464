// Reads SDF of any version, by the rules of http://sdformat.org/spec and of its proposal for pose frame semantics.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "parts/exchange/read/sdf_parts.h"

namespace ursula::exchange {
namespace {

using Kind = SdfFrames::Kind;

const std::set<std::string> known_in_link = wordsOf(
    "pose inertial collision visual sensor gravity kinematic light frame self_collide must_be_base_link projector "
    "audio_sink audio_source battery particle_emitter plugin velocity_decay");
const std::set<std::string> known_in_joint = wordsOf(
    "pose parent child axis axis2 thread_pitch screw_thread_pitch gearbox_ratio gearbox_reference_body sensor frame "
    "plugin");
const std::set<std::string> known_in_axis = wordsOf("xyz initial_position use_parent_model_frame dynamics limit mimic");
const std::set<std::string> known_in_world = wordsOf(
    "gravity physics frame model joint include light plugin gui scene audio atmosphere wind magnetic_field "
    "spherical_coordinates road");
const std::set<std::string> known_in_model =
    wordsOf("static self_collide allow_auto_disable enable_wind pose link model joint frame include gripper plugin");
constexpr int newest_minor = 12;

class SdfReader {
 public:
  explicit SdfReader(const Element& root) : root_(root) {
    const std::string version = attribute(root, "version");
    const std::size_t dot = version.find('.');
    if (version.substr(0, dot) != "1" || dot == std::string::npos)
      refuse(root, fmt::format("version '{}', expected 1.2 to 1.12", shown(version)));
    minor_ = static_cast<int>(numberOf(root, version.substr(dot + 1), "version"));
    if (minor_ < 2)
      refuse(root, fmt::format("version '{}' has <origin>, which is not read; convert the file: gz sdf -p FILE",
                               shown(version)));
    if (minor_ > newest_minor)
      refuse(root, fmt::format("version '{}', of which nothing is known, expected at most 1.{}", shown(version),
                               newest_minor));
    graph_.format = ModelFormat::sdf;
    graph_.gravity = Vector3d(0, 0, -9.8);
    graph_.bodies.emplace_back();
    graph_.bodies[0].name = "world";
    graph_.bodies[0].fixed = true;
  }

  ModelGraph read() {
    const Element* world = root_.FirstChildElement("world");
    const Element& top = world == nullptr ? root_ : *world;
    if (world != nullptr && world->NextSiblingElement("world") != nullptr)
      refuse(*world->NextSiblingElement("world"), "a second world, expected one");
    readSdfGravity(top, minor_, graph_);
    if (const Element* state = top.FirstChildElement("state"))
      refuse(*state, "gives models another pose, which not every reader takes; expected a file without it");
    listUnknown(top, known_in_world, graph_.assumptions);
    refuseSdfIncludes(top, graph_.assumptions);
    eachChild(top, "frame", [&](const Element& e) { addFrame(e, SdfFrames::world); });
    eachChild(top, "model", [&](const Element& e) { addModel(e, SdfFrames::world, false); });
    if (models_.empty()) refuse(top, "no <model>, expected one");
    graph_.name = attribute(*frames_[models_[0]].element, "name");
    frames_.requireSound();
    for (const std::size_t link : links_) readLink(link);
    for (const std::size_t joint : joints_) readJoint(joint);
    if (world != nullptr) eachChild(top, "joint", [&](const Element& e) { readJoint(addJoint(e, SdfFrames::world)); });
    for (const GraphJoint& joint : graph_.joints)
      if (joint.driven) graph_.motors.push_back(joint.name);
    for (const std::size_t model : models_)
      readDrakeConstraints(*frames_[model].element, graph_, [&](const Element& at, const std::string& name) {
        return bodyIndex(at, frames_.find(at, model, name, "body"));
      });
    return graph_;
  }

 private:
  /// Returns a frame's name in an attribute. Refuses one before version 1.7, because readers differ in whether they
  /// heed it.
  std::string frameNamed(const Element* element, const char* name) const {
    const std::string frame = element == nullptr ? "" : attribute(*element, name);
    if (minor_ < 7 && !frame.empty())
      refuse(*element, fmt::format("{}='{}' in version 1.{}, in which readers differ; expected version 1.7 or newer",
                                   name, shown(frame), minor_));
    return frame;
  }

  std::string relativeTo(const Element& element) const {
    const Element* pose = onlyChild(element, "pose");
    if (minor_ < 7) static_cast<void>(frameNamed(pose, "frame"));
    return frameNamed(pose, "relative_to");
  }

  SdfFrames::Frame frameOf(const Element& element, std::size_t scope, Kind kind) const {
    SdfFrames::Frame out;
    out.kind = kind;
    out.element = &element;
    out.scope = scope;
    out.parent = scope;
    out.pose = sdfPoseOf(element);
    out.relative_to = relativeTo(element);
    return out;
  }

  void addFrame(const Element& element, std::size_t scope) {
    SdfFrames::Frame frame = frameOf(element, scope, Kind::frame);
    frame.attached_to = attribute(element, "attached_to");
    if (frame.relative_to.empty()) frame.relative_to = frame.attached_to;
    frames_.add(requiredAttribute(element, "name"), frame);
  }

  std::size_t addJoint(const Element& element, std::size_t scope) {
    SdfFrames::Frame joint = frameOf(element, scope, Kind::joint);
    joint.attached_to = childText(element, "child");
    if (joint.attached_to.empty()) refuse(element, "no <child>, expected a link's name");
    if (joint.relative_to.empty()) joint.relative_to = joint.attached_to;
    return frames_.add(requiredAttribute(element, "name"), joint);
  }

  void addModel(const Element& element, std::size_t scope, bool fixed) {
    const std::string name = requiredAttribute(element, "name"), placement = attribute(element, "placement_frame");
    refuseSdfIncludes(element, graph_.assumptions);
    listUnknown(element, known_in_model, graph_.assumptions);
    const std::size_t model = frames_.add(name, frameOf(element, scope, Kind::model));
    models_.push_back(model);
    listPlugins(element, name, graph_.assumptions);
    const std::string is_static = childText(element, "static");
    fixed = fixed || (!is_static.empty() && truthOf(element, is_static, "<static>"));
    const std::string path = scope == SdfFrames::world ? "" : paths_[scope] + name + "::";
    paths_.resize(model + 1);
    paths_[model] = path;
    eachChild(element, "link", [&](const Element& e) { addLink(e, model, path, fixed); });
    eachChild(element, "model", [&](const Element& e) { addModel(e, model, fixed); });
    eachChild(element, "frame", [&](const Element& e) { addFrame(e, model); });
    eachChild(element, "joint", [&](const Element& e) { joints_.push_back(addJoint(e, model)); });
    std::set<std::string> coupled = known_in_model;
    coupled.insert("drake:ball_constraint");
    refuseCouplings(element, coupled, [&](const std::string& word) { return frames_.has(model, word); });
    if (frames_[model].body == SdfFrames::none) takeFirstLink(element, model);
    if (const std::string canonical = attribute(element, "canonical_link"); !canonical.empty())
      frames_[model].body = frames_[frames_.find(element, model, canonical, "canonical_link")].body;
    if (!placement.empty()) place(element, model, placement);
  }

  /// Lets the first link of a nested model represent a model without own links.
  void takeFirstLink(const Element& element, std::size_t model) {
    if (const Element* inner = element.FirstChildElement("model"))
      frames_[model].body = frames_[frames_.find(*inner, model, attribute(*inner, "name"), "model")].body;
  }

  /// Moves the model so that its given pose is that of another frame in it.
  void place(const Element& element, std::size_t model, const std::string& placement) {
    Eigen::Isometry3d inside = Eigen::Isometry3d::Identity();
    std::size_t at = frames_.find(element, model, placement, "placement_frame");
    for (std::size_t step = 0; at != model; ++step) {
      const SdfFrames::Frame& frame = frames_[at];
      if (step > 1000 || frame.kind == Kind::world) refuse(element, "its placement frame does not hang on the model");
      inside = frame.pose * inside;
      at = frame.relative_to.empty() ? frame.parent
                                     : frames_.find(*frame.element, frame.scope, frame.relative_to, "relative_to");
    }
    frames_[model].pose = frames_[model].pose * inside.inverse();
  }

  void addLink(const Element& element, std::size_t model, const std::string& path, bool fixed) {
    const std::string name = requiredAttribute(element, "name");
    const std::size_t link = frames_.add(name, frameOf(element, model, Kind::link));
    frames_[link].body = graph_.bodies.size();
    if (frames_[model].body == SdfFrames::none) frames_[model].body = graph_.bodies.size();
    GraphBody body;
    body.name = path + name;
    body.line = element.GetLineNum();
    body.fixed = fixed;
    graph_.bodies.push_back(body);
    links_.push_back(link);
  }

  void readLink(std::size_t link) {
    const Element& element = *frames_[link].element;
    GraphBody& body = graph_.bodies[frames_[link].body];
    body.frame = frames_.inWorld(link);
    listUnknown(element, known_in_link, graph_.assumptions);
    const std::string gravity = childText(element, "gravity"), kinematic = childText(element, "kinematic");
    body.weightless = !gravity.empty() && !truthOf(element, gravity, "<gravity>");
    if (!kinematic.empty() && truthOf(element, kinematic, "<kinematic>"))
      refuse(element, "<kinematic>, moved from outside, which a scenario has no words for");
    refuseSdfDecay(element);
    noteAddedMass(element, graph_);
    takeSdfInertial(element, body, graph_.assumptions);
  }

  std::size_t bodyIndex(const Element& at, std::size_t frame) const {
    const std::size_t body = frames_.bodyOf(at, frame);
    return body == SdfFrames::none ? 0 : body;
  }

  void readJoint(std::size_t index) {
    const SdfFrames::Frame frame = frames_[index];
    const Element& element = *frame.element;
    listUnknown(element, known_in_joint, graph_.assumptions);
    const std::string type = requiredAttribute(element, "type");
    const std::string parent = childText(element, "parent");
    if (parent.empty()) refuse(element, "no <parent>, expected a link's name");
    GraphJoint joint =
        jointAt(element, (frame.scope == SdfFrames::world ? "" : paths_[frame.scope]) + attribute(element, "name"));
    joint.parent = bodyIndex(element, frames_.find(element, frame.scope, parent, "<parent>"));
    joint.child = bodyIndex(element, frames_.find(element, frame.scope, frame.attached_to, "<child>"));
    const Eigen::Isometry3d at = frames_.inWorld(index);
    joint.centre = joint.centre_of_child = at.translation();
    joint.closure = !have_parent_.insert(joint.child).second;
    joint.rotor_inertia = drakeRotorInertia(element);
    if (element.FirstChildElement("drake:mimic"))
      refuse(element, fmt::format("mimic, which a scenario has no words for; {}", without_it));
    if (type == "fixed" || type == "ball") {
      joint.kind = type == "fixed" ? JointKind::fixed : JointKind::ball;
      // Readers differ in whether a ball's axis rubs; what rubs is refused later.
      if (const Element* axis = element.FirstChildElement("axis"); axis != nullptr && type == "ball")
        takeSdfMotion(element, *axis, true, joint, graph_.assumptions);
      graph_.joints.push_back(joint);
    } else if (type == "revolute" || type == "prismatic" || type == "continuous") {
      joint.kind = type == "prismatic" ? JointKind::prismatic : JointKind::revolute;
      takeAxis(element, "axis", frame.scope, at, type == "continuous", joint);
      graph_.joints.push_back(joint);
    } else if (type == "universal" || type == "revolute2") {
      addTwoAxes(element, type, frame.scope, at, joint);
    } else {
      refuse(element, fmt::format("a {} joint, which a scenario has no words for, expected revolute, prismatic, "
                                  "universal, revolute2, ball or fixed; {}",
                                  shown(type), without_it));
    }
  }

  /// Adds two hinges with a massless frame between them.
  void addTwoAxes(const Element& element, const std::string& type, std::size_t scope, const Eigen::Isometry3d& at,
                  GraphJoint joint) {
    if (!element.FirstChildElement("axis") || !element.FirstChildElement("axis2"))
      refuse(element, fmt::format("a {} joint with one axis is unfinished, expected <axis> and <axis2>", type));
    GraphBody cross;
    cross.name = joint.name + " (cross)";
    cross.line = joint.line;
    cross.frame = at;
    joint.kind = JointKind::revolute;
    GraphJoint second = joint;
    joint.name += "/axis";
    second.name += "/axis2";
    joint.child = second.parent = graph_.bodies.size();
    second.rotor_inertia = 0;
    joint.closure = false;  // no other joint carries the cross
    graph_.bodies.push_back(cross);
    takeAxis(element, "axis", scope, at, false, joint);
    takeAxis(element, "axis2", scope, at, false, second);
    graph_.joints.push_back(joint);
    graph_.joints.push_back(second);
  }

  void takeAxis(const Element& element, const char* which, std::size_t scope, const Eigen::Isometry3d& at, bool endless,
                GraphJoint& joint) {
    const Element* axis = onlyChild(element, which);
    if (axis == nullptr) refuse(element, fmt::format("no <{}>, expected one", which));
    listUnknown(*axis, known_in_axis, graph_.assumptions);
    const Element* xyz = onlyChild(*axis, "xyz");
    const Vector3d given = xyz == nullptr ? Vector3d::UnitZ() : vectorOf(*xyz, textOf(*xyz), "<xyz>");
    Matrix3d frame = at.linear();
    const std::string of_model = childText(*axis, "use_parent_model_frame");
    // Up to 1.4 it is the default, as libsdformat converts these files.
    const bool in_model = of_model.empty() ? minor_ <= 4 : truthOf(*axis, of_model, "<use_parent_model_frame>");
    if (minor_ <= 6 && in_model) frame = frames_.inWorld(scope).linear();
    const std::string expressed_in = frameNamed(xyz, "expressed_in");
    if (!expressed_in.empty())
      frame = frames_.inWorld(frames_.find(*xyz, scope, expressed_in, "expressed_in")).linear();
    joint.axis[0] = frame * directionOf(*axis, given, "<xyz>");
    if (minor_ >= 7 && in_model) {
      const Vector3d other = frames_.inWorld(scope).linear() * directionOf(*axis, given, "<xyz>");
      graph_.assumptions.push_back(
          {"use_parent_model_frame has no meaning from SDF 1.7 on and was left out; the axis would turn by this",
           joint.name, std::atan2(other.cross(joint.axis[0]).norm(), other.dot(joint.axis[0])), "rad"});
    }
    takeSdfMotion(element, *axis, endless, joint, graph_.assumptions);
  }

  const Element& root_;
  int minor_ = 0;
  SdfFrames frames_;
  std::vector<std::size_t> models_, links_, joints_;
  std::vector<std::string> paths_;
  std::set<std::size_t> have_parent_;
  ModelGraph graph_;
};

}  // namespace

ModelGraph readSdf(const Element& root) { return SdfReader(root).read(); }

}  // namespace ursula::exchange
