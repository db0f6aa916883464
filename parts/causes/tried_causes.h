#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "model/scenario.h"
#include "nocsolver/errors.h"
#include "validation/subject/body_terms.h"
#include "validation/verdict/result.h"

// The causes that hypotheses.cpp tries on efforts that are wrong, a source for each group.

namespace ursula {

/// The efforts that a solver gives for one motion, N·m or N. Throws PoseError if there are none.
using EffortsOf = std::function<Vector6d(const Motion<double>&)>;

/// What `run` returns; nullopt if it throws that there is no such machine or pose.
template <class Run>
auto unlessRefused(const Run& run) -> std::optional<decltype(run())> {
  try {
    return run();
  } catch (const PoseError&) {
  } catch (const std::invalid_argument&) {
  }
  return std::nullopt;
}

/// A possible difference in how torques were computed: another machine, another interpretation of the motion, an extra
/// term. It has one fitted number x, which is zero without a difference, or none.
struct Cause {
  using Words = std::function<std::string(double x, double deviation)>;
  using Named = std::function<std::optional<NamedCause>(double x, double deviation)>;

  bool fitted = true;
  /// The solver of a scenario with this x. Throws std::invalid_argument if there is none.
  std::function<EffortsOf(const Scenario&, double x)> solver;
  /// "platform mass 499.31 +- 0.02 kg instead of 500"; `deviation` is two standard deviations of x.
  Words words;
  /// The same as `words`, typed; empty if the contract has no name for it.
  Named named = {};
  /// The torques' derivative by x at 0; empty if only differences give it.
  std::function<std::vector<Vector6d>(const std::vector<Motion<double>>&)> slope = {};
  /// Rounding of the torques of one motion, N·m; empty if it is that of the right ones.
  std::function<double(const Motion<double>&)> rounding = {};
  /// Whether a body can have the fitted number; empty if it can have every one.
  std::function<bool(double x)> is_possible = {};
  /// Where the fit may begin; other numbers than 0 are tried as they are.
  std::vector<double> starts = {0};
  /// What is wrong, if it is the machine's numbers or the motion as it was read; then several apply at once.
  std::function<void(ManipulatorParameters&, double x)> machine = {};
  std::function<void(Motion<double>&, double x)> reading = {};
  const Scenario* scenario = nullptr;  ///< of TriedCauses, which sets it

  /// The torques, N·m. Throws std::invalid_argument or PoseError if they do not exist for this x.
  std::vector<Vector6d> torques(double x, const std::vector<Motion<double>>& motions) const;
};

/// The name of a cause without a fitted number, in words and in the contract.
struct CauseName {
  std::string text;
  std::optional<NamedCause> named = {};

  explicit CauseName(std::string words) : text(std::move(words)) {}
  CauseName(std::string words, const NamedCause& typed) : text(std::move(words)), named(typed) {}
};

/// "499.31 +- 0.02", to the deviation's digits but at most ten; "499.31" without a deviation. "0" for zeros, and for
/// what differs from zero by less than the deviation and by no printed digit of `scale`.
std::string withDeviation(double value, double deviation, double scale = 0);

class MachineSlopes;
struct TiedParameters;

/// Collects causes. The scenario must outlive them.
struct TriedCauses {
  using Machine = ManipulatorParameters;

  const Scenario& scenario;
  const Manipulator& machine = *scenario.manipulator;
  std::vector<Cause> causes = {};
  bool one_by_one = false;                     ///< whether different numbers of the machine are never tied
  std::shared_ptr<MachineSlopes> slopes = {};  ///< once a machine's number is fitted

  Cause& push(const Cause& cause);
  /// Adds a cause without a fitted number; `solver` is called when it is tried.
  Cause& add(const CauseName& name, const std::function<EffortsOf(const Scenario&)>& solver);

  /// Adds the NOC's efforts for a motion that a solver read otherwise; telescopic legs then have no end of stroke.
  Cause& addReading(const CauseName& name, const std::function<void(Motion<double>&)>& change);

  /// Adds the NOC's efforts with another machine at each instant, without ends of strokes.
  void addNotTurned(const CauseName& name, const std::function<void(Machine&, const Matrix3d& Q)>& change);

  /// Adds the efforts of another machine. The effect of the change counts `times`: twice if a change that removes a
  /// term stands for its wrong sign.
  void addMachine(const CauseName& name, const std::function<void(Machine&)>& change, double times = 1);
  /// Adds a change of all links, of the proximal ones and of the distal ones, also of each kind of leg alone. `kind`
  /// and `term` name it.
  void addLinks(const std::string& before, const std::string& after, CauseKind kind, const char* term,
                const std::function<void(Link&)>& change);
  Cause& addFitted(const std::function<void(Machine&, double x)>& change, const Cause::Words& words,
                   const Cause::Named& named);
  void addTied(const TiedParameters& tied);

  /// The efforts that a mistake adds for one motion.
  using EffortChange = std::function<Vector6d(const MachineTerms&)>;
  /// Adds a mistake that adds something to the NOC's efforts.
  void addEfforts(const CauseName& name, const EffortChange& change);
  /// Adds the mistake also for a solver that makes it first, and then adds its motors' own friction and rotors.
  void addAlsoWithoutMotors(const std::string& text, const NamedCause& named, const EffortChange& change);
};

/// Returns the causes of one of the groups below. `scenario` must outlive them.
std::vector<Cause> causesOf(const Scenario& scenario, void (*group)(TriedCauses&));

/// Errors in every continuous parameter of the machine, for all legs, both links or one leg. Others are gravity's size,
/// the other knee branch, inertias about the wrong point, mass centres from the wrong end, and exchanged values. Likely
/// causes come first.
void addMachineCauses(TriedCauses& out);
/// Points and axes of all legs at once: scaled, turned, numbered otherwise.
void addPointCauses(TriedCauses& out);
/// Friction that the scenario lacks, and parts of its own left out or with the wrong sign.
void addFrictionCauses(TriedCauses& out);

/// Other interpretations of the motion: inverse rotation, the platform's frame, another point, a missing part. Also
/// platform quantities used without rotation, and inertias of the motors. Then come rates read otherwise: rates of
/// angles for the angular velocity, degrees, millimetres.
void addMotionCauses(TriedCauses& out);
/// Rates of angles for the angular velocity, turns in another order.
void addAngleCauses(TriedCauses& out);

/// Mistakes in a solver's own formulas, for every kind of leg. A term of a group of bodies is missing or has the wrong
/// sign; tensors use other frames or points; the links' spin is missing.
void addTermCauses(TriedCauses& out);

/// Mistakes in a leg's own coordinates: friction without signs, rotors without the Jacobian's rate, a wrong or
/// damped inverse of its Jacobian, rates of distal links relative to the proximal ones.
void addJointCauses(TriedCauses& out);

/// A wrong Jacobian, or moments about the wrong point.
void addJacobianCauses(TriedCauses& out);

/// Open loops or loops closed by least squares, missing J̇.
void addLoopCauses(TriedCauses& out);

/// Mistakes with sliding legs, UPS and PUS: a mass centre is measured from the joint at the leg's other end, or a force
/// is along the wrong line.
void addSlidingCauses(TriedCauses& out);

/// All of the groups above.
void addEveryCause(TriedCauses& out);

/// Terms left out or with the wrong sign, of the paper's solver as well; `torqueTerms` fits their factors.
void addTerms(TriedCauses& out);
/// Efforts of another time, t − x.
void addDelay(TriedCauses& out);

/// Rates that a solver takes as differences between the instants of its torques, s. None if these are too few.
void addDifferenceCauses(const std::vector<double>& instants, TriedCauses& out);

/// Telescopic legs without an end of stroke: another machine or a misread pose may be beyond it, and a solver need not
/// care.
Manipulator withoutStroke(const Manipulator& machine);

}  // namespace ursula
