// Builds the machine in MuJoCo. A text describes its structure. All numbers are then overwritten in binary, because
// decimal digits and MuJoCo's compiler would round them. The links' body frames are those of LegChain, except for the
// origin of a rod in a cylinder.

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "parts/engines/mujoco/mujoco_loop_internal.h"

namespace ursula::mujoco {
namespace {

[[noreturn]] void throwMessage(const char* message) { throw std::runtime_error(fmt::format("MuJoCo: {}", message)); }

/// Everything that the text depends on.
struct Structure {
  std::vector<LegKind> kinds;
  Closure closure;

  bool operator<(const Structure& other) const {
    return std::tie(closure, kinds) < std::tie(other.closure, other.kinds);
  }
};

/// A link's joints, in the axes of its body.
std::string jointsOf(const LegChain& chain, int link) {
  std::string out;
  for (int j = chain.firstOf(link); j < chain.firstOf(link) + chain.jointsOf(link); ++j) {
    const Vector3d& axis = chain.joint(j).axis;
    out += fmt::format(R"(<joint type="{}" axis="{} {} {}"/>)", chain.slides(j) ? "slide" : "hinge", axis.x(), axis.y(),
                       axis.z());
  }
  return out;
}

/// The inertial numbers are placeholders that get overwritten.
std::string describe(const Structure& structure) {
  const std::vector<LegKind>& kinds = structure.kinds;
  const std::string inertial = R"(<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>)";
  std::string text = R"(<mujoco><size nstack="200000"/><worldbody>)";  // its own guess is 11 MB for each machine
  for (std::size_t leg = 0; leg < kinds.size(); ++leg) {
    Leg of_kind;
    of_kind.kind = kinds[leg];
    const LegChain chain = chainOf(of_kind);
    text += fmt::format(R"(<body name="proximal{0}">{1}{2}<body name="distal{0}">{1}{3})"
                        R"(<site name="leg{0}"/></body></body>)",
                        leg, inertial, jointsOf(chain, 0), jointsOf(chain, 1));
  }
  text += fmt::format(R"(<body name="platform"><freejoint/>{})", inertial);
  for (std::size_t leg = 0; leg < kinds.size(); ++leg) text += fmt::format(R"(<site name="platform{}"/>)", leg);
  text += "</body></worldbody>";
  if (structure.closure == Closure::connected) {
    text += "<equality>";
    for (std::size_t leg = 0; leg < kinds.size(); ++leg)
      text += fmt::format(R"(<connect body1="distal{}" body2="platform" anchor="0 0 0"/>)", leg);
    text += "</equality>";
  }
  return text + "</mujoco>";
}

bool hasJoints(const mjModel& model, int leg, LegKind kind) {
  const LegKindRow& row = rowOf(kind);
  bool good = model.body_dofadr[proximalBody(leg)] == dofOf(leg, 0) &&
              model.body_dofadr[distalBody(leg)] == dofOf(leg, row.joints_of_proximal);
  for (int joint = 0; joint < joints_per_leg; ++joint)
    good = good && model.jnt_type[dofOf(leg, joint)] == (slides(row.coordinates[joint]) ? mjJNT_SLIDE : mjJNT_HINGE);
  return good;
}

/// Whether the indices are as the header says.
bool isAsExpected(const mjModel& model, const Structure& structure) {
  const std::vector<LegKind>& kinds = structure.kinds;
  const int legs = static_cast<int>(kinds.size());
  bool good = model.nv == dofsOf(legs) && model.nq == dofsOf(legs) + 1 && model.nbody == platformBody(legs) + 1 &&
              model.nsite == 2 * legs && model.njnt == legDofs(legs) + 1 &&
              model.neq == (structure.closure == Closure::connected ? legs : 0) &&
              mj_name2id(&model, mjOBJ_BODY, "platform") == platformBody(legs);
  for (int leg = 0; good && leg < legs; ++leg) {
    const auto is = [&](int type, const char* name, int id) {
      return mj_name2id(&model, type, fmt::format("{}{}", name, leg).c_str()) == id;
    };
    good = is(mjOBJ_BODY, "proximal", proximalBody(leg)) && is(mjOBJ_BODY, "distal", distalBody(leg)) &&
           is(mjOBJ_SITE, "leg", siteOnLeg(leg)) && is(mjOBJ_SITE, "platform", siteOnPlatform(legs, leg)) &&
           hasJoints(model, leg, kinds[leg]);
  }
  return good;
}

Model parse(const Structure& structure) {
  Model model = parseText(describe(structure));
  if (!isAsExpected(*model, structure))
    throwMessage("bodies, joints and sites stand in another order than was asked for");
  return model;
}

/// Each structure is parsed once.
const mjModel* parsed(const Structure& structure) {
  static std::mutex mutex;
  static std::map<Structure, Model> models;
  const std::lock_guard<std::mutex> lock(mutex);
  const auto found = models.find(structure);
  return found != models.end() ? found->second.get() : models.emplace(structure, parse(structure)).first->second.get();
}

void write(const Vector3d& from, mjtNum* to, int index) { Eigen::Map<Vector3d>(to + 3 * index) = from; }

void write(const Eigen::Quaterniond& from, mjtNum* to, int index) {
  Eigen::Map<Eigen::Vector4d>(to + 4 * index) << from.w(), from.x(), from.y(), from.z();
}

/// MuJoCo stores principal moments and the rotation to their axes.
void writeInertia(mjModel& model, int body, double mass, const Vector3d& center, const Matrix3d& inertia) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> principal(inertia);
  Matrix3d axes = principal.eigenvectors();
  if (axes.determinant() < 0) axes.col(0) *= -1;
  model.body_mass[body] = mass;
  write(center, model.body_ipos, body);
  write(Eigen::Quaterniond(axes).normalized(), model.body_iquat, body);
  write(principal.eigenvalues(), model.body_inertia, body);
}

/// A body that slides has its origin where it is at zero: for a rod in a cylinder that is its tip.
void writeLeg(mjModel& model, int index, const Leg& leg, const Vector3d& origin) {
  const LegChain chain = chainOf(leg, frameOf(leg));
  const int proximal = proximalBody(index), distal = distalBody(index), second = chain.firstOf(1);
  const LegJoint& joint_of_distal = chain.joint(second);
  const Vector3d shift = chain.slides(second) ? joint_of_distal.at : Vector3d(Vector3d::Zero());
  write(leg.base_point - origin, model.body_pos, proximal);
  write(Eigen::Quaterniond(chain.place(0).linear()).normalized(), model.body_quat, proximal);
  write(Vector3d(joint_of_distal.at - shift), model.body_pos, distal);
  write(joint_of_distal.turn.normalized(), model.body_quat, distal);
  write(Vector3d(chain.tip + shift), model.site_pos, siteOnLeg(index));
  writeInertia(model, proximal, leg.proximal.mass, chain.centers[0], leg.proximal.inertia);
  writeInertia(model, distal, leg.distal.mass, chain.centers[1] + shift, leg.distal.inertia);
  for (int joint = 0; joint < joints_per_leg; ++joint)
    model.dof_armature[dofOf(index, joint)] = leg.rotor_inertia.on(rowOf(leg.kind).coordinates[joint]);
  model.body_subtreemass[distal] = leg.distal.mass;
  model.body_subtreemass[proximal] = leg.proximal.mass + leg.distal.mass;
}

/// Makes `pose` (qpos) the one that the frames, the axes and MuJoCo's derived constants belong to, as its compiler does
/// with a file's. The same qpos mean the same poses as before. At zero a leg may lie along an axis and have no inertia
/// about it. mj_setConst throws then.
void setReference(mjModel& model, const mjtNum* pose) {
  const Data data = dataOf(model);
  std::copy_n(pose, model.nq, data->qpos);
  mj_kinematics(&model, data.get());
  for (int body = 1; body < model.nbody; ++body) {
    const int parent = model.body_parentid[body];
    std::array<mjtNum, 3> at{};
    std::array<mjtNum, 4> turn{};
    mju_negPose(at.data(), turn.data(), data->xpos + 3 * parent, data->xquat + 4 * parent);
    mju_mulPose(model.body_pos + 3 * body, model.body_quat + 4 * body, at.data(), turn.data(), data->xpos + 3 * body,
                data->xquat + 4 * body);
  }
  for (int joint = 0; joint < model.njnt; ++joint)
    mju_rotVecMatT(model.jnt_axis + 3 * joint, data->xaxis + 3 * joint, data->xmat + 9 * model.jnt_bodyid[joint]);
  std::copy_n(pose, model.nq, model.qpos0);
  mj_setConst(&model, data.get());
}

/// Makes the constraints as hard as MuJoCo allows. It restores their points from the sites, because mj_setConst moves
/// them.
void harden(mjModel& model, int legs) {
  for (int leg = 0; leg < legs; ++leg) {
    std::copy_n(model.site_pos + 3 * siteOnLeg(leg), 3, model.eq_data + mjNEQDATA * leg);
    std::copy_n(model.site_pos + 3 * siteOnPlatform(legs, leg), 3, model.eq_data + mjNEQDATA * leg + 3);
    std::fill_n(model.eq_solimp + mjNIMP * leg, 2, mjMAXIMP);
  }
}

}  // namespace

Matrix3d frameOf(const Leg& leg) {
  if (rowOf(leg.kind).joints_of_proximal != 2) return fixedFrame(leg.base_axis);
  const Vector3d u = leg.base_axis.normalized(), x = u.unitOrthogonal();
  Matrix3d frame;
  frame << x, u, x.cross(u);
  return frame;
}

Model buildModel(const Manipulator& manipulator, const Vector3d& origin, Closure closure) {
  const int legs = manipulator.legCount();
  Structure structure{{}, closure};
  for (const Leg& leg : manipulator.parameters().legs) structure.kinds.push_back(leg.kind);
  Model model(mj_copyModel(nullptr, parsed(structure)));
  if (!model) throwMessage("no memory for its model");
  // Disables shortcuts for frames that coincide and inertias that are diagonal in the text.
  std::fill_n(model->body_sameframe, model->nbody, mjtByte{0});
  std::fill_n(model->site_sameframe, model->nsite, mjtByte{0});
  std::fill_n(model->body_simple, model->nbody, mjtByte{0});
  std::fill_n(model->dof_simplenum, model->nv, 0);
  write(manipulator.gravity(), model->opt.gravity, 0);
  const Platform& platform = manipulator.platform();
  writeInertia(*model, platformBody(legs), platform.mass, Vector3d::Zero(), platform.inertia);
  model->body_subtreemass[platformBody(legs)] = platform.mass;
  for (int leg = 0; leg < legs; ++leg) {
    writeLeg(*model, leg, manipulator.leg(leg), origin);
    write(manipulator.leg(leg).platform_point - platform.center_of_mass, model->site_pos, siteOnPlatform(legs, leg));
  }
  return model;
}

Connected connected(const Manipulator& manipulator, const Vector3d& origin, const mjtNum* pose) {
  Connected out;
  out.model = buildModel(manipulator, origin, Closure::connected);
  setReference(*out.model, pose);
  harden(*out.model, manipulator.legCount());
  out.data = dataOf(*out.model);
  return out;
}

}  // namespace ursula::mujoco
