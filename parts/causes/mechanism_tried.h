#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "parts/causes/mechanism_instants.h"
#include "validation/mechanism/mechanism_evidence.h"
#include "validation/verdict/result.h"

namespace ursula::mechanisms {

/// Efforts that differ from the right ones, of all instants one after the other.
struct EffortResidual {
  const Mechanism* mechanism = nullptr;
  const LoopMotion* motion = nullptr;
  std::vector<double> t;
  std::vector<Instant> instants;  ///< of the motion; those of `noc`
  VectorXd noc, found;            ///< N·m or N
  VectorXd limit;                 ///< possible difference of right efforts: rounding and the file's digits
  VectorXd rounds;                ///< the part of it that is rounding
  std::vector<MatrixXd> inertia;  ///< I of (34) at each instant, if the efforts come from a simulator's accelerations
  Eigen::Index motors = 1;
  double growth = 1;  ///< how many times larger the found efforts are than what rounds in the right ones

  VectorXd residual() const { return found - noc; }
  /// Puts the efforts of each instant one after the other.
  template <class Of>
  VectorXd each(const Of& of) const {
    VectorXd out(noc.size());
    for (std::size_t i = 0; i < instants.size(); ++i)
      out.segment(static_cast<Eigen::Index>(i) * motors, motors) = of(instants[i]);
    return out;
  }
  /// The largest ratio of an entry to its limit.
  double beyond(const VectorXd& left) const;
  /// Whether a remainder that only the file's digits allow is alike from one instant to the next, as rounding to digits
  /// is not. Digits that hardly change tell nothing.
  bool isSmooth(const VectorXd& left) const;
};

/// One mistake with numbers x that are fitted, zero if there is none.
struct Tried {
  NamedCause named;
  /// The change of the right efforts of a motion, perhaps of another machine.
  std::function<VectorXd(const EffortResidual& of, const VectorXd& x)> change;
  VectorXd steps = {};  ///< for differences by each number; empty without numbers
  /// Sets what the fitted numbers mean; returns false if no machine can have them.
  std::function<bool(const VectorXd& x, const VectorXd& uncertainty, NamedCause& named)> finish = {};
  std::string detail = {};  ///< what the named cause does not tell; goes into the words
  /// What is wrong, if it is the machine's numbers; then several apply at once.
  std::function<void(MechanismParameters&, const VectorXd& x)> machine = {};
};

/// A mistake after its fit.
struct Fitted {
  NamedCause named;
  std::string detail;
  int numbers = 0;
  double unexplained = 1;   ///< ‖left‖ / ‖residual‖
  double of_found = 1;      ///< ‖left‖ / ‖found‖
  double beyond = 1e300;    ///< the largest remainder, in multiples of its limit
  bool is_smooth = false;   ///< the remainder is another error: EffortResidual::isSmooth
  VectorXd predicted = {};  ///< the change of the efforts
};

using ChangeOf = std::function<VectorXd(const EffortResidual&)>;

/// Adds a mistake without numbers; in the second form its change is that of this motion and machine alone.
void addFixed(std::vector<Tried>& out, const NamedCause& named, const ChangeOf& change, const std::string& detail = "");
void addFixed(std::vector<Tried>& out, const NamedCause& named, VectorXd change, const std::string& detail = "");

void addBodyCauses(const EffortResidual& data, std::vector<Tried>& out);
void addBodyNumbers(const EffortResidual& data, std::vector<Tried>& out);
void addJointTerms(const EffortResidual& data, std::vector<Tried>& out);
void addJointNumbers(const EffortResidual& data, std::vector<Tried>& out);
void addClosureCauses(const EffortResidual& data, std::vector<Tried>& out);
void addEffortCauses(const EffortResidual& data, std::vector<Tried>& out);
/// Wrong accelerations of a simulator: their scale, sign, unit, and order of the motors.
void addAccelerationCauses(const EffortResidual& data, std::vector<Tried>& out);
void addDelay(const EffortResidual& data, std::vector<Fitted>& out);

/// Whether a factor turns one usual unit into another: degrees, thousandths.
bool isUnit(double factor);
/// The number of at most twelve digits from which roundings of terms as large as `size` have moved a value, as changes
/// of axes do to a file's numbers; the value itself if there is none.
double asWritten(double value, double size);

/// Adds (1 + x) times a term; 0 is left out and −1 has the wrong sign, which are mistakes without numbers.
void addScaledTerm(const NamedCause& term, const ChangeOf& part, const std::string& detail, std::vector<Tried>& out);

/// The efforts of all bodies and joints at an instant of the motion, of a machine that may have other numbers.
VectorXd effortsOf(const Mechanism& mechanism, const Instant& at);

/// Some of the instants, at times later by `shift`, whose right efforts are then computed again.
EffortResidual picked(const EffortResidual& data, const std::vector<std::size_t>& rows, double shift);

/// All mistakes but those of geometry after their fits, those with fewest numbers first.
std::vector<Fitted> fittedCauses(const EffortResidual& data);

/// Wrong places and axes of joints that explain the deviation at some instants, after their fits to all. The motion is
/// solved again for each number of each.
std::vector<Fitted> fittedGeometry(const EffortResidual& data);

/// A mistake that explains everything, and those that explain it as well.
struct Explained {
  Fitted first;
  std::vector<Fitted> others = {};
};
/// Returns the first of `fitted` that explains everything; nullopt if none does.
std::optional<Explained> explained(const std::vector<Fitted>& fitted);

/// The named cause with its share of the deviation's square.
NamedCause withShare(const Fitted& one);
/// "99.0945 % of the deviation".
std::string percentOf(const Fitted& one);
/// "; as well explained by: …"; empty without others.
std::string othersIn(const std::vector<Fitted>& others);

/// Names the cause that explains everything, or lists those that do; false if none does.
bool nameAll(const std::vector<Fitted>& fitted, ValidationResult& result);

/// Names two or three mistakes that explain everything together; false if there are none for certain. `left` are the
/// multiples of the limits that the best single mistake leaves.
bool nameSeveral(const EffortResidual& data, double left, ValidationResult& result);

/// Fits by least squares, Gauss–Newton if the efforts are not linear in the numbers. Drops what has no effect.
std::vector<Fitted> fitAll(const std::vector<Tried>& tried, const EffortResidual& data);

/// The errors of a solver's answers to questions at rest, with accelerations alone, and with rates alone; empty if it
/// cannot be asked.
std::vector<TermError> askedApart(const MechanismEvidence& evidence);

/// "the mass of 'coupler' is 2.31 kg instead of 2.1 kg".
std::string inWords(const Fitted& cause);

}  // namespace ursula::mechanisms
