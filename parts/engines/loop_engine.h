#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/load.h"
#include "model/manipulator.h"
#include "model/open_tree.h"
#include "parts/engines/closed_mechanism.h"
#include "parts/engines/recipe.h"

namespace ursula {

/// Trees with the gaps of their loops.
struct PlacedTree : OpenTree {
  /// The leg's point minus the platform's, m, in the axes of J and P.
  PerLeg<Vector3d> gaps{Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero(),
                        Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
};

/// Returns the norm of the largest gap, m.
double largestGap(const PlacedTree& tree, const Manipulator& manipulator);

/// Returns the largest distance of a platform joint's centre from its place in the closed loop at the same motor
/// coordinates; m, to first order in the gaps.
double sag(const PlacedTree& tree, const Manipulator& manipulator);

/// The closed loop under the engine's own time stepping.
class SteppedLoop {
 public:
  struct State {
    Vector3d p = Vector3d::Zero();  ///< position of the platform's P, m, in B
    Vector6d q = Vector6d::Zero();  ///< motors' coordinates, rad or m
    double energy = 0;              ///< kinetic and potential energy, J
    double power = 0;               ///< power of friction and load, W
    PlacedTree tree;                ///< without forces
  };

  SteppedLoop() = default;
  virtual ~SteppedLoop() = default;
  SteppedLoop(const SteppedLoop&) = delete;
  SteppedLoop& operator=(const SteppedLoop&) = delete;

  /// Sets the machine to the motion with closed loops.
  virtual void start(const Motion<double>& motion) = 0;
  /// Throws std::runtime_error if the engine gives up.
  virtual void step(const Vector6d& efforts) = 0;
  virtual void read(State& out) = 0;
};

/// An engine with the calls that a user with closed loops makes. It uses raw parameters only. Not thread-safe.
class LoopEngine {
 public:
  explicit LoopEngine(const Manipulator& manipulator) : manipulator_(manipulator) {}
  virtual ~LoopEngine() = default;
  LoopEngine(const LoopEngine&) = delete;
  LoopEngine& operator=(const LoopEngine&) = delete;

  /// Returns efforts in N·m or N, in motor order. Throws std::domain_error if a leg cannot reach, and std::logic_error
  /// for own_inverse if the engine has none.
  Vector6d efforts(Recipe recipe, const Motion<double>& motion);

  /// Whether the legs' accelerations contain J̇ u.
  enum class Bias { kept, left_out };
  /// Returns the trees at the motion. The engine's own means give the legs' coordinates, rates and accelerations.
  virtual const PlacedTree& tree(const Motion<double>& motion, Bias bias) = 0;

  /// Returns the settings of the loops' rigidity, the default first; empty if the engine has no time stepping.
  virtual std::vector<Rigidity> rigidities() const { return {}; }
  virtual std::unique_ptr<SteppedLoop> stepped(const Rigidity& rigidity) const;

  const Manipulator& manipulator() const { return manipulator_; }

 protected:
  /// Computes efforts with multipliers. An engine with its own way overrides this; the default uses the tree.
  virtual Vector6d closed(const Motion<double>& motion, Bias bias);
  virtual Vector6d ownInverse(const Motion<double>& motion, bool hard);

 private:
  Manipulator manipulator_;
};

/// A row of the table: an engine, and its calls for the recipes.
struct LoopEngineKind {
  const char* name;     ///< "MuJoCo"
  const char* package;  ///< the Debian package that a build needs; "" if it is never missing
  bool (*available)();
  std::string (*version)();  ///< "" if it has no version of its own
  std::unique_ptr<LoopEngine> (*make)(const Manipulator& manipulator, std::shared_ptr<const Load> load);
  Recipe obvious;            ///< the recipe that its users try first
  const char* exact_call;    ///< completes a sentence as an imperative: "take …, and …"
  const char* obvious_call;  ///< completes a sentence as its subject: "mj_inverse, read at the motors,"
  bool has_own_inverse;

  // --- machines with any closed loops ---
  std::unique_ptr<MechanismCalls> (*make_mechanism)(const Mechanism& mechanism) = nullptr;
  const char* loop_call = "";      ///< as exact_call
  bool in_tree = true;             ///< it has a tree, whose forces can be read at the motors
  std::string_view code = {};      ///< its calls for that, as they are compiled
  std::string_view own_code = {};  ///< its calls for own_inverse
};

// Each engine's folder defines its own.
using MakeLoopEngine = std::unique_ptr<LoopEngine>(const Manipulator& manipulator, std::shared_ptr<const Load> load);
MakeLoopEngine makeSimbodyCalls, makeMaximalCalls, makeMujocoCalls;
std::unique_ptr<MechanismCalls> makeSimbodyMechanism(const Mechanism& mechanism);

/// DART is a module that is loaded on first use, because its libraries slow every start. It exports this under the name
/// ursula_engine_module.
struct EngineModule {
  const char* version;  ///< the engine's version, "6.12.1"
  MakeLoopEngine* make;
  BuildTree* build;
};

/// All engines. A new one needs a folder beside this file and a row.
const std::vector<LoopEngineKind>& loopEngines();

}  // namespace ursula
