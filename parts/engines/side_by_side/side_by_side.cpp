#include "parts/engines/side_by_side/side_by_side.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>
#include <utility>

#include "model/instants.h"
#include "nocsolver/errors.h"
#include "parts/engines/side_by_side/in_time.h"
#include "validation/mechanism/validate_mechanism.h"
#include "validation/subject/motion_check.h"
#include "validation/subject/subject.h"
#include "validation/verdict/worst_share.h"

namespace ursula {

EngineReference::EngineReference(const Scenario& scenario) : scenario_(scenario), noc_(*scenario.manipulator) {}

EngineReference::Here EngineReference::at(double t) {
  const Motors& motors = scenario_.manipulator->motors();
  Here out;
  out.motion = scenario_.trajectory->at(std::min(t, scenario_.trajectory->duration()));
  out.efforts = noc_.inverseDynamics(out.motion, work_, loadAtP(scenario_.load.get(), out.motion));
  out.q_dot = noc_.rates(work_).driven(motors);
  return out;
}

namespace {

/// What an answer is compared with at one instant.
struct Instant {
  double t = 0;
  Eigen::VectorXd efforts, q_dot;
};
using Instants = std::vector<Instant>;

struct Scale {
  double torque = 0, force = 0, power = 0;

  double of(const SideBySide::Motor& motor) const {
    const double own = motor.unit == "N" ? force : torque;
    return own > 0 ? own : std::max(torque, force);
  }
};

Scale scaleOf(const Instants& instants, std::vector<SideBySide::Motor>& motors) {
  Scale out;
  for (const Instant& here : instants) {
    for (std::size_t m = 0; m < motors.size(); ++m) {
      const double size = std::abs(here.efforts(static_cast<Eigen::Index>(m)));
      double& largest = motors[m].unit == "N" ? out.force : out.torque;
      largest = std::max(largest, size);
      motors[m].largest = std::max(motors[m].largest, size);
    }
    out.power = std::max(out.power, std::abs(here.efforts.dot(here.q_dot)));
  }
  if (!(std::max(out.torque, out.force) > 0))
    throw std::runtime_error("the motion needs no efforts: there is nothing that errors could be related to");
  return out;
}

/// Efforts of a recipe at the k-th instant.
using AskEfforts = std::function<Eigen::VectorXd(Recipe recipe, std::size_t k)>;

/// Compares answers along a motion.
class Comparison {
 public:
  Comparison(Instants instants, SideBySide& out)
      : instants_(std::move(instants)), scale_(scaleOf(instants_, out.motors)), motors_(out.motors) {
    out.instants = static_cast<int>(instants_.size());
    const bool has_torque =
        std::any_of(motors_.begin(), motors_.end(), [](const SideBySide::Motor& each) { return each.unit != "N"; });
    out.largest_effort = has_torque ? scale_.torque : scale_.force;
    out.unit = has_torque ? "N m" : "N";
    if (has_torque) out.largest_force = scale_.force;
    out.efforts.setZero(static_cast<Eigen::Index>(instants_.size()), static_cast<Eigen::Index>(motors_.size()));
    for (std::size_t k = 0; k < instants_.size(); ++k) {
      out.t.push_back(instants_[k].t);
      out.efforts.row(static_cast<Eigen::Index>(k)) = instants_[k].efforts;
    }
  }

  RecipeResult ask(Recipe recipe, const AskEfforts& efforts_of) const {
    RecipeResult out;
    out.recipe = recipe;
    out.efforts.setZero(static_cast<Eigen::Index>(instants_.size()), static_cast<Eigen::Index>(motors_.size()));
    std::vector<double> seconds;
    for (std::size_t k = 0; k < instants_.size(); ++k) {
      const auto start = std::chrono::steady_clock::now();
      const Eigen::VectorXd efforts = efforts_of(recipe, k);
      seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
      out.efforts.row(static_cast<Eigen::Index>(k)) = efforts;
      compare(instants_[k], efforts - instants_[k].efforts, out);
    }
    out.power = scale_.power > 0 ? out.power / scale_.power : std::numeric_limits<double>::quiet_NaN();
    out.seconds = median(seconds);
    return out;
  }

 private:
  void compare(const Instant& here, const Eigen::VectorXd& off, RecipeResult& out) const {
    for (std::size_t m = 0; m < motors_.size(); ++m) {
      const double deviation = std::abs(off(static_cast<Eigen::Index>(m))), error = deviation / scale_.of(motors_[m]);
      if (!exceeds(error, out.error)) continue;
      out.error = error;
      out.deviation = deviation;
      out.at = here.t;
      out.motor = static_cast<int>(m);
    }
    if (const double power = std::abs(off.dot(here.q_dot)); exceeds(power, out.power)) out.power = power;
  }

  Instants instants_;
  Scale scale_;
  std::vector<SideBySide::Motor> motors_;
};

std::vector<Recipe> recipesOf(const LoopEngineKind& kind) {
  std::vector<Recipe> out = {Recipe::exact, Recipe::open, Recipe::no_bias, Recipe::least_squares};
  if (kind.has_own_inverse) out.insert(out.end(), {Recipe::own_inverse, Recipe::own_inverse_hard});
  return out;
}

EngineResult named(const LoopEngineKind& kind) {
  EngineResult out;
  out.kind = &kind;
  out.version = kind.version();
  return out;
}

/// Runs `fill`; what the engine refuses becomes its reason.
template <class Fill>
EngineResult filled(const LoopEngineKind& kind, const Fill& fill) {
  EngineResult out = named(kind);
  try {
    fill(out);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const PoseError&) {
    throw;
  } catch (const std::exception& words) {
    out = named(kind);
    out.refused = words.what();
  }
  return out;
}

/// Asks the engines that are wanted and there, and lists those that this build lacks.
template <class Ask>
void askEngines(const SideBySideOptions& options, SideBySide& out, const Ask& ask) {
  std::vector<const LoopEngineKind*> asked;
  for (const LoopEngineKind& kind : loopEngines()) {
    const bool wanted = options.engines.empty() ||
                        std::find(options.engines.begin(), options.engines.end(), &kind) != options.engines.end();
    if (wanted) (kind.available() ? asked : out.missing).push_back(&kind);
  }
  for (const LoopEngineKind* kind : asked) {
    if (options.on_progress)
      options.on_progress(static_cast<double>(out.engines.size()) / static_cast<double>(asked.size()), kind->name);
    out.engines.push_back(ask(*kind));
  }
}

/// Refuses a recipe that an engine does not know for this machine; all others are asked.
RecipeResult askMechanism(const Comparison& comparison, Recipe recipe, const AskEfforts& efforts_of) {
  try {
    return comparison.ask(recipe, efforts_of);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& words) {
    if (recipe == Recipe::exact) throw;
    RecipeResult out;
    out.recipe = recipe;
    out.refused = words.what();
    out.error = out.power = std::numeric_limits<double>::quiet_NaN();
    return out;
  }
}

void askMechanismEngine(const MechanismAlong& along, const Comparison& comparison,
                        const std::vector<MotorMotion>& motions, double moved, EngineResult& out) {
  const Mechanism& mechanism = along.solver().mechanism();
  out.of_mechanism = true;
  if (out.kind->make_mechanism == nullptr) throw std::runtime_error("it takes no mechanisms");
  const std::unique_ptr<MechanismCalls> engine = out.kind->make_mechanism(mechanism);
  const AskEfforts efforts_of = [&](Recipe recipe, std::size_t k) {
    Eigen::VectorXd efforts = engine->efforts(recipe, motions[k]);
    out.gap = larger(out.gap, engine->gap());
    return efforts;
  };
  for (const Recipe recipe : recipesOf(*out.kind))
    if (out.kind->in_tree || recipe == Recipe::exact || recipe == Recipe::no_bias)
      out.recipes.push_back(askMechanism(comparison, recipe, efforts_of));
  for (const Rigidity& rigidity : engine->rigidities())
    out.in_time.push_back(moveInTime(rigidity, moved, [&] { return movingMechanism(*engine, rigidity, along); }));
  for (const std::size_t j : engine->cutJoints()) out.cut.push_back(mechanism.joints()[j].name);
}

}  // namespace

const RecipeResult& EngineResult::of(Recipe recipe) const {
  const auto found = std::find_if(recipes.begin(), recipes.end(),
                                  [recipe](const RecipeResult& each) { return each.recipe == recipe; });
  if (found == recipes.end()) throw std::logic_error("the engine was not asked by this recipe");
  return *found;
}

const LoopEngineKind* loopEngineNamed(const std::string& name) {
  const auto lower = [](std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c); });
    return text;
  };
  for (const LoopEngineKind& kind : loopEngines())
    if (lower(kind.name) == lower(name)) return &kind;
  return nullptr;
}

SideBySide engineSideBySide(const Scenario& scenario, const SideBySideOptions& options) {
  checkMotion(scenario);
  SideBySide out;
  out.scenario = scenario.name;
  const double duration = scenario.trajectory->duration();
  out.moved = std::min(options.moved, duration);
  for (const Motor& motor : scenario.manipulator->motors())
    out.motors.push_back({fmt::format("motor {}", out.motors.size() + 1), motor.slides() ? "N" : "N m"});
  EngineReference reference(scenario);
  std::vector<Motion<double>> motions;
  Instants instants;
  for (int k = 0; k < options.samples; ++k) {
    const EngineReference::Here here = reference.at(duration * k / (options.samples - 1));
    motions.push_back(here.motion);
    instants.push_back({here.motion.t, here.efforts, here.q_dot});
  }
  const Comparison comparison(std::move(instants), out);
  askEngines(options, out, [&](const LoopEngineKind& kind) {
    return filled(kind, [&](EngineResult& found) {
      const std::unique_ptr<LoopEngine> engine = kind.make(*scenario.manipulator, scenario.load);
      for (const Motion<double>& motion : motions)
        found.gap = larger(found.gap, largestGap(engine->tree(motion, LoopEngine::Bias::kept), engine->manipulator()));
      for (const Recipe recipe : recipesOf(kind))
        found.recipes.push_back(comparison.ask(
            recipe, [&](Recipe by, std::size_t k) { return Eigen::VectorXd(engine->efforts(by, motions[k])); }));
      for (const Rigidity& rigidity : engine->rigidities())
        found.in_time.push_back(
            moveInTime(rigidity, out.moved, [&] { return movingManipulator(*engine, rigidity, reference); }));
    });
  });
  return out;
}

SideBySide engineSideBySide(const MechanismScenario& scenario, const SideBySideOptions& options) {
  const MechanismAlong along(scenario);
  const Mechanism& mechanism = *scenario.mechanism;
  SideBySide out;
  out.scenario = scenario.name;
  out.model = scenario.model.filename().string();
  out.moved = std::min(options.moved, scenario.trajectory->duration());
  for (std::size_t k = 0; k < mechanism.motorCount(); ++k)
    out.motors.push_back({mechanism.motor(k).name, mechanism.motor(k).slides() ? "N" : "N m"});
  std::vector<MotorMotion> motions;
  Instants instants;
  LoopWork work;
  for (const double t : equallySpaced(scenario.trajectory->duration(), options.samples)) {
    motions.push_back(scenario.trajectory->at(t));
    instants.push_back({t, along.motion().inverseDynamics(t, work), motions.back().qdot});
  }
  const Comparison comparison(std::move(instants), out);
  askEngines(options, out, [&](const LoopEngineKind& kind) {
    return filled(kind, [&](EngineResult& found) { askMechanismEngine(along, comparison, motions, out.moved, found); });
  });
  return out;
}

}  // namespace ursula
