#include <algorithm>
#include <utility>

#include "parts/engines/closed_mechanism.h"
#include "parts/engines/mujoco/mujoco_tree_internal.h"

namespace ursula {
namespace mujoco {

TreeSpeeds::TreeSpeeds(const Mechanism& mechanism, const WeldedMechanism& welded, WeldTree tree)
    : mechanism_(mechanism),
      welded_(welded),
      tree_(std::move(tree)),
      model_(treeModel(mechanism, welded, tree_)),
      data_(dataOf(*model_)),
      of_tree_(mechanism.joints().size()),
      bodies_(welded.welds.size()),
      states_(welded.welds.size()),
      jacobians_(states_.size()),
      biases_(states_.size(), Vector6d::Zero()) {
  for (const WeldStep& step : tree_.steps) {
    const int body = bodies_[step.to] = bodyOf(*model_, step.to);
    if (step.joint != WeldStep::none)
      of_tree_[step.joint] = {model_->body_jntadr[body], model_->body_jntnum[body], step.reversed};
  }
  readPose();
}

bool TreeSpeeds::isLinear(Eigen::Index i) const {
  const int joint = model_->dof_jntid[i], own = static_cast<int>(i) - model_->jnt_dofadr[joint];
  return model_->jnt_type[joint] == mjJNT_SLIDE || (model_->jnt_type[joint] == mjJNT_FREE && own < 3);
}

void TreeSpeeds::step(const Eigen::VectorXd& by) {
  mj_integratePos(model_.get(), data_->qpos, by.data(), 1);
  readPose();
}

void TreeSpeeds::goBack() {
  std::copy(kept_.begin(), kept_.end(), data_->qpos);
  readPose();
}

void TreeSpeeds::addRow(std::size_t weld, const Vector6d& factors, Eigen::VectorXd& row) const {
  if (weld != 0) row += jacobians_[weld].transpose() * factors;
}

std::optional<SpeedsOfWelds::Own> TreeSpeeds::own(std::size_t joint, int index) const {
  const OfTree& at = of_tree_[joint];
  if (at.joint < 0 || model_->jnt_type[at.joint] == mjJNT_BALL) return std::nullopt;
  const int in_model = at.joint + (at.reversed ? at.count - 1 - index : index);
  const double sign = at.reversed ? -1 : 1;
  return Own{model_->jnt_dofadr[in_model], sign, sign * data_->qpos[model_->jnt_qposadr[in_model]]};
}

// [recipe]
void TreeSpeeds::readPose() {
  using RowMajor = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor>;
  mj_kinematics(model_.get(), data_.get());
  mj_comPos(model_.get(), data_.get());
  RowMajor linear(3, count()), angular(3, count());
  for (std::size_t w = 1; w < states_.size(); ++w) {
    const int body = bodies_[w];
    states_[w].R = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(data_->xmat + 9 * body);
    states_[w].c = Eigen::Map<const Vector3d>(data_->xpos + 3 * body);
    mj_jac(model_.get(), data_.get(), linear.data(), angular.data(), data_->xpos + 3 * body, body);
    jacobians_[w].resize(6, count());
    jacobians_[w] << angular, linear;
  }
}

void TreeSpeeds::setSpeeds(const Eigen::VectorXd& u) {
  std::copy_n(u.data(), u.size(), data_->qvel);
  std::fill_n(data_->qacc, u.size(), 0.0);
  mj_comVel(model_.get(), data_.get());
  mj_rnePostConstraint(model_.get(), data_.get());
  for (std::size_t w = 1; w < states_.size(); ++w) {
    const Vector6d twist = jacobians_[w] * u;
    states_[w].w = twist.head<3>();
    states_[w].v = twist.tail<3>();
    const int body = bodies_[w];
    mj_objectAcceleration(model_.get(), data_.get(), mjOBJ_XBODY, body, biases_[w].data(), 0);
    biases_[w].tail<3>() += mechanism_.gravity();  // MuJoCo's world accelerates upwards
  }
}

Eigen::VectorXd TreeSpeeds::forces(const Eigen::VectorXd& accelerations) {
  std::copy_n(accelerations.data(), accelerations.size(), data_->qacc);
  Eigen::VectorXd out(count());
  mj_rne(model_.get(), data_.get(), 1, out.data());
  return out;
}
// [/recipe]

// [own]
Eigen::VectorXd TreeSpeeds::ownInverse(const Eigen::VectorXd& accelerations, bool hard) {
  Connected& own = connected_[hard ? 1 : 0];
  if (!own.model) own.model = connectedModel(mechanism_, welded_, tree_, hard);
  if (!own.data) own.data = dataOf(*own.model);
  std::copy_n(data_->qpos, model_->nq, own.data->qpos);
  std::copy_n(data_->qvel, model_->nv, own.data->qvel);
  std::copy_n(accelerations.data(), accelerations.size(), own.data->qacc);
  mj_inverse(own.model.get(), own.data.get());
  return Eigen::Map<const Eigen::VectorXd>(own.data->qfrc_inverse, count());
}
// [/own]

std::vector<Rigidity> TreeSpeeds::rigidities() const {
  constexpr double step = 0.002;  // s, MuJoCo's default
  std::array<mjtNum, mjNREF> solref{};
  std::array<mjtNum, mjNIMP> solimp{};
  mj_defaultSolRefImp(solref.data(), solimp.data());
  const auto of = [](const char* name, double time_constant, double impedance) {
    return Rigidity{name, step, 0, {{"solref_timeconst", time_constant}, {"solimp_dmax", impedance}}};
  };
  return {of("default", solref[0], solimp[1]), of("hardest", 2 * step, mjMAXIMP)};
}

void TreeSpeeds::startTime(const Rigidity& rigidity) {
  moved_.model = connectedModel(mechanism_, welded_, tree_, rigidity.settings.at(1).second == mjMAXIMP, true);
  moved_.data = dataOf(*moved_.model);
  std::copy_n(data_->qpos, model_->nq, moved_.data->qpos);
  std::copy_n(data_->qvel, model_->nv, moved_.data->qvel);
}

Eigen::VectorXd TreeSpeeds::stepTime(const Eigen::VectorXd& forces) {
  std::copy_n(forces.data(), forces.size(), moved_.data->qfrc_applied);
  mj_step(moved_.model.get(), moved_.data.get());
  std::copy_n(moved_.data->qpos, model_->nq, data_->qpos);
  const Eigen::VectorXd u = Eigen::Map<const Eigen::VectorXd>(moved_.data->qvel, count());
  readPose();
  setSpeeds(u);
  return u;
}

}  // namespace mujoco

BuiltTree buildMujoco(const Mechanism& mechanism, const WeldedMechanism& welded) {
  WeldTree tree = weldTree(mechanism, welded);
  const std::vector<std::size_t> cut = tree.cut;
  return {std::make_unique<mujoco::TreeSpeeds>(mechanism, welded, std::move(tree)), cut};
}

}  // namespace ursula
