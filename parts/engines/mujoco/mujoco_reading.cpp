// A model file as MuJoCo's own reader and compiler have it, beside the parameters that this program read.

#include "parts/engines/mujoco/mujoco_reading.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <vector>

#include "parts/engines/joint_rows.h"
#include "parts/engines/mujoco/mujoco_text_internal.h"

namespace ursula {
namespace {

using RowMajor3d = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
constexpr double exact = 1e-12, by_eigenvalues = 1e-5;

class ComparedReading {
 public:
  ComparedReading(const std::filesystem::path& file, const MechanismParameters& ours, const ReadingChoices& choices)
      : ours_(ours),
        choices_(choices),
        mechanism_(ours),
        model_(mujoco::parseFile(file)),
        data_(mujoco::dataOf(*model_)),
        welded_(Mechanism(withoutWelds())) {
    mj_kinematics(model_.get(), data_.get());
  }

  ReadingDifference compare() {
    for (std::size_t b = 0; b < ours_.bodies.size(); ++b) compareBody(b);
    for (std::size_t w = 1; w < welded_.welds.size(); ++w) compareWeld(w);
    for (const MechanismJoint& joint : ours_.joints) compareJoint(joint);
    compareClosures();
    const bool is_off = (model_->opt.disableflags & mjDSBL_GRAVITY) != 0;
    const Vector3d gravity = is_off ? Vector3d::Zero() : vector(model_->opt.gravity, 0);
    if (choices_.has_file_gravity) difference(gravity, ours_.gravity, ours_.gravity.norm(), "gravity");
    return out_;
  }

 private:
  static Vector3d vector(const mjtNum* from, int index) { return Eigen::Map<const Vector3d>(from + 3 * index); }
  int named(mjtObj type, const std::string& name) const { return mj_name2id(model_.get(), type, name.c_str()); }
  Eigen::Isometry3d frameOf(int body) const {
    Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
    out.linear() = Eigen::Map<const RowMajor3d>(data_->xmat + 9 * body);
    out.translation() = vector(data_->xpos, body);
    return out;
  }

  template <class A, class B>
  void difference(const A& theirs, const B& own, double size, const std::string& where, double limit = exact) {
    double value = (theirs - own).cwiseAbs().maxCoeff() / (size > 0 ? size : 1);
    if (std::isnan(value)) value = HUGE_VAL;
    if (!(value / limit > out_.value / out_.limit)) return;
    out_.value = value;
    out_.limit = limit;
    out_.where = where;
  }
  void numbers(double theirs, double own, const std::string& where) {
    if (choices_.leaves_out && own == 0) return;
    difference(Eigen::Matrix<double, 1, 1>(theirs), Eigen::Matrix<double, 1, 1>(own), std::abs(own), where);
  }

  MechanismParameters withoutWelds() const {
    MechanismParameters out = ours_;
    out.joints.erase(std::remove_if(out.joints.begin(), out.joints.end(),
                                    [this](const MechanismJoint& joint) {
                                      return joint.kind == JointKind::fixed &&
                                             (joint.closure || (model_->neq > 0 && isNamed(joint)));
                                    }),
                     out.joints.end());
    return out;
  }

  void compareBody(std::size_t b) {
    const MechanismBody& own = ours_.bodies[b];
    const int body = named(mjOBJ_BODY, own.name);
    if (body <= 0) return;
    ++out_.bodies;
    if (!choices_.of_file_pose) return;
    const Eigen::Isometry3d theirs = frameOf(body);
    difference(theirs.linear(), own.frame.linear(), 1, "orientation of " + own.name);
    difference(theirs.translation(), own.frame.translation(), mechanism_.length(), "place of " + own.name);
  }

  /// Bodies that are fixed to each other are one, because MuJoCo fuses those of a URDF. All is in the frame of one of
  /// them, so that it does not depend on the pose.
  void compareWeld(std::size_t w) {
    for (std::size_t b = 0; b < ours_.bodies.size(); ++b) {
      const int body = welded_.of_body[b] == w ? named(mjOBJ_BODY, ours_.bodies[b].name) : -1;
      if (body <= 0) continue;
      const WeldedBodies &own = welded_.welds[w], theirs = weldOf(model_->body_weldid[body]);
      const Eigen::Isometry3d to_own = ours_.bodies[b].frame.inverse(), to_theirs = frameOf(body).inverse();
      const std::string name = ours_.bodies[b].name;
      numbers(theirs.mass, own.mass, "mass of " + name);
      if (own.mass == 0) return;
      difference(to_theirs * theirs.center, to_own * own.center, mechanism_.length(), "mass centre of " + name);
      const auto turned = [](const Eigen::Isometry3d& to, const Matrix3d& I) -> Matrix3d {
        return to.linear() * I * to.linear().transpose();
      };
      difference(turned(to_theirs, theirs.inertia), turned(to_own, own.inertia), own.inertia.cwiseAbs().maxCoeff(),
                 "inertia of " + name, choices_.by_eigenvalues ? by_eigenvalues : exact);
      return;
    }
  }

  WeldedBodies weldOf(int weld) const {
    WeldedBodies out;
    for (int b = 1; b < model_->nbody; ++b)
      if (model_->body_weldid[b] == weld) {
        out.mass += model_->body_mass[b];
        out.center += model_->body_mass[b] * vector(data_->xipos, b);
      }
    if (out.mass > 0) out.center /= out.mass;
    for (int b = 1; b < model_->nbody; ++b) {
      if (model_->body_weldid[b] != weld) continue;
      const Matrix3d axes = Eigen::Map<const RowMajor3d>(data_->ximat + 9 * b);
      const Vector3d arm = vector(data_->xipos, b) - out.center;
      out.inertia += axes * vector(model_->body_inertia, b).asDiagonal() * axes.transpose() +
                     model_->body_mass[b] * (arm.squaredNorm() * Matrix3d::Identity() - arm * arm.transpose());
    }
    return out;
  }

  void compareJoint(const MechanismJoint& own) {
    static const std::map<JointKind, int> types = {{JointKind::revolute, mjJNT_HINGE},
                                                   {JointKind::prismatic, mjJNT_SLIDE},
                                                   {JointKind::ball, mjJNT_BALL},
                                                   {JointKind::free, mjJNT_FREE}};
    const int joint = named(mjOBJ_JOINT, own.name);
    if (joint < 0) return;
    ++out_.joints;
    const int type = model_->jnt_type[joint], dof = model_->jnt_dofadr[joint], at = model_->jnt_qposadr[joint];
    const auto expected = types.find(own.kind);
    const auto& retyped = choices_.retyped;
    const bool is_retyped = std::find(retyped.begin(), retyped.end(), own.name) != retyped.end();
    if (is_retyped)
      out_.left_out.push_back("type of " + own.name);
    else
      numbers(type, expected == types.end() ? -1 : expected->second, "type of " + own.name);
    if (type == mjJNT_FREE) return;
    const Eigen::Isometry3d to_body = ours_.bodies[own.child].frame.inverse();
    difference(vector(model_->jnt_pos, joint), to_body * own.centre_of_child, mechanism_.length(),
               "anchor of " + own.name);
    if (is_retyped) return;
    numbers(model_->dof_damping[dof], own.damping, "damping of " + own.name);
    if (choices_.is_urdf && own.rotor_inertia != 0)
      out_.left_out.push_back("armature of " + own.name);
    else
      numbers(model_->dof_armature[dof], own.rotor_inertia, "armature of " + own.name);
    numbers(model_->dof_frictionloss[dof], own.friction, "frictionloss of " + own.name);
    numbers(model_->jnt_stiffness[joint], own.stiffness, "stiffness of " + own.name);
    if (type == mjJNT_BALL) return;
    const Vector3d axis = to_body.linear() * (own.turn.transpose() * own.axis[0]);
    difference(vector(model_->jnt_axis, joint), axis, 1, "axis of " + own.name);
    if (own.stiffness != 0) numbers(model_->qpos_spring[at], own.spring_reference, "springref of " + own.name);
    if (choices_.of_file_pose) numbers(model_->qpos0[at], own.position, "ref of " + own.name);
  }

  /// Closures have names, or stand in the file's order if both have as many.
  void compareClosures() {
    std::vector<int> theirs;
    for (int e = 0; e < model_->neq; ++e)
      if (model_->eq_active[e] != 0 && model_->eq_type[e] <= mjEQ_WELD) theirs.push_back(e);
    std::vector<const MechanismJoint*> own;
    for (const MechanismJoint& joint : ours_.joints)
      if (joint.kind != JointKind::free && named(mjOBJ_JOINT, joint.name) < 0 && isNamed(joint)) own.push_back(&joint);
    for (std::size_t k = 0; k < own.size(); ++k) {
      const int by_name = named(mjOBJ_EQUALITY, own[k]->name);
      if (by_name >= 0)
        compareClosure(*own[k], by_name);
      else if (own.size() == theirs.size())
        compareClosure(*own[k], theirs[k]);
    }
  }

  /// Bodies without joint hang on a joint that has no name in MuJoCo.
  bool isNamed(const MechanismJoint& joint) const { return joint.name != ours_.bodies[joint.child].name + " (fixed)"; }

  void compareClosure(const MechanismJoint& own, int e) {
    ++out_.closures;
    const int a = named(mjOBJ_BODY, ours_.bodies[own.parent].name), b = named(mjOBJ_BODY, ours_.bodies[own.child].name);
    numbers(model_->eq_obj1id[e], a, "first body of " + own.name);
    numbers(model_->eq_obj2id[e], b, "second body of " + own.name);
    if (model_->eq_type[e] != mjEQ_CONNECT) return;
    const mjtNum* anchors = model_->eq_data + mjNEQDATA * e;
    const auto& bodies = ours_.bodies;
    difference(vector(anchors, 0), bodies[own.parent].frame.inverse() * own.centre, mechanism_.length(),
               "anchor of " + own.name);
    difference(vector(anchors, 1), bodies[own.child].frame.inverse() * own.centre_of_child, mechanism_.length(),
               "second anchor of " + own.name);
  }

  const MechanismParameters& ours_;
  const ReadingChoices& choices_;
  Mechanism mechanism_;
  mujoco::Model model_;
  mujoco::Data data_;
  WeldedMechanism welded_;  ///< without closures, which weld nothing in MuJoCo's tree
  ReadingDifference out_;
};

}  // namespace

ReadingDifference readByMujoco(const std::filesystem::path& file, const MechanismParameters& ours,
                               const ReadingChoices& choices) {
  try {
    return ComparedReading(file, ours, choices).compare();
  } catch (const std::runtime_error& refusal) {
    ReadingDifference out;
    out.refusal = refusal.what();
    std::replace(out.refusal.begin(), out.refusal.end(), '\n', ' ');
    return out;
  }
}

}  // namespace ursula
