// Engines side by side: the exact recipe is right for every kind of leg, the usual calls are not, and the words match
// the findings.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "base/csv.h"
#include "parts/engines/side_by_side/side_by_side.h"
#include "report/text/quantity.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

Scenario shipped(const std::string& name) { return readScenario(URSULA_SCENARIOS "/" + name + ".toml"); }

const std::vector<const char*> every_kind = {"paper-helix", "flight-simulator", "hexa", "hexaglide", "mixture"};

std::vector<const LoopEngineKind*> enginesHere() {
  std::vector<const LoopEngineKind*> out;
  for (const LoopEngineKind& kind : loopEngines())
    if (kind.available()) out.push_back(&kind);
  return out;
}

SideBySide foundIn(const Scenario& scenario, double moved = 0.01) {
  SideBySideOptions options;
  options.samples = 7;
  options.moved = moved;
  return engineSideBySide(scenario, options);
}

TEST(Engines, exactRecipeIsRightAndTheObviousCallIsWrong) {
  std::set<LegKind> kinds;
  for (const char* name : every_kind) {
    const Scenario scenario = shipped(name);
    for (const Leg& leg : scenario.manipulator->parameters().legs) kinds.insert(leg.kind);
    const SideBySide found = foundIn(scenario);
    ASSERT_EQ(found.engines.size(), enginesHere().size());
    ASSERT_GE(found.engines.size(), 2u);
    EXPECT_GT(found.largest_effort, 0);
    for (const EngineResult& engine : found.engines) {
      SCOPED_TRACE(std::string(name) + ", " + engine.kind->name);
      ASSERT_EQ(engine.refused, "");
      EXPECT_LE(engine.of(Recipe::exact).error, 1e-12);
      EXPECT_LE(engine.of(Recipe::exact).power, 1e-11);
      EXPECT_LE(engine.gap, 1e-13);
      EXPECT_GT(engine.of(Recipe::open).error, 0.01);
      EXPECT_GT(engine.of(Recipe::least_squares).error, 0.01);
      EXPECT_GT(engine.of(Recipe::no_bias).error, 1e-6) << "wrong, and little where the motion is slow";
      if (engine.kind->has_own_inverse) {
        EXPECT_GT(engine.of(Recipe::own_inverse).error, 0.01);
        EXPECT_GT(engine.of(Recipe::own_inverse_hard).error, 1e-3) << "closures that leave out the rate of J";
        if (engine.kind->name == std::string("MuJoCo")) {
          EXPECT_GT(engine.of(Recipe::own_inverse_hard).error, 2 * engine.of(Recipe::own_inverse).error)
              << "harder loops make it worse: they take the rate of J for an error";
        }
      }
    }
  }
  EXPECT_EQ(kinds.size(), 4u);
}

bool movesNoRotors(const EngineResult& engine) { return engine.kind->name == std::string("DART"); }

/// Every engine has friction and a load; the load is in the platform's frame.
TEST(Engines, knowFrictionLoadAndRotors) {
  for (const char* name : {"ups-friction-load", "load-platform", "load-table", "viscous-friction", "three-legs"})
    for (const EngineResult& engine : foundIn(shipped(name)).engines) {
      ASSERT_EQ(engine.refused, "") << name << ", " << engine.kind->name;
      EXPECT_LE(engine.of(Recipe::exact).error, 1e-12) << name << ", " << engine.kind->name;
    }
  Scenario rotors = shipped("hexa");
  ManipulatorParameters machine = rotors.manipulator->parameters();
  for (Leg& leg : machine.legs) leg.rotor_inertia.phi = 2.0;
  const double without = foundIn(rotors).largest_effort;
  rotors.manipulator = std::make_shared<Manipulator>(machine);
  const SideBySide found = foundIn(rotors);
  EXPECT_GT(std::abs(found.largest_effort / without - 1), 0.01) << "rotors weigh in";
  for (const EngineResult& engine : found.engines) {
    ASSERT_EQ(engine.refused, "") << engine.kind->name;
    EXPECT_LE(engine.of(Recipe::exact).error, 1e-12) << engine.kind->name;
    for (const TimeSteppingResult& each : engine.in_time)
      EXPECT_EQ(each.gave_up, movesNoRotors(engine) ? engine.kind->name + std::string(" moves no rotors") : "");
  }
}

/// A thin rod has no inertia about its line, which is the axis of its first joint if all coordinates are zero.
TEST(Engines, areAskedWhereRodsAreThin) {
  Scenario thin = shipped("flight-simulator");
  ManipulatorParameters machine = thin.manipulator->parameters();
  for (Leg& leg : machine.legs) leg.proximal.inertia(2, 2) = leg.distal.inertia(2, 2) = 0;
  thin.manipulator = std::make_shared<Manipulator>(machine);
  for (const Scenario& scenario : {thin, shipped("free-rods")})
    for (const EngineResult& engine : foundIn(scenario).engines) {
      SCOPED_TRACE(scenario.name + ", " + engine.kind->name);
      ASSERT_EQ(engine.refused, "");
      EXPECT_LE(engine.of(Recipe::exact).error, 1e-12);
      if (engine.kind->has_own_inverse) {
        EXPECT_GT(engine.of(Recipe::own_inverse).error, 0.01);
      }
      for (const TimeSteppingResult& each : engine.in_time)
        EXPECT_EQ(each.gave_up, movesNoRotors(engine) && scenario.name == "free-rods"
                                    ? engine.kind->name + std::string(" moves no rotors")
                                    : "");
    }
}

/// A control: an engine with another machine must differ.
TEST(Engines, seeWhereAMachineIsAnother) {
  const Scenario scenario = shipped("flight-simulator");
  ManipulatorParameters other = scenario.manipulator->parameters();
  other.platform.mass *= 1 + 1e-6;
  EngineReference reference(scenario);
  const EngineReference::Here here = reference.at(1);
  for (const LoopEngineKind* kind : enginesHere()) {
    const Vector6d wrong = kind->make(Manipulator(other), scenario.load)->efforts(Recipe::exact, here.motion);
    EXPECT_GT((wrong - here.efforts).norm() / here.efforts.norm(), 1e-9) << kind->name;
  }
}

/// Jacobians and forces of the legs as trees are the same for any engine, in axes of B.
TEST(Engines, agreeOnTheLegsAlone) {
  for (const char* name : every_kind) {
    const Scenario scenario = shipped(name);
    const Motion<double> motion = scenario.trajectory->at(0.3 * scenario.trajectory->duration());
    const auto engines = enginesHere();
    const std::unique_ptr<LoopEngine> first = engines[0]->make(*scenario.manipulator, scenario.load);
    const PlacedTree one = first->tree(motion, LoopEngine::Bias::kept);
    for (const LoopEngineKind* kind : engines) {
      const std::unique_ptr<LoopEngine> engine = kind->make(*scenario.manipulator, scenario.load);
      const PlacedTree& two = engine->tree(motion, LoopEngine::Bias::kept);
      for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_GT(one.legs[i].J.norm(), 0.1);
        EXPECT_LE((one.legs[i].J - two.legs[i].J).norm(), 1e-12 * one.legs[i].J.norm())
            << name << ", " << kind->name << ", leg " << i + 1;
        EXPECT_LE((one.legs[i].force - two.legs[i].force).norm(), 1e-11 * one.legs[i].force.norm())
            << name << ", " << kind->name << ", leg " << i + 1;
      }
    }
  }
}

/// Each leg's point moves along its motor's axis, so the platform must follow as these motors would move it.
TEST(Engines, sagIsWhereTheMotorsHoldThePlatform) {
  const Scenario scenario = shipped("flight-simulator");
  const Motion<double> motion = scenario.trajectory->at(0);
  const std::unique_ptr<LoopEngine> engine = loopEngines()[0].make(*scenario.manipulator, nullptr);
  PlacedTree tree = engine->tree(motion, LoopEngine::Bias::kept);
  EXPECT_LE(sag(tree, *scenario.manipulator), 1e-12);
  const double off = 1e-6;
  for (int i = 0; i < 6; ++i) {
    const Leg& leg = scenario.manipulator->leg(i);
    const Vector3d along = motion.p + motion.Q * leg.platform_point - leg.base_point;
    tree.gaps[static_cast<std::size_t>(i)] = along.normalized() * along.normalized().z() * off;
  }
  // These longer lengths are exactly those of a lift by `off`.
  EXPECT_NEAR(sag(tree, *scenario.manipulator), off, 1e-12);
  EXPECT_LE(largestGap(tree, *scenario.manipulator), off);
}

const TimeSteppingResult& named(const EngineResult& engine, const std::string& rigidity) {
  const auto found = std::find_if(engine.in_time.begin(), engine.in_time.end(),
                                  [&](const TimeSteppingResult& each) { return each.rigidity.name == rigidity; });
  if (found == engine.in_time.end()) throw std::logic_error(rigidity);
  return *found;
}

TEST(Engines, looserLoopsSagFarther) {
  for (const EngineResult& engine : foundIn(shipped("flight-simulator"), 0.2).engines) {
    SCOPED_TRACE(engine.kind->name);
    for (const TimeSteppingResult& each : engine.in_time) {
      EXPECT_EQ(each.gave_up, "");
      EXPECT_EQ(each.steps, static_cast<int>(std::floor(0.2 / each.rigidity.step)));
      EXPECT_GT(each.gap, 0);
      EXPECT_GT(each.sag, 0);
      EXPECT_GT(each.work, 0);
      EXPECT_LT(each.energy, 1e-3 * each.work) << each.rigidity.name << ": energy is lost, never made";
      EXPECT_LT(each.away, 1e-3) << each.rigidity.name;
    }
    if (engine.kind->name == std::string("MuJoCo")) {
      EXPECT_GT(named(engine, "default").gap, 100 * named(engine, "both").gap);
      EXPECT_GT(named(engine, "default").sag, 100 * named(engine, "both").sag);
      EXPECT_GT(named(engine, "default").sag, 1e-4) << "which anybody sees";
    }
    if (engine.kind->name == std::string("Simbody")) {
      EXPECT_LT(named(engine, "default").sag, 1e-12);
      EXPECT_LT(std::abs(named(engine, "default").energy), 1e-9 * named(engine, "default").work);
    }
    if (engine.kind->name == std::string("DART")) {
      EXPECT_GT(named(engine, "default").gap, 10 * named(engine, "all of the error a step").gap);
    }
  }
}

/// DART's constraint solver would end the process for a machine of grams if it got kilograms.
TEST(Engines, smallMachinesAndLightLegsAreMovedOrGivenUp) {
  bool gave_up = false;
  for (const char* name : {"millimetres", "light-legs"})
    for (const EngineResult& engine : foundIn(shipped(name), 0.1).engines) {
      ASSERT_EQ(engine.refused, "") << engine.kind->name;
      for (const TimeSteppingResult& each : engine.in_time) {
        EXPECT_GT(each.gap, 0) << name << ", " << engine.kind->name << ", " << each.rigidity.name;
        if (each.gave_up.empty()) {
          EXPECT_TRUE(std::isfinite(each.sag + each.away + each.energy)) << name << ", " << engine.kind->name;
        } else {
          gave_up = true;
          EXPECT_THAT(each.gave_up,
                      testing::AnyOf(HasSubstr("a loop is open by"), HasSubstr("unstable"), HasSubstr("not finite")));
          EXPECT_LT(each.steps, std::floor(0.1 / each.rigidity.step));
        }
      }
    }
  if (loopEngineNamed("mujoco")->available()) {
    EXPECT_TRUE(gave_up) << "default softness is too much for light legs";
  }
}

TEST(Engines, sentencesSayTheNumbersFound) {
  const SideBySide found = foundIn(shipped("hexaglide"));
  for (const EngineResult& engine : found.engines) {
    const std::string said = sentence(engine);
    EXPECT_THAT(said, HasSubstr(engine.kind->exact_call));
    EXPECT_THAT(said, HasSubstr(report::plainNumber(engine.of(Recipe::exact).error, 2) + " of the largest effort"));
    EXPECT_THAT(said, HasSubstr(report::plainNumber(100 * engine.of(engine.kind->obvious).error, 3) + " %"));
    if (engine.kind->has_own_inverse) {
      const double hard = engine.of(Recipe::own_inverse_hard).error;
      ASSERT_GT(hard, 10);
      EXPECT_THAT(said, HasSubstr("hardest by " + report::plainNumber(hard, 3) + " times"));
    }
    EngineResult other = engine;
    for (RecipeResult& each : other.recipes) each.error *= 2;
    EXPECT_THAT(sentence(other), Not(testing::StrEq(said)));
    const std::string page = sideBySideHtml(found);
    EXPECT_THAT(page, HasSubstr(engine.kind->name));
    EXPECT_THAT(page, HasSubstr(report::plainNumber(100 * engine.of(Recipe::open).error, 3) + " %"));
    EXPECT_THAT(page, Not(HasSubstr("https://")));
  }
}

TEST(Engines, aCallThatIsRightOnAMotionIsNotCalledWrong) {
  const SideBySide found = foundIn(shipped("hold"));
  int as_good = 0;
  for (const EngineResult& engine : found.engines) {
    const bool is_good = engine.of(engine.kind->obvious).error < 1e-12;
    EXPECT_EQ(sentence(engine).find("is as good") != std::string::npos, is_good) << engine.kind->name;
    as_good += is_good;
  }
  EXPECT_EQ(as_good, 1) << "at rest nothing is lost with the rate of J";
  EXPECT_THAT(sentence(found), Not(HasSubstr("e-"))) << "engines that have users are all wrong";
}

TEST(Engines, errorsAreSharesOfTheLargestEffortOfTheirUnit) {
  const SideBySide found = foundIn(shipped("mixture"));
  EXPECT_EQ(found.unit, "N m");
  EXPECT_GT(found.largest_force, 0);
  EXPECT_THAT(largestText(found), HasSubstr(" and "));
  EXPECT_EQ(foundIn(shipped("hexaglide")).largest_force, 0);
}

TEST(Engines, sayWhatIsMissingOrRefused) {
  for (const LoopEngineKind& kind : loopEngines())
    if (*kind.package != '\0') {
      EXPECT_THAT(sentenceOfMissing(kind), HasSubstr(kind.name));
      EXPECT_THAT(sentenceOfMissing(kind), HasSubstr("apt install " + std::string(kind.package)));
    }
  SideBySide found = foundIn(shipped("hexaglide"));
  found.engines.resize(1);
  found.engines[0].recipes.clear();
  found.engines[0].in_time.clear();
  found.engines[0].refused = "a reason";
  found.missing = {&loopEngines().back()};
  EXPECT_THAT(sideBySideText(found), HasSubstr("cannot be asked: a reason"));
  EXPECT_THAT(sideBySideText(found), HasSubstr(sentenceOfMissing(loopEngines().back())));
  const auto json = nlohmann::json::parse(sideBySideJson(found));
  EXPECT_EQ(json.at("engines").at(0).at("refused"), "a reason");
  EXPECT_EQ(json.at("missing").at(0).at("package"), loopEngines().back().package);
}

TEST(Engines, writeTheSameAsJsonAndCsv) {
  const SideBySide found = foundIn(shipped("hexaglide"));
  const auto json = nlohmann::json::parse(sideBySideJson(found));
  ASSERT_EQ(json.at("engines").size(), found.engines.size());
  std::size_t rows = 0;
  for (std::size_t k = 0; k < found.engines.size(); ++k) {
    const auto& engine = json.at("engines").at(k);
    EXPECT_EQ(engine.at("sentence"), sentence(found.engines[k]));
    EXPECT_EQ(engine.at("efforts").at(0).at("recipe"), "exact");
    EXPECT_EQ(engine.at("efforts").at(0).at("error").get<double>(), found.engines[k].of(Recipe::exact).error);
    rows += found.engines[k].recipes.size() + found.engines[k].in_time.size();
  }
  const std::string csv = sideBySideCsv(found);
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')), rows + 1);
  std::size_t commas = 0;
  for (std::size_t from = 0, to = 0; (to = csv.find('\n', from)) != std::string::npos; from = to + 1) {
    const auto here = static_cast<std::size_t>(std::count(csv.begin() + static_cast<std::ptrdiff_t>(from),
                                                          csv.begin() + static_cast<std::ptrdiff_t>(to), ','));
    if (from == 0) commas = here;
    EXPECT_EQ(here, commas) << csv.substr(from, to - from);
  }
}

TEST(Engines, refuseAMotionWithoutEfforts) {
  Scenario still = shipped("hold");
  ManipulatorParameters machine = still.manipulator->parameters();
  machine.gravity.setZero();
  still.manipulator = std::make_shared<Manipulator>(machine);
  EXPECT_THROW(foundIn(still), std::runtime_error);
}

}  // namespace
}  // namespace ursula
