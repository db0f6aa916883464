// The text of a spanning tree for MuJoCo. Numbers of inertia are placeholders there, which get
// overwritten: MuJoCo refuses bodies without mass, and digits would be lost.

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <stdexcept>

#include "parts/engines/mujoco/mujoco_tree_internal.h"

namespace ursula::mujoco {
namespace {

std::string numbers(const Vector3d& v) { return fmt::format("{} {} {}", v.x(), v.y(), v.z()); }

std::string jointText(const MechanismJoint& joint, bool reversed, const Vector3d& center) {
  const std::string at = numbers(joint.centre - center);
  if (joint.kind == JointKind::ball) return fmt::format(R"(<joint type="ball" pos="{}"/>)", at);
  const int count = freedomsOf(joint.kind);
  std::string out;
  for (int k = 0; k < count; ++k) {
    const Vector3d& axis = joint.axis[reversed ? count - 1 - k : k];
    out +=
        fmt::format(R"(<joint type="{}" pos="{}" axis="{}"/>)", joint.slides() ? "slide" : "hinge", at, numbers(axis));
  }
  return out;
}

std::string bodyText(const Mechanism& mechanism, const WeldedMechanism& welded, const WeldTree& tree,
                     const WeldStep& step) {
  const Vector3d center = welded.welds[step.to].center;
  std::string out = fmt::format(R"(<body name="{}" pos="{}"><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>)",
                                step.to, numbers(center - welded.welds[step.from].center));
  out +=
      step.joint == WeldStep::none ? "<freejoint/>" : jointText(mechanism.joints()[step.joint], step.reversed, center);
  for (const WeldStep& next : tree.steps)
    if (next.from == step.to) out += bodyText(mechanism, welded, tree, next);
  return out + "</body>";
}

/// MuJoCo has principal moments and the rotation to their axes.
void writeInertia(const WeldedBodies& weld, int body, mjModel& model) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> principal(weld.inertia);
  Matrix3d axes = principal.eigenvectors();
  if (axes.determinant() < 0) axes.col(0) *= -1;
  const Eigen::Quaterniond turn = Eigen::Quaterniond(axes).normalized();
  model.body_mass[body] = weld.mass;
  Eigen::Map<Eigen::Vector4d>(model.body_iquat + 4 * body) << turn.w(), turn.x(), turn.y(), turn.z();
  Eigen::Map<Vector3d>(model.body_inertia + 3 * body) = principal.eigenvalues();
}

/// A point of each of two welds that coincide, relative to their centres.
struct Pin {
  std::size_t a = 0, b = 0;
  bool holds_turn = false;
  Matrix3d turn = Matrix3d::Identity();  ///< of b relative to a, if that is held too
  Vector3d on_a = Vector3d::Zero(), on_b = Vector3d::Zero();
};

/// A ball is pinned at one point, a hinge at two points of its axis, and a fixed joint is one of MuJoCo's welds.
std::vector<Pin> pinsOf(const Mechanism& mechanism, const WeldedMechanism& welded, const WeldTree& tree) {
  std::vector<Pin> out;
  for (const std::size_t j : tree.cut) {
    const MechanismJoint& joint = mechanism.joints()[j];
    Pin pin{welded.parentOf(joint), welded.childOf(joint)};
    if (joint.kind == JointKind::free || pin.a == pin.b) continue;
    if (joint.kind == JointKind::prismatic || joint.kind == JointKind::universal)
      throw std::domain_error(fmt::format("its equality constraints do not hold the cut joint {}", joint.name));
    pin.on_a = joint.centre - welded.welds[pin.a].center;
    pin.on_b = joint.centre_of_child - welded.welds[pin.b].center;
    pin.holds_turn = joint.kind == JointKind::fixed;
    pin.turn = joint.turn;
    out.push_back(pin);
    if (joint.kind != JointKind::revolute) continue;
    const Vector3d along = mechanism.length() / 4 * joint.axis[0];
    pin.on_a += along;
    pin.on_b += joint.turn.transpose() * along;
    out.push_back(pin);
  }
  return out;
}

std::string nameOf(std::size_t weld) { return weld == 0 ? "world" : std::to_string(weld); }

Model parsedTree(const Mechanism& mechanism, const WeldedMechanism& welded, const WeldTree& tree,
                 const std::vector<Pin>& pins) {
  std::string text = R"(<mujoco><compiler angle="radian"/><size nstack="200000"/><worldbody>)";
  for (const WeldStep& step : tree.steps)
    if (step.from == 0) text += bodyText(mechanism, welded, tree, step);
  text += "</worldbody><equality>";
  for (const Pin& pin : pins)
    text += fmt::format(R"(<{} body1="{}" body2="{}"{}/>)", pin.holds_turn ? "weld" : "connect", nameOf(pin.a),
                        nameOf(pin.b), pin.holds_turn ? "" : R"( anchor="0 0 0")");
  Model model = parseText(text + "</equality></mujoco>");
  // Without shortcuts for frames that coincide and inertias that are diagonal in the text.
  std::fill_n(model->body_sameframe, model->nbody, mjtByte{0});
  std::fill_n(model->body_simple, model->nbody, mjtByte{0});
  std::fill_n(model->dof_simplenum, model->nv, 0);
  Eigen::Map<Vector3d>(model->opt.gravity) = mechanism.gravity();
  for (std::size_t w = 1; w < welded.welds.size(); ++w) writeInertia(welded.welds[w], bodyOf(*model, w), *model);
  std::copy_n(model->body_mass, model->nbody, model->body_subtreemass);
  for (int b = model->nbody - 1; b > 0; --b)
    model->body_subtreemass[model->body_parentid[b]] += model->body_subtreemass[b];
  return model;
}

}  // namespace

int bodyOf(const mjModel& model, std::size_t weld) {
  return mj_name2id(&model, mjOBJ_BODY, std::to_string(weld).c_str());
}

Model treeModel(const Mechanism& mechanism, const WeldedMechanism& welded, const WeldTree& tree) {
  return parsedTree(mechanism, welded, tree, {});
}

namespace {

/// MuJoCo's armature acts on a ball's speeds as our rotors do.
void addRotors(const Mechanism& mechanism, const WeldTree& tree, mjModel& model) {
  for (const std::size_t j : tree.cut)
    if (mechanism.joints()[j].rotor_inertia != 0)
      throw std::domain_error(fmt::format("it moves no rotor of the cut joint {}", mechanism.joints()[j].name));
  for (const WeldStep& step : tree.steps) {
    if (step.joint == WeldStep::none) continue;
    const int body = bodyOf(model, step.to);
    std::fill_n(model.dof_armature + model.body_dofadr[body], model.body_dofnum[body],
                mechanism.joints()[step.joint].rotor_inertia);
  }
}

}  // namespace

Model connectedModel(const Mechanism& mechanism, const WeldedMechanism& welded, const WeldTree& tree, bool hard,
                     bool with_rotors) {
  const std::vector<Pin> pins = pinsOf(mechanism, welded, tree);
  Model model = parsedTree(mechanism, welded, tree, pins);
  if (with_rotors) addRotors(mechanism, tree, *model);
  mj_setConst(model.get(), dataOf(*model).get());  // softness counts by the inertias at the reference pose
  for (std::size_t k = 0; k < pins.size(); ++k) {  // it moves the points, and the text rounds them
    mjtNum* points = model->eq_data + mjNEQDATA * k;
    const bool weld = pins[k].holds_turn;  // of which the second body's point comes first
    Eigen::Map<Vector3d>{points + (weld ? 3 : 0)} = pins[k].on_a;
    Eigen::Map<Vector3d>{points + (weld ? 0 : 3)} = pins[k].on_b;
    const Eigen::Quaterniond turn(pins[k].turn);
    if (weld) Eigen::Map<Eigen::Vector4d>{points + 6} << turn.w(), turn.vec();
    if (!hard) continue;
    model->eq_solref[mjNREF * k] = 2 * model->opt.timestep;  // MuJoCo raises shorter time constants to two steps
    std::fill_n(model->eq_solimp + mjNIMP * k, 2, mjMAXIMP);
  }
  return model;
}

}  // namespace ursula::mujoco
