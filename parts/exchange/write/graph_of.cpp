#include "parts/exchange/write/export.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "parts/exchange/leg_pose.h"

namespace ursula::exchange {
namespace {

/// Keeps letters and digits of any language, '-', '_' and '.', which every format accepts in a name.
std::string safeName(const std::string& name) {
  std::string out = name;
  for (char& c : out) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = (byte >= '0' && byte <= '9') || (byte >= 'A' && byte <= 'Z') || (byte >= 'a' && byte <= 'z');
    if (!plain && byte < 0x80 && c != '-' && c != '_' && c != '.') c = '_';
  }
  return out.empty() || out == "world" || out.rfind("__", 0) == 0 ? "machine" + out : out;
}

class Builder {
 public:
  explicit Builder(const Scenario& scenario) : machine_(*scenario.manipulator), pose_(scenario.trajectory->at(0)) {
    ModelGraph& graph = out_.graph;
    graph.name = safeName(scenario.name);
    graph.gravity = machine_.gravity();
    addBody("base", Eigen::Isometry3d::Identity(), 0, {});
    graph.bodies.front().fixed = true;
    for (int leg = 0; leg < machine_.legCount(); ++leg) addLeg(leg);
    addPlatform();
    if (graph.name != scenario.name)
      note(fmt::format("The name is written '{}', as other characters are not for names everywhere", graph.name),
           "name", 0, "1");
    note("The file has the machine at its first instant; it leaves out the motion", "trajectory",
         scenario.trajectory->duration(), "s");
    if (scenario.load) noteLoad(*scenario.load);
  }

  MachineModel take() { return std::move(out_); }

 private:
  std::size_t addBody(const std::string& name, const Eigen::Isometry3d& frame, double mass, const OwnNumbers& own) {
    GraphBody body;
    body.name = name;
    body.frame = frame;
    body.mass = mass;
    body.center_of_mass = frame * own.center_of_mass;
    body.inertia = frame.linear() * own.inertia * frame.linear().transpose();
    out_.graph.bodies.push_back(body);
    out_.own.push_back(own);
    return out_.graph.bodies.size() - 1;
  }

  void addLeg(int index) {
    const Leg& leg = machine_.leg(index);
    const Vector3d tip = pose_.p + pose_.Q * leg.platform_point;
    const LegPose at = legPose(leg, index, tip);
    const std::string name = fmt::format("leg_{}", index + 1);
    // The moment of a free rod about its line has no effect on efforts, so the machine leaves it out; a file has it.
    const Leg& links = leg.spins ? machine_.given().legs[index] : leg;
    std::size_t body = 0;
    for (int k = 0; k < 3; ++k) {
      const int link = at.chain.linkOf(k);
      const bool in_universal = !at.chain.movesLink(k), to_proximal = !in_universal && link == 0,
                 to_distal = !in_universal && link == 1;
      if (in_universal && leg.spins) continue;  // one ball instead of both hinges
      const Eigen::Isometry3d& frame = at.at.links[link];
      const std::size_t next = to_proximal ? addLink(name + "_proximal", frame, links.proximal, leg.proximalCenter())
                               : to_distal ? addLink(name + "_distal", frame, links.distal, leg.distalCenter())
                                           : addBody(name + "_cross", frame, 0, {});
      if (leg.spins && !at.chain.slides(k) && k > 0)
        addBall(name + "_inner_ball", body, next, centreOf(at, k), false);
      else
        addCoordinate(index, k, at, body, next);
      if (to_proximal) draw(next, frame.translation(), frame * at.chain.far_end, 0.02);
      if (to_distal) draw(next, frame.translation(), tip, 0.014);
      body = next;
    }
    tips_.push_back({body, tip});
    if (rowOf(leg.kind).hasCarriage() && leg.proximal.length != 0)
      note("The carriage's length is for drawing and is left out", name, leg.proximal.length, "m");
  }

  std::size_t addLink(const std::string& name, const Eigen::Isometry3d& frame, const Link& link,
                      const Vector3d& center_of_mass) {
    return addBody(name, frame, link.mass, {center_of_mass, link.inertia});
  }

  /// The first joint's is the base point, even if it slides.
  static Vector3d centreOf(const LegPose& at, int k) { return k == 0 ? at.chain.base_point : at.at.anchors[k]; }

  void addCoordinate(int index, int k, const LegPose& at, std::size_t parent, std::size_t child) {
    const Leg& leg = machine_.leg(index);
    const Coordinate coordinate = at.chain.row.coordinates[k];
    GraphJoint joint;
    joint.name = fmt::format("leg_{}_{}", index + 1, nameOf(coordinate));
    joint.kind = slides(coordinate) ? JointKind::prismatic : JointKind::revolute;
    joint.parent = parent;
    joint.child = child;
    joint.centre = joint.centre_of_child = centreOf(at, k);
    joint.axis[0] = at.at.axes[k];
    joint.position = at.q(k);
    joint.damping = leg.friction.on(coordinate);
    joint.friction = leg.coulomb.on(coordinate);
    joint.smoothing_speed = joint.friction != 0 ? leg.coulomb.speedOf(coordinate) : 0;
    joint.driven = leg.actuated[k];
    joint.rotor_inertia = leg.rotor_inertia.on(coordinate);
    if (at.chain.row.isTelescopic() && slides(coordinate)) {
      joint.lower = leg.distal.length;
      joint.upper = leg.distal.length + leg.proximal.length;
    }
    if (joint.friction != 0)
      note("Coulomb friction is sharp for other tools: only an import reads its smoothing", joint.name,
           joint.smoothing_speed, slides(coordinate) ? "m/s" : "rad/s");
    out_.graph.joints.push_back(joint);
  }

  void addPlatform() {
    const Platform& platform = machine_.platform();
    Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
    frame.linear() = pose_.Q;
    frame.translation() = pose_.p;
    const std::size_t body = addBody("platform", frame, platform.mass, {platform.center_of_mass, platform.inertia});
    Vector3d centre = Vector3d::Zero();
    for (const auto& tip : tips_) centre += tip.second / static_cast<double>(tips_.size());
    for (std::size_t i = 0; i < tips_.size(); ++i) {
      addBall(fmt::format("leg_{}_ball", i + 1), tips_[i].first, body, tips_[i].second, i > 0);
      draw(body, centre, tips_[i].second, 0.02);
    }
  }

  void addBall(const std::string& name, std::size_t parent, std::size_t child, const Vector3d& centre, bool closure) {
    GraphJoint ball;
    ball.name = name;
    ball.kind = JointKind::ball;
    ball.parent = parent;
    ball.child = child;
    ball.centre = ball.centre_of_child = centre;
    ball.closure = closure;
    out_.graph.joints.push_back(ball);
  }

  void draw(std::size_t body, const Vector3d& from, const Vector3d& to, double slenderness) {
    const Leg& leg = machine_.leg(0);
    const double size = leg.proximal.length + leg.distal.length;
    if ((to - from).norm() > 1e-6 * size) out_.rods.push_back({body, from, to, slenderness * size});
  }

  void note(const std::string& what, const std::string& where, double size, const std::string& unit) {
    out_.graph.assumptions.push_back({what, where, size, unit});
  }

  void noteLoad(const Load& load) {
    double force = load.force.norm(), moment = load.moment.norm();
    if (load.history)
      for (const TimedWrench& row : load.history->rows()) {
        force = std::max(force, row.wrench.force.norm());
        moment = std::max(moment, row.wrench.moment.norm());
      }
    note("The load's force on the platform is left out", "load.force", force, "N");
    note("The load's moment on the platform is left out", "load.moment", moment, "N m");
  }

  const Manipulator& machine_;
  Motion<double> pose_;
  MachineModel out_;
  std::vector<std::pair<std::size_t, Vector3d>> tips_;  ///< the last body of each leg, and the position of its end
};

/// Returns the joint that carries `body` in the tree; null for the base.
const GraphJoint* carrierOf(const ModelGraph& graph, std::size_t body) {
  const auto found = std::find_if(graph.joints.begin(), graph.joints.end(),
                                  [body](const GraphJoint& joint) { return !joint.closure && joint.child == body; });
  return found == graph.joints.end() ? nullptr : &*found;
}

}  // namespace

MachineModel modelOf(const Scenario& scenario) { return Builder(scenario).take(); }

std::vector<TreeBody> treeBodiesOf(const ModelGraph& graph) {
  std::vector<TreeBody> out;
  for (std::size_t body = 0; body < graph.bodies.size(); ++body) {
    if (graph.bodies[body].fixed || graph.bodies[body].mass == 0) continue;
    TreeBody tree_body{body, body, {}};
    do {
      const GraphJoint* joint = carrierOf(graph, tree_body.parent);
      if (joint == nullptr) break;
      tree_body.joints.insert(tree_body.joints.begin(), joint - graph.joints.data());
      tree_body.parent = joint->parent;
    } while (!graph.bodies[tree_body.parent].fixed && graph.bodies[tree_body.parent].mass == 0);
    out.push_back(tree_body);
  }
  return out;
}

WrittenModel exportScenario(const Scenario& scenario, ModelFormat format) {
  const MachineModel machine = modelOf(scenario);
  WrittenModel out;
  out.notes = machine.graph.assumptions;
  constexpr std::array texts = {sdfText, mjcfText, urdfText};
  out.text = texts.at(static_cast<std::size_t>(format))(machine, out.notes);
  return out;
}

}  // namespace ursula::exchange
