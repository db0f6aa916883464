#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <vector>

#include "base/errors.h"
#include "base/utf8.h"
#include "model/instants.h"
#include "nocsolver/errors.h"
#include "parts/fast/batch_dynamics.h"
#include "parts/fast/solver.h"
#include "parts/sweep/run.h"
#include "validation/checks/judges.h"
#include "validation/mechanism/validate_mechanism.h"
#include "validation/subject/scaled_jacobian.h"
#include "validation/subject/subject.h"
#include "validation/validate.h"
#include "validation/verdict/worst_share.h"

namespace ursula {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Extremes over a scenario's judged instants.
struct Extremes {
  Vector6d efforts = Vector6d::Zero();  ///< each motor's largest |τ|, N·m, or N for a sliding motor
  Vector6d times = Vector6d::Zero();    ///< the first instants of these, s
  /// Condition number of B of (23) with moments over the machine's length, where ‖B‖ ‖B⁻¹‖ in Frobenius norms is
  /// largest.
  double kappa = 0;
  double sine = 1;  ///< the smallest LegMargins::sine over all legs and instants
};

/// Finds extremes. It reuses its memory, and the motion if that is constant.
class MotionExtremes {
 public:
  /// Throws PoseError like the solver, for the first instant without an answer. `varies` says that the motion differs
  /// from the last call's.
  Extremes of(const Scenario& scenario, bool varies) {
    if (varies || motions_.empty()) {
      motions_.clear();
      for (const double t : equallySpaced(scenario.trajectory->duration(), scenario.simulation.samples))
        motions_.push_back(scenario.trajectory->at(t));
    }
    Extremes out;
    findEfforts(scenario, out);
    findMargins(*scenario.manipulator, out);
    return out;
  }

 private:
  void findEfforts(const Scenario& scenario, Extremes& out) {
    efforts_.resize(motions_.size());
    faults_.resize(motions_.size());
    loads_.clear();
    if (scenario.load)
      for (const Motion<double>& motion : motions_) loads_.push_back(loadAtP(scenario.load.get(), motion));
    BatchDynamics(*scenario.manipulator)
        .inverseDynamics(motions_.data(), motions_.size(), efforts_.data(), faults_.data(),
                         loads_.empty() ? nullptr : loads_.data());
    for (std::size_t k = 0; k < motions_.size(); ++k)
      for (int m = 0; m < motor_count; ++m)
        if (const double size = std::abs(efforts_[k](m));
            faults_[k] == PoseFault::none && (exceeds(size, out.efforts(m)) || k == 0)) {
          out.efforts(m) = size;
          out.times(m) = motions_[k].t;
        }
  }

  /// Throws for the first instant at which the legs or the batch have no answer.
  void findMargins(const Manipulator& machine, Extremes& out) const {
    const Solver<double> solver(machine);
    Workspace<double> work;
    double worst = 0;
    Matrix6d at_worst = Matrix6d::Identity();
    for (std::size_t k = 0; k < motions_.size(); ++k) {
      solver.displacements(motions_[k], work);
      for (int i = 0; i < machine.legCount(); ++i) out.sine = std::min(out.sine, solver.margins(work, i).sine);
      if (faults_[k] != PoseFault::none) solver.inverseKinematics(motions_[k], work);
      solver.jacobians(motions_[k], work);
      const Matrix6d B = scaledB(work.B, solver.length());
      const double bound = B.norm() * B.inverse().norm();
      if (bound > worst || k == 0) {
        worst = bound;
        at_worst = B;
      }
      if (faults_[k] != PoseFault::none) solver.inverseDynamics(motions_[k], work);
    }
    out.kappa = conditionNumber(at_worst);
  }

  std::vector<Motion<double>> motions_;
  std::vector<Vector6d> loads_, efforts_;
  std::vector<PoseFault> faults_;
};

const char* verdictOf(const PoseError& refusal) {
  return dynamic_cast<const SingularJacobian*>(&refusal) != nullptr ||
                 dynamic_cast<const StretchedLeg*>(&refusal) != nullptr
             ? "singular"
             : "out_of_reach";
}

/// Returns the name of the margin from margins(); "" for legs without one, which cannot be stretched.
std::string marginName(const Manipulator& manipulator) {
  const LegKind first = manipulator.leg(0).kind;
  for (int i = 1; i < manipulator.legCount(); ++i)
    if (manipulator.leg(i).kind != first) return "leg_margin";
  const char* knee = rowOf(first).knee;
  std::string name = knee == nullptr ? "" : knee;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

void failed(const char* why, SweepPoint& point) {
  point.verdict = "error";
  point.error = utf8(why);
  point.values.clear();
}

class SweepWorker {
 public:
  explicit SweepWorker(SweepPlan& plan) : plan_(plan) {}

  SweepPoint at(std::int64_t i) {
    SweepPoint point;
    point.id = i;
    point.parameters = plan_.parameters(i);
    const auto start = std::chrono::steady_clock::now();
    try {
      if (plan_.mechanism() != nullptr)
        plan_.file().work == SweepWork::inverse ? inverseOfMechanism(i, point) : validateMechanism(i, point);
      else
        plan_.file().work == SweepWork::inverse ? inverse(i, point) : validate(i, point);
    } catch (const LoopError& refusal) {
      point.verdict = "out_of_reach";
      point.error = utf8(refusal.what());
      point.values.clear();
    } catch (const PoseError& refusal) {
      point.verdict = verdictOf(refusal);
      point.values.clear();
      if (refusal.leg() >= 0) add("refused_leg", refusal.leg() + 1.0, point);
      add("refused_t_s", refusal.instant(), point);
    } catch (const std::bad_alloc&) {
      failed(out_of_memory_for_scenario, point);
    } catch (const std::exception& error) {
      failed(error.what(), point);
    }
    point.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return point;
  }

 private:
  static void add(const std::string& name, double value, SweepPoint& point) {
    point.values.push_back({name, value, none, ""});
  }

  void inverse(std::int64_t i, SweepPoint& point) {
    const Scenario scenario = plan_.make(i);
    const Extremes found = extremes_.of(scenario, plan_.variesMotion());
    for (int k = 0; k < motor_count; ++k) {
      add(fmt::format("tau_{}_{}", k + 1, scenario.manipulator->motors()[k].effortUnit()), found.efforts(k), point);
      add(fmt::format("tau_{}_t_s", k + 1), found.times(k), point);
    }
    add("kappa_B", found.kappa, point);
    if (const std::string margin = marginName(*scenario.manipulator); !margin.empty()) add(margin, found.sine, point);
    point.verdict = "pass";
  }

  /// The largest effort of each motor, and the passive rates' worst condition number.
  void inverseOfMechanism(std::int64_t i, SweepPoint& point) const {
    const MechanismScenario scenario = plan_.readMechanism(i);
    const MechanismAlong along(scenario);
    const auto n = static_cast<Eigen::Index>(scenario.mechanism->motorCount());
    Eigen::VectorXd efforts = Eigen::VectorXd::Constant(n, -1), times = Eigen::VectorXd::Zero(n);
    double condition = 0;
    LoopWork work;
    for (const double t : equallySpaced(scenario.trajectory->duration(), scenario.simulation.samples)) {
      const Eigen::VectorXd sizes = along.motion().inverseDynamics(t, work).cwiseAbs();
      condition = std::max(condition, 1 / work.reciprocal_condition);
      for (Eigen::Index k = 0; k < n; ++k)
        if (exceeds(sizes(k), efforts(k))) efforts(k) = sizes(k), times(k) = t;
    }
    for (Eigen::Index k = 0; k < n; ++k) {
      add(motorColumn(*scenario.mechanism, k, "tau"), efforts(k), point);
      add(fmt::format("tau_{}_t_s", k + 1), times(k), point);
    }
    add("kappa_passive", condition, point);
    point.verdict = "pass";
  }

  void validateMechanism(std::int64_t i, SweepPoint& point) const {
    take(ursula::validateMechanism(plan_.readMechanism(i)), point);
  }

  void validate(std::int64_t i, SweepPoint& point) {
    take(plan_.file().pointwise ? pointwise(i) : ursula::validate(plan_.read(i)), point);
  }

  static void take(const ValidationResult& result, SweepPoint& point) {
    const auto known = [](double x) { return std::isfinite(x) ? x : none; };
    for (const Check& check : result.checks)
      if (check.verdict != Verdict::not_applicable)
        point.values.push_back({check.name, known(check.value), known(check.limit), name(check.verdict)});
    point.verdict = name(result.verdict);
  }

  /// Judges the commanded motion only once if all points share it.
  ValidationResult pointwise(std::int64_t i) {
    if (plan_.variesMotion()) return validatePointwise(plan_.read(i));
    if (!of_motion_) of_motion_ = judgeCommandedMotion(plan_.base());
    return validatePointwise(plan_.make(i), &*of_motion_);
  }

  SweepPlan& plan_;
  MotionExtremes extremes_;
  std::optional<std::vector<Check>> of_motion_;
};

}  // namespace

PointWork workOn(SweepPlan& plan) {
  const auto worker = std::make_shared<SweepWorker>(plan);
  return [worker](std::int64_t i) { return worker->at(i); };
}

}  // namespace ursula
