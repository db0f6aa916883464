#pragma once

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engines/open_tree.h"
#include "model/load.h"
#include "model/manipulator.h"

namespace ursula {

/// How somebody gets the efforts of a closed loop out of an engine. The first is right; the others are usual.
enum class Recipe {
  exact,             ///< tree dynamics, and multipliers of the loop closures
  open,              ///< inverse dynamics of the trees alone, their loops ignored
  no_bias,           ///< J̇ u left out of the accelerations of the joints
  least_squares,     ///< the smallest forces on all coordinates, read at the motors
  own_inverse,       ///< the engine's own inverse dynamics of the loop at its default softness, read at the motors
  own_inverse_hard,  ///< the same with the loops as hard as it allows
};

/// "own_inverse": as they are called above.
const char* name(Recipe recipe);

/// How rigid an engine is told to keep the loops, by names of its own.
struct Rigidity {
  std::string name;  ///< "default"
  double step = 0;   ///< over which efforts stand still, s
  /// Of which instant they are, as a share of the step: where the engine's steps follow a motion best.
  double instant = 0;
  std::vector<std::pair<std::string, double>> settings;  ///< {"solref_timeconst", 0.02}
};

/// Trees, and how far their loops are open.
struct PlacedTree : OpenTree {
  /// From the platform's point to the leg's, m, in the axes of J and P.
  std::array<Vector3d, leg_count> gaps{Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero(),
                                       Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
};

/// The largest, m.
double largestGap(const PlacedTree& tree, const Manipulator& manipulator);

/// The farthest that a centre of the platform's joints is from where it would be with its loops closed, the motors
/// standing where they are, m; to first order in the gaps.
double sag(const PlacedTree& tree, const Manipulator& manipulator);

/// The closed loop as the engine itself moves it in time.
class SteppedLoop {
 public:
  struct State {
    Vector3d p = Vector3d::Zero();  ///< of the platform's P, m, in B
    Vector6d q = Vector6d::Zero();  ///< of the motors
    double energy = 0;              ///< kinetic and potential, J
    double power = 0;               ///< of friction and load, W
    PlacedTree tree;                ///< its forces are not set
  };

  SteppedLoop() = default;
  virtual ~SteppedLoop() = default;
  SteppedLoop(const SteppedLoop&) = delete;
  SteppedLoop& operator=(const SteppedLoop&) = delete;

  /// Puts the machine into the motion, loops closed.
  virtual void start(const Motion<double>& motion) = 0;
  /// Throws std::runtime_error where the engine gives up.
  virtual void step(const Vector6d& efforts) = 0;
  virtual void read(State& out) = 0;
};

/// An engine as somebody asks it who has a machine with closed loops. Built of raw parameters alone. Not thread-safe.
class LoopEngine {
 public:
  explicit LoopEngine(const Manipulator& manipulator) : manipulator_(manipulator) {}
  virtual ~LoopEngine() = default;
  LoopEngine(const LoopEngine&) = delete;
  LoopEngine& operator=(const LoopEngine&) = delete;

  /// N·m or N, in motor order. Throws std::domain_error where a leg cannot reach, std::logic_error for own_inverse
  /// where the engine has none.
  Vector6d efforts(Recipe recipe, const Motion<double>& motion);

  /// Whether accelerations of the legs have J̇ u.
  enum class Bias { kept, left_out };
  /// The trees at the motion: the legs' coordinates, rates and accelerations by the engine's own means.
  virtual const PlacedTree& tree(const Motion<double>& motion, Bias bias) = 0;

  /// What makes its loops more or less rigid, the default first; empty where it moves nothing in time.
  virtual std::vector<Rigidity> rigidities() const { return {}; }
  virtual std::unique_ptr<SteppedLoop> stepped(const Rigidity& rigidity) const;

  const Manipulator& manipulator() const { return manipulator_; }

 protected:
  /// With the multipliers; by the tree where the engine has no way of its own.
  virtual Vector6d closed(const Motion<double>& motion, Bias bias);
  virtual Vector6d ownInverse(const Motion<double>& motion, bool hard);

 private:
  Manipulator manipulator_;
};

/// A row of the table: an engine, and the names of its calls that belong to the recipes.
struct LoopEngineKind {
  const char* name;     ///< "MuJoCo"
  const char* package;  ///< Debian's, that a build needs; "" where it is never missing
  bool (*available)();
  std::string (*version)();  ///< "" where it has none of its own
  std::unique_ptr<LoopEngine> (*make)(const Manipulator& manipulator, std::shared_ptr<const Load> load);
  Recipe obvious;            ///< what its users call first
  const char* exact_call;    ///< an imperative: "take …, and …"
  const char* obvious_call;  ///< its subject: "mj_inverse, read at the motors,"
  bool has_own_inverse;
};

// Each engine's folder defines its own.
using MakeLoopEngine = std::unique_ptr<LoopEngine>(const Manipulator& manipulator, std::shared_ptr<const Load> load);
MakeLoopEngine makeSimbodyCalls, makeMaximalCalls, makeMujocoCalls, makeDartCalls;
bool dartCallsAvailable();  ///< false where this was built without DART
std::string dartVersion();
std::string simbodyVersion();  ///< of the library that is loaded, "3.7.0"

/// The table of them all. Another engine is a folder here and its row.
const std::vector<LoopEngineKind>& loopEngines();

}  // namespace ursula
