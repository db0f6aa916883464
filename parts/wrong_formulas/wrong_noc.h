#pragma once

#include <memory>

#include "parts/wrong_formulas/formula_errors.h"
#include "validation/subject/subject.h"

namespace ursula {

/// The NOC with wrong formulas, for negative controls and as examples of what a solver may have forgotten. Without an
/// error its numbers are those of Noc, to the last bit. Each override takes the right value and puts the error in.
template <class S>
class WrongNoc : public Noc<S> {
 public:
  explicit WrongNoc(const Manipulator& manipulator, WithFormulaErrors errors = {})
      : WrongNoc(MachineParameters<S>(manipulator), std::move(errors)) {}
  explicit WrongNoc(const MachineParameters<S>& machine, WithFormulaErrors errors = {});

  JointVariables<S> angles(const NocWorkspace<S>& work) const override;
  Matrix6<S> platformShapingRate(const Motion<S>& motion, const NocWorkspace<S>& work) const override;
  void bodyMotions(const Motion<S>& motion, const NocWorkspace<S>& work, BodyMotions<S>& bodies) const override;
  Vector6<S> inverseDynamics(const Motion<S>& motion, NocWorkspace<S>& work,
                             const Vector6<S>& load = Vector6<S>::Zero()) const override;
  Matrix6<S> C(const NocWorkspace<S>& work) const override;
  Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> D(const Motion<S>& motion,
                                                     const NocWorkspace<S>& work) const override;

 protected:
  using Base = Noc<S>;
  using typename Base::Rates;

  void displacement(int leg, const S& t, LegState<S>& out) const override;
  void rows(int leg, LegState<S>& out) const override;
  void rowRates(int leg, LegState<S>& out) const override;
  Vector3<S> jointRates(int leg, const LegState<S>& at, const Vector3<S>& v_B) const override;
  Vector3<S> jointAccelerations(int leg, const LegState<S>& at, const Vector3<S>& rate, const Vector3<S>& v_B,
                                const Vector3<S>& a_B) const override;
  LinkMotions<S> onLines(int leg, const LegState<S>& at, const Vector3<S>& rate, const Vector3<S>& acceleration,
                         bool with_rates) const override;
  void addOffLine(int leg, const LegState<S>& at, LinkMotions<S>& links) const override;
  Rates columnRates(int leg, const LegState<S>& at, const Matrix6<S>& T_P) const override;
  Vector3<S> columnArm(const Motion<S>& motion) const override;
  Vector3<S> sphericalPoint(const Motion<S>& motion, int leg, const LegState<S>& at) const override;
  S massOf(int body) const override;
  BodyTensors<S> tensors(const NocWorkspace<S>& work) const override;
  Vector6<S> rotors() const override;
  Vector6<S> W(int body, const NocWorkspace<S>& work, const Vector6<S>& x) const override;
  BodyVector<S> gravityWrench() const override;
  BodyVector<S> dissipativeWrench(const NocWorkspace<S>& work) const override;
  BodyVector<S> loadWrench(const Motion<S>& motion, const Vector6<S>& load) const override;
  Vector6<S> tauG(const Motion<S>& motion, const NocWorkspace<S>& work, const Vector6<S>& load) const override;
  Vector6<S> tauD(const NocWorkspace<S>& work) const override;

 private:
  bool has(FormulaError error) const { return errors_.has(error); }
  const LegModel<S>& leg(int i) const { return this->machine().legs[i]; }

  WithFormulaErrors errors_;
};

extern template class WrongNoc<double>;

/// The NOC with an injected fault as a subject.
Subject wrongNocSubject(const Manipulator& manipulator, const std::shared_ptr<const Load>& load,
                        const WithFormulaErrors& fault);

}  // namespace ursula
