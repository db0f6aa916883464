// Scenarios that other code than the reader's wrote come back with the numbers that they were written with. A
// validation sees no error of the reader, because every formulation gets the same wrong numbers.

#include "tests/model/as_text.h"
#include "tests/support/changed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>

#include "base/real50.h"
#include "model/exact_trajectory.h"
#include "model/scenario_keys.h"
#include "model/trajectories/trajectories.h"
#include "parts/random/random_scenario.h"
#include "tests/base/temporary_folder.h"
#include "tests/support/numbers.h"
#include "tests/support/vectors.h"
#include "validation/subject/parameters.h"

namespace ursula {
namespace {

bool same(const Link& a, const Link& b) {
  return a.length == b.length && a.mass == b.mass && a.center_of_mass == b.center_of_mass && a.off_line == b.off_line &&
         a.inertia == b.inertia;
}

/// The first number that differs, "" if none does. Numbers that no effort depends on are among the links'.
std::string difference(const ManipulatorParameters& read, const ManipulatorParameters& stated) {
  if (read.legs.size() != stated.legs.size()) return "the number of legs";
  for (std::size_t i = 0; i < read.legs.size(); ++i)
    if (read.legs[i].kind != stated.legs[i].kind || read.legs[i].actuated != stated.legs[i].actuated)
      return fmt::format("the kind or motors of leg {}", i + 1);
  std::vector<MachineNumber> numbers = machineNumbers(stated);
  if (numbers.size() != machineNumbers(read).size()) return "which numbers there are";
  for (const MachineNumber& number : numbers)
    if (number.get(read) != number.get(stated)) return number.path;
  for (std::size_t i = 0; i < read.legs.size(); ++i) {
    const Leg &a = read.legs[i], &b = stated.legs[i];
    if (a.knee != b.knee || a.spins != b.spins || !same(a.proximal, b.proximal) || !same(a.distal, b.distal))
      return fmt::format("the knee, spin or links of leg {}", i + 1);
  }
  return "";
}

/// In 50 digits the motion shows every bit of its numbers; the orientation may be off by `turn`.
std::string difference(const Trajectory& read, const Trajectory& stated, double turn) {
  if (read.kind() != stated.kind()) return "trajectory.kind";
  if (read.duration() != stated.duration() || read.knots() != stated.knots()) return "the trajectory's instants";
  const auto apart = [turn](const auto& a, const auto& b) {
    return a.p != b.p || !(static_cast<double>((a.Q - b.Q).norm()) <= turn);
  };
  for (const double t : stated.knots())
    if (apart(read.at(t), stated.at(t))) return fmt::format("the pose at {} s", t);
  for (const double share : {0.0, 0.28, 0.77, 1.0}) {
    const Real50 t = Real50(share) * stated.duration();
    if (apart(read.at(t), stated.at(t))) return fmt::format("the pose at {} of the motion", share);
  }
  return "";
}

std::string difference(const Load* read, const Load* stated) {
  if ((read == nullptr) != (stated == nullptr)) return "load";
  if (read == nullptr) return "";
  if (read->point != stated->point || read->frame != stated->frame) return "the load's point or frame";
  if ((read->history == nullptr) != (stated->history == nullptr)) return "the load's table";
  if (!read->history) return read->force == stated->force && read->moment == stated->moment ? "" : "the load's wrench";
  const std::vector<TimedWrench>&a = read->history->rows(), &b = stated->history->rows();
  if (a.size() != b.size()) return "the load's number of rows";
  for (std::size_t k = 0; k < a.size(); ++k)
    if (a[k].time != b[k].time || a[k].wrench.force != b[k].wrench.force || a[k].wrench.moment != b[k].wrench.moment)
      return fmt::format("the load's row {}", k + 1);
  return "";
}

/// Entries of a matrix take some products of sines and cosines that are each off by a rounding.
constexpr double turn_by_degrees = 16 * eps;

std::string difference(const Scenario& read, const Scenario& stated, bool in_degrees = false) {
  std::string out = difference(read.manipulator->given(), stated.manipulator->given());
  if (out.empty()) out = difference(*read.trajectory, *stated.trajectory, in_degrees ? turn_by_degrees : 0);
  return out.empty() ? difference(read.load.get(), stated.load.get()) : out;
}

/// Reads what asText writes, and expects that nothing differs. Returns the text.
std::string expectSame(const Scenario& scenario, std::uint64_t seed, const TemporaryFolder& folder) {
  const WrittenScenario written = asText(scenario, seed, folder.path());
  const Scenario read = parseScenario(written.text, folder.path() / "written.toml");
  EXPECT_EQ(difference(read, written.states, written.in_degrees), "") << scenario.name << "\n" << written.text;
  return written.text;
}

bool isWritten(const std::string& key, const std::string& text) {
  const auto has = [&](const std::string& part) { return text.find(part) != std::string::npos; };
  return has(" " + key + " =") || has("\n" + key + " =") || has("." + key + "]");
}

TEST(ScenarioAsText, hasTheNumbersOfWhatShips) {
  const TemporaryFolder folder;
  std::string all;
  ASSERT_GE(shippedScenarios().size(), 20u);
  for (const std::string& name : shippedScenarios())
    for (std::uint64_t seed = 1; seed <= 12; ++seed) all += expectSame(scenarioOf(name), seed, folder);
  int keys = 0;  // every key of a machine, a motion and a load was written
  for (const ScenarioTable& table : scenarioTables()) {
    if (std::string("mtl").find(table.name[0]) == std::string::npos) continue;
    for (const ScenarioKey& key : table.keys) {
      if (key.name == std::string("legs")) continue;  // written as links of no mass
      EXPECT_TRUE(isWritten(key.name, all)) << table.name << ": " << key.name;
      ++keys;
    }
  }
  EXPECT_GT(keys, 50);
}

/// The scenario with one non-zero parameter off by a rounding.
Scenario misreadByARounding(const Scenario& right, std::size_t k) {
  const std::vector<Parameter> parameters = allParameters(*right.manipulator);
  ManipulatorParameters machine = right.manipulator->parameters();
  k %= parameters.size();
  while (!parameters[k].turns && parameters[k].get(machine) == 0) k = (k + 1) % parameters.size();
  parameters[k].disturb(machine, 2e-15);
  return changed(right, [&](auto& wrong) { wrong = machine; });
}

class RandomAsText : public testing::TestWithParam<RandomKind> {};

TEST_P(RandomAsText, hasItsNumbers) {
  const TemporaryFolder folder;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    const Scenario random = randomScenario(seed, GetParam());
    expectSame(random, seed, folder);
    EXPECT_NE(difference(misreadByARounding(random, seed * 17), random), "") << random.name;
    EXPECT_NE(difference(randomScenario(seed + 1, GetParam()), random), "") << random.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, RandomAsText,
                         testing::Values(RandomKind::URS, RandomKind::UPS, RandomKind::RUS, RandomKind::PUS,
                                         RandomKind::mixture, RandomKind::two_motors),
                         [](const auto& kind) { return asTestName(nameOf(kind.param)); });

TEST(Difference, isSeenInEveryParameterAndEveryNumberOfAHelix) {
  const Scenario right = scenarioOf("proving-ground");  // no parameter is zero
  const std::size_t parameters = allParameters(*right.manipulator).size();
  for (std::size_t k = 0; k < parameters; ++k) EXPECT_NE(difference(misreadByARounding(right, k), right), "") << k;
  HelixParameters helix;
  helix.radius = 0.2, helix.pitch = 1.2, helix.start_angle = -1.5, helix.end_angle = -1;
  for (double HelixParameters::*number :
       {&HelixParameters::duration, &HelixParameters::radius, &HelixParameters::pitch, &HelixParameters::start_angle,
        &HelixParameters::end_angle, &HelixParameters::phase, &HelixParameters::height_phase,
        &HelixParameters::start_rate, &HelixParameters::end_rate, &HelixParameters::start_acceleration,
        &HelixParameters::end_acceleration}) {
    HelixParameters wrong = helix;
    wrong.*number = wrong.*number * (1 + 1e-15) + (wrong.*number == 0 ? 1e-15 : 0);
    EXPECT_NE(difference(*makeHelix(wrong), *makeHelix(helix), 0), "");
  }
}

using Change = std::function<void(Scenario&)>;

Change machine(const std::function<void(ManipulatorParameters&)>& change) {
  return [change](Scenario& scenario) { scenario = changed(scenario, change); };
}

Change poses(const std::function<void(std::vector<TimedPose>&)>& change) {
  return [change](Scenario& scenario) {
    std::vector<TimedPose> wrong;
    for (const double t : scenario.trajectory->knots()) {
      const Motion<double> motion = scenario.trajectory->at(t);
      const Eigen::Quaterniond q(motion.Q);
      wrong.push_back({t, motion.p, {q.w(), q.x(), q.y(), q.z()}});
    }
    change(wrong);
    scenario.trajectory = makeWaypoints(wrong);
  };
}

Change load(const std::function<void(Load&)>& change) {
  return [change](Scenario& scenario) {
    auto wrong = std::make_shared<Load>(*scenario.load);
    change(*wrong);
    scenario.load = wrong;
  };
}

Change rows(const std::function<void(std::vector<TimedWrench>&)>& change) {
  return load([change](Load& wrong) {
    std::vector<TimedWrench> changed = wrong.history->rows();
    change(changed);
    wrong.history = std::make_shared<const LoadHistory>(changed);
  });
}

void swapProducts(Matrix3d& inertia, int a, int b, int c, int d) {
  std::swap(inertia(a, b), inertia(c, d));
  std::swap(inertia(b, a), inertia(d, c));
}

void addRowBetween(std::vector<TimedWrench>& rows) {
  TimedWrench row{(rows[0].time + rows[1].time) / 2, {}};
  row.wrench.force = (rows[0].wrench.force + rows[1].wrench.force) / 2;
  row.wrench.moment = (rows[0].wrench.moment + rows[1].wrench.moment) / 2;
  rows.insert(rows.begin() + 1, row);
}

struct Misread {
  const char* name;
  Change change;
};

class MisreadScenario : public testing::TestWithParam<Misread> {};

TEST_P(MisreadScenario, isSeen) {
  const Scenario right = scenarioOf("proving-ground");
  Scenario wrong = right;
  GetParam().change(wrong);
  EXPECT_NE(difference(wrong, right, true), "");
}

INSTANTIATE_TEST_SUITE_P(
    By, MisreadScenario,
    testing::Values(
        Misread{"products_of_the_platform", machine([](auto& m) { swapProducts(m.platform.inertia, 0, 2, 1, 2); })},
        Misread{"products_of_a_link", machine([](auto& m) { swapProducts(m.legs[1].distal.inertia, 0, 1, 0, 2); })},
        Misread{"a_number_by_1e_15", machine([](auto& m) { m.legs[3].base_point.y() *= 1 + 4 * eps; })},
        Misread{"a_number_in_its_last_bit", machine([](auto& m) { m.legs[0].coulomb.theta *= 1 + eps; })},
        Misread{"axes_normalised", machine([](auto& m) {
                  for (auto& leg : m.legs) leg.base_axis.normalize();
                })},
        Misread{"smoothing_speed_not_read", machine([](auto& m) { m.legs[5].coulomb.smoothing_speed = 0.01; })},
        Misread{"single_precision",
                machine([](auto& m) { m.platform.mass = static_cast<double>(static_cast<float>(m.platform.mass)); })},
        Misread{"legs_exchanged", machine([](auto& m) { std::swap(m.legs[0], m.legs[1]); })},
        Misread{"quaternions_as_x_y_z_w", poses([](auto& p) {
                  for (TimedPose& pose : p) {
                    const Eigen::Vector4d q = pose.orientation;
                    pose.orientation << q(3), q(0), q(1), q(2);
                  }
                })},
        Misread{"quaternions_the_other_way_round", poses([](auto& p) {
                  for (TimedPose& pose : p) pose.orientation.template tail<3>() *= -1;
                })},
        Misread{"a_waypoints_time", poses([](auto& p) { p[1].time *= 1 + 4 * eps; })},
        Misread{"load_late", rows([](auto& r) {
                  for (TimedWrench& row : r) row.time += 1e-6;
                })},
        Misread{"moment_about_the_mass_centre", rows([](auto& r) {
                  for (TimedWrench& row : r) row.wrench.moment += Vector3d(0.1, 0.2, 0.3).cross(row.wrench.force);
                })},
        Misread{"force_and_moment_exchanged", rows([](auto& r) {
                  for (TimedWrench& row : r) std::swap(row.wrench.force, row.wrench.moment);
                })},
        Misread{"a_row_by_1e_15", rows([](auto& r) { r[1].wrench.force.z() *= 1 + 4 * eps; })},
        Misread{"a_row_more", rows(addRowBetween)}, Misread{"load_in_the_other_frame", load([](Load& l) {
                                                              l.frame = l.frame == Load::Frame::base
                                                                            ? Load::Frame::platform
                                                                            : Load::Frame::base;
                                                            })},
        Misread{"load_not_read", [](Scenario& s) { s.load = nullptr; }},
        Misread{"load_point_not_read", load([](Load& l) { l.point.setZero(); })}),
    [](const auto& misread) { return std::string(misread.param.name); });

}  // namespace
}  // namespace ursula
