// How the machine is put into MuJoCo. A text says what joins what; every number is then written over in binary, as
// decimal digits and MuJoCo's compiler would round it. The links' body frames are G = [x, e × x, e] and
// H = [x, s × x, s] of the paper's (40) with origins at A and R.

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

#include "model/loops/mujoco/mujoco_loop_internal.h"

namespace ursula::mujoco {
namespace {

[[noreturn]] void throwMessage(const char* message) { throw std::runtime_error(fmt::format("MuJoCo: {}", message)); }

/// θ = 0 folds the leg, s = −e: half a turn about x. The other numbers of bodies are written over.
std::string describe() {
  const std::string inertial = R"(<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>)";
  std::string text = R"(<mujoco><worldbody>)";
  for (int leg = 0; leg < leg_count; ++leg)
    text += fmt::format(R"(<body name="proximal{0}">{1}<joint axis="0 0 -1"/><joint axis="1 0 0"/>)"
                        R"(<body name="distal{0}" quat="0 1 0 0">{1}<joint axis="1 0 0"/><site name="leg{0}"/>)"
                        R"(</body></body>)",
                        leg, inertial);
  text += fmt::format(R"(<body name="platform"><freejoint/>{})", inertial);
  for (int leg = 0; leg < leg_count; ++leg) text += fmt::format(R"(<site name="platform{}"/>)", leg);
  return text + "</body></worldbody></mujoco>";
}

/// Whether things stand where the header says.
bool isAsExpected(const mjModel& model) {
  bool good = model.nv == dofs && model.nq == dofs + 1 && model.nbody == platform_body + 1 &&
              model.nsite == 2 * leg_count && model.njnt == leg_dofs + 1 &&
              mj_name2id(&model, mjOBJ_BODY, "platform") == platform_body;
  for (int leg = 0; good && leg < leg_count; ++leg) {
    const auto is = [&](int type, const char* name, int id) {
      return mj_name2id(&model, type, fmt::format("{}{}", name, leg).c_str()) == id;
    };
    good = is(mjOBJ_BODY, "proximal", proximalBody(leg)) && is(mjOBJ_BODY, "distal", distalBody(leg)) &&
           is(mjOBJ_SITE, "leg", siteOnLeg(leg)) && is(mjOBJ_SITE, "platform", siteOnPlatform(leg)) &&
           model.body_dofadr[proximalBody(leg)] == joints_per_leg * leg &&
           model.body_dofadr[distalBody(leg)] == joints_per_leg * leg + 2;
  }
  return good;
}

/// MuJoCo reads files, or here what looks like one in memory.
Model parse() {
  mju_user_error = mju_user_warning = throwMessage;  // by default it exits, prints and writes a log
  const std::string text = describe();
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  const char* name = "machine.xml";
  if (mj_makeEmptyFileVFS(files.get(), name, static_cast<int>(text.size())) != 0) throwMessage("no room for the text");
  std::memcpy(files->filedata[mj_findFileVFS(files.get(), name)], text.data(), text.size());
  std::array<char, 1000> error{};
  Model model(mj_loadXML(name, files.get(), error.data(), static_cast<int>(error.size())));
  mj_deleteVFS(files.get());
  if (!model) throwMessage(error.data());
  if (!isAsExpected(*model)) throwMessage("bodies, joints and sites stand in another order than was asked for");
  return model;
}

void write(const Vector3d& from, mjtNum* to, int index) { Eigen::Map<Vector3d>(to + 3 * index) = from; }

void write(const Eigen::Quaterniond& from, mjtNum* to, int index) {
  Eigen::Map<Eigen::Vector4d>(to + 4 * index) << from.w(), from.x(), from.y(), from.z();
}

/// MuJoCo keeps principal moments and the rotation to their axes.
void writeInertia(mjModel& model, int body, double mass, const Vector3d& center, const Matrix3d& inertia) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> principal(inertia);
  Matrix3d axes = principal.eigenvectors();
  if (axes.determinant() < 0) axes.col(0) *= -1;
  model.body_mass[body] = mass;
  write(center, model.body_ipos, body);
  write(Eigen::Quaterniond(axes).normalized(), model.body_iquat, body);
  write(principal.eigenvalues(), model.body_inertia, body);
}

void writeLeg(mjModel& model, int index, const Leg& leg, const Vector3d& origin) {
  const int proximal = proximalBody(index), distal = distalBody(index);
  write(leg.base_point - origin, model.body_pos, proximal);
  write(Eigen::Quaterniond(universalFrame(leg)).normalized(), model.body_quat, proximal);
  write(Vector3d(0, 0, leg.proximal.length), model.body_pos, distal);
  write(Vector3d(0, 0, leg.distal.length), model.site_pos, siteOnLeg(index));
  for (const auto& [body, link] : {std::pair{proximal, &leg.proximal}, std::pair{distal, &leg.distal}})
    writeInertia(model, body, link->mass, Vector3d(0, 0, link->center_of_mass), link->inertia);
  model.body_subtreemass[distal] = leg.distal.mass;
  model.body_subtreemass[proximal] = leg.proximal.mass + leg.distal.mass;
}

}  // namespace

Matrix3d universalFrame(const Leg& leg) {
  const Vector3d u = leg.base_axis.normalized(), x = u.unitOrthogonal();
  Matrix3d frame;
  frame << x, u.cross(x), u;
  return frame;
}

Model buildModel(const Manipulator& manipulator, const Vector3d& origin) {
  static const Model parsed = parse();  // MuJoCo's parser keeps global state: one thread, once
  Model model(mj_copyModel(nullptr, parsed.get()));
  // Shortcuts for frames that coincided in the text.
  std::fill_n(model->body_sameframe, model->nbody, mjtByte{0});
  std::fill_n(model->site_sameframe, model->nsite, mjtByte{0});
  write(manipulator.gravity(), model->opt.gravity, 0);
  const Platform& platform = manipulator.platform();
  writeInertia(*model, platform_body, platform.mass, Vector3d::Zero(), platform.inertia);
  model->body_subtreemass[platform_body] = platform.mass;
  for (int leg = 0; leg < leg_count; ++leg) {
    writeLeg(*model, leg, manipulator.leg(leg), origin);
    write(manipulator.leg(leg).platform_point - platform.center_of_mass, model->site_pos, siteOnPlatform(leg));
  }
  return model;
}

}  // namespace ursula::mujoco
