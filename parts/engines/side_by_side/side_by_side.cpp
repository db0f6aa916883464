#include "parts/engines/side_by_side/side_by_side.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>

#include "base/text.h"
#include "nocsolver/errors.h"
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

/// Reorders its copy of the values. Returns 0 for none.
double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

class MovedLoop {
 public:
  MovedLoop(const LoopEngine& engine, const Rigidity& rigidity, EngineReference& reference)
      : engine_(engine), reference_(reference), loop_(engine.stepped(rigidity)) {
    out_.rigidity = rigidity;
  }

  TimeSteppingResult move(int steps) {
    loop_->start(reference_.at(0).motion);
    loop_->read(is_);
    const double energy = is_.energy;
    while (out_.steps < steps && step()) {
    }
    out_.energy = is_.energy - energy - work_;
    if (out_.steps == 0) out_.sag = out_.away = out_.energy = std::numeric_limits<double>::quiet_NaN();
    out_.seconds = median(seconds_);
    return out_;
  }

 private:
  /// Throws if a loop is wide open, because later states say nothing and may make an engine end the process.
  void requireClosed(const SteppedLoop::State& state) {
    const double gap = largestGap(state.tree, engine_.manipulator());
    out_.gap = larger(out_.gap, gap);
    if (!(gap < reference_.length() / 10)) throw std::runtime_error(fmt::format("a loop is open by {:.2g} m", gap));
  }

  /// Returns false if the engine gives up.
  bool step() {
    const double step = out_.rigidity.step;
    const Vector6d efforts = reference_.at((out_.steps + out_.rigidity.instant) * step).efforts;
    SteppedLoop::State next;
    try {
      const auto start = std::chrono::steady_clock::now();
      loop_->step(efforts);
      seconds_.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
      loop_->read(next);
      requireClosed(next);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& words) {
      out_.gave_up = words.what();
      return false;
    }
    const double of_motors = efforts.dot(next.q - is_.q), of_others = step / 2 * (is_.power + next.power);
    work_ += of_motors + of_others;
    out_.work += std::abs(of_motors) + std::abs(of_others);
    out_.away = larger(out_.away, (next.p - reference_.at(out_.steps * step + step).motion.p).norm());
    out_.sag = larger(out_.sag, sag(next.tree, engine_.manipulator()));
    is_ = next;
    ++out_.steps;
    return true;
  }

  const LoopEngine& engine_;
  EngineReference& reference_;
  std::unique_ptr<SteppedLoop> loop_;
  TimeSteppingResult out_;
  SteppedLoop::State is_;
  double work_ = 0;
  std::vector<double> seconds_;
};

using Instants = std::vector<EngineReference::Here>;

struct Scale {
  double torque = 0, force = 0, power = 0;

  double of(const Motor& motor) const {
    const double own = motor.slides() ? force : torque;
    return own > 0 ? own : std::max(torque, force);
  }
};

Scale scaleOf(const Instants& instants, const Motors& motors) {
  Scale out;
  for (const EngineReference::Here& here : instants) {
    for (std::size_t m = 0; m < motors.size(); ++m) {
      double& largest = motors[m].slides() ? out.force : out.torque;
      largest = std::max(largest, std::abs(here.efforts(static_cast<Eigen::Index>(m))));
    }
    out.power = std::max(out.power, std::abs(here.efforts.dot(here.q_dot)));
  }
  return out;
}

RecipeResult askBy(LoopEngine& engine, Recipe recipe, const Instants& instants, const Scale& scale) {
  const Motors& motors = engine.manipulator().motors();
  RecipeResult out;
  out.recipe = recipe;
  std::vector<double> seconds;
  for (const EngineReference::Here& here : instants) {
    const auto start = std::chrono::steady_clock::now();
    const Vector6d efforts = engine.efforts(recipe, here.motion);
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    const Vector6d off = efforts - here.efforts;
    for (int m = 0; m < motor_count; ++m)
      if (const double error = std::abs(off(m)) / scale.of(motors[static_cast<std::size_t>(m)]);
          exceeds(error, out.error)) {
        out.error = error;
        out.at = here.motion.t;
        out.motor = m;
      }
    if (const double power = std::abs(off.dot(here.q_dot)); exceeds(power, out.power)) out.power = power;
  }
  out.power = scale.power > 0 ? out.power / scale.power : std::numeric_limits<double>::quiet_NaN();
  out.seconds = median(seconds);
  return out;
}

std::vector<Recipe> recipesOf(const LoopEngineKind& kind) {
  std::vector<Recipe> out = {Recipe::exact, Recipe::open, Recipe::no_bias, Recipe::least_squares};
  if (kind.has_own_inverse) out.insert(out.end(), {Recipe::own_inverse, Recipe::own_inverse_hard});
  return out;
}

TimeSteppingResult moveInTime(const LoopEngine& engine, const Rigidity& rigidity, EngineReference& reference,
                              double moved) {
  const int steps = std::max(1, static_cast<int>(std::floor(moved / rigidity.step)));
  try {
    return MovedLoop(engine, rigidity, reference).move(steps);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& words) {  // the engine gave up before the first step
    TimeSteppingResult out;
    out.rigidity = rigidity;
    out.gave_up = words.what();
    out.gap = out.sag = out.away = out.energy = std::numeric_limits<double>::quiet_NaN();
    return out;
  }
}

/// Asks one engine after another and reports progress.
class Asking {
 public:
  Asking(const Scenario& scenario, const SideBySideOptions& options) : scenario_(scenario), reference_(scenario) {
    const double duration = scenario.trajectory->duration();
    for (int k = 0; k < options.samples; ++k) instants_.push_back(reference_.at(duration * k / (options.samples - 1)));
    scale_ = scaleOf(instants_, scenario.manipulator->motors());
    if (!(std::max(scale_.torque, scale_.force) > 0))
      throw std::runtime_error("the motion needs no efforts: there is nothing that errors could be related to");
    moved_ = std::min(options.moved, duration);
  }

  const Scale& scale() const { return scale_; }
  double moved() const { return moved_; }

  EngineResult ask(const LoopEngineKind& kind) {
    EngineResult out;
    out.kind = &kind;
    out.version = kind.version();
    try {
      const std::unique_ptr<LoopEngine> engine = kind.make(*scenario_.manipulator, scenario_.load);
      for (const EngineReference::Here& here : instants_)
        out.gap = larger(out.gap, largestGap(engine->tree(here.motion, LoopEngine::Bias::kept), engine->manipulator()));
      for (const Recipe recipe : recipesOf(kind)) out.recipes.push_back(askBy(*engine, recipe, instants_, scale_));
      for (const Rigidity& rigidity : engine->rigidities())
        out.in_time.push_back(moveInTime(*engine, rigidity, reference_, moved_));
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const PoseError&) {
      throw;
    } catch (const std::exception& words) {
      out.refused = words.what();
      out.recipes.clear();
      out.in_time.clear();
    }
    return out;
  }

 private:
  const Scenario& scenario_;
  EngineReference reference_;
  Instants instants_;
  Scale scale_;
  double moved_ = 0;
};

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
  std::vector<const LoopEngineKind*> asked;
  for (const LoopEngineKind& kind : loopEngines()) {
    const bool wanted = options.engines.empty() ||
                        std::find(options.engines.begin(), options.engines.end(), &kind) != options.engines.end();
    if (wanted) (kind.available() ? asked : out.missing).push_back(&kind);
  }
  Asking asking(scenario, options);
  out.scenario = scenario.name;
  out.instants = options.samples;
  const bool all_slide = allSlide(scenario.manipulator->motors());
  out.largest_effort = all_slide ? asking.scale().force : asking.scale().torque;
  out.unit = all_slide ? "N" : "N m";
  if (!all_slide) out.largest_force = asking.scale().force;
  out.moved = asking.moved();
  for (const LoopEngineKind* kind : asked) {
    if (options.on_progress)
      options.on_progress(static_cast<double>(out.engines.size()) / static_cast<double>(asked.size()), kind->name);
    out.engines.push_back(asking.ask(*kind));
  }
  return out;
}

}  // namespace ursula
