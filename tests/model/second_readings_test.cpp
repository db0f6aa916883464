// Compares the reader with a second one on all shipped scenarios, on random ones, and on scenarios misread in likely
// ways. A validation sees none of these errors, because every formulation gets the same wrong numbers.

#include <gtest/gtest.h>

#include <functional>

#include "studies/random/random_scenario.h"
#include "tests/base/temporary_folder.h"
#include "tests/model/second_reading/as_text.h"
#include "tests/model/second_reading/second_reading.h"
#include "tests/support/numbers.h"
#include "tests/validation/scenario_files.h"
#include "validation/subject/parameters.h"

namespace ursula {
namespace {

TEST(SecondReadings, findNothingInWhatShips) {
  ASSERT_GE(shippedScenarios().size(), 20u);
  for (const std::string& name : shippedScenarios()) {
    const Mismatches found = mismatchesOf(scenarioOf(name));
    EXPECT_EQ(found.count(), 0) << name << ": " << found.first();
    EXPECT_GT(found.compared(), 100) << name;
  }
}

/// The scenario with one non-zero parameter off by a rounding.
Scenario misreadByARounding(const Scenario& right, std::uint64_t seed) {
  const std::vector<Parameter> parameters = allParameters(*right.manipulator);
  ManipulatorParameters machine = right.manipulator->parameters();
  std::size_t k = seed * 17 % parameters.size();
  while (!parameters[k].turns() && parameters[k].get(machine) == 0) k = (k + 1) % parameters.size();
  parameters[k].disturb(machine, 2e-15);
  Scenario wrong = right;
  wrong.manipulator = std::make_shared<const Manipulator>(machine);
  return wrong;
}

class RandomReadings : public testing::TestWithParam<RandomKind> {};

TEST_P(RandomReadings, findNothingButWhatIsWrong) {
  const TemporaryFolder folder;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    const Scenario random = randomScenario(seed, GetParam());
    const Scenario read = parseScenario(asText(random, seed, folder.path()), folder.path() / "random.toml");
    const Mismatches found = mismatchesOf(read);
    EXPECT_EQ(found.count(), 0) << random.name << ": " << found.first() << "\n" << read.text;
    EXPECT_GT(found.compared(), 100) << random.name;
    EXPECT_EQ(read.trajectory->kind(), random.trajectory->kind());
    EXPECT_EQ(read.load != nullptr, random.load != nullptr);
    EXPECT_GT(mismatchesOf(misreadByARounding(read, seed)).count(), 0) << random.name;
    Scenario of_another_text = read;
    of_another_text.text = asText(randomScenario(seed + 1, GetParam()), seed, folder.path());
    EXPECT_GT(mismatchesOf(of_another_text).count(), 10) << random.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, RandomReadings,
                         testing::Values(RandomKind::URS, RandomKind::UPS, RandomKind::RUS, RandomKind::PUS,
                                         RandomKind::mixture, RandomKind::two_motors),
                         [](const auto& kind) { return asTestName(nameOf(kind.param)); });

// --- misread
// ----------------------------------------------------------------------------------------------------------

using Change = std::function<void(Scenario&)>;

Change machine(const std::function<void(ManipulatorParameters&)>& change) {
  return [change](Scenario& scenario) {
    ManipulatorParameters wrong = scenario.manipulator->parameters();
    change(wrong);
    scenario.manipulator = std::make_shared<const Manipulator>(wrong);
  };
}

Change poses(const std::function<void(std::vector<TimedPose>&)>& change) {
  return [change](Scenario& scenario) {
    std::vector<TimedPose> wrong = asWritten(scenario).trajectory.poses;
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
  Scenario scenario = scenarioOf("proving-ground");
  ASSERT_EQ(mismatchesOf(scenario).count(), 0);
  GetParam().change(scenario);
  EXPECT_GT(mismatchesOf(scenario).count(), 0);
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
