// A sampled motion: derivatives against differences in 50 digits, exact reproduction of a quintic, the order on the
// helix, and refusals with the CSV's line.

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

#include "base/real50.h"
#include "model/columns.h"
#include "model/trajectories/trajectories.h"
#include "tests/model/derivatives.h"
#include "tests/model/refusals.h"
#include "tests/support/matchers.h"
#include "tests/support/numbers.h"

namespace ursula {
namespace {

using testing::FieldsAre;

std::unique_ptr<Trajectory> helixTrajectory() {
  HelixParameters helix;
  helix.radius = 0.2;
  helix.pitch = 1.2;
  helix.start_angle = -1.5707963267948966;
  helix.end_angle = -1.0471975511965976;
  helix.height_phase = 2.2;
  return makeHelix(helix);
}

std::vector<TimedPose> sampled(const Trajectory& motion, int count) {
  std::vector<TimedPose> samples;
  for (int i = 0; i < count; ++i) {
    const double t = motion.duration() * i / (count - 1);
    const Motion<double> now = motion.at(t);
    const Eigen::Quaterniond q(now.Q);
    samples.push_back({t, now.p, {q.w(), q.x(), q.y(), q.z()}});
  }
  return samples;
}

CsvTable tableOf(const std::vector<TimedPose>& samples) {
  std::vector<std::vector<double>> columns(8);
  for (const TimedPose& sample : samples) {
    columns[0].push_back(sample.time);
    for (std::size_t k = 0; k < 3; ++k) columns[1 + k].push_back(sample.position(static_cast<Eigen::Index>(k)));
    for (std::size_t k = 0; k < 4; ++k) columns[4 + k].push_back(sample.orientation(static_cast<Eigen::Index>(k)));
  }
  return parseCsv(csvText({"t_s", "p_x_m", "p_y_m", "p_z_m", "q_w", "q_x", "q_y", "q_z"}, columns), "pose.csv");
}

TEST(Samples, haveExactDerivativesAtKnotsAndBetween) {
  const auto motion = makeSamples(sampled(*helixTrajectory(), 31));
  std::vector<double> instants = instantsInside(3.0, 60);
  for (int i = 0; i <= 30; ++i) instants.push_back(0.1 * i);
  EXPECT_LE(derivativeMismatch(*motion, instants).worst(), difference_tolerance);
  EXPECT_GT(motion->at(1.5).omega.norm(), 0.1);
  EXPECT_GT(derivativeMismatch(Falsified(*motion, Falsified::Part::omega_dot, 1e-15), instants).worst(), 5e-16);
}

TEST(Samples, passThroughEverySample) {
  const std::vector<TimedPose> samples = sampled(*helixTrajectory(), 31);
  const auto motion = makeSamples(samples);
  EXPECT_EQ(motion->kind(), "samples");
  EXPECT_EQ(motion->duration(), 3.0);
  for (const TimedPose& sample : samples) {
    const Motion<double> now = motion->at(sample.time);
    EXPECT_LE((now.p - sample.position).norm(), 16 * eps);
    const Eigen::Vector4d& q = sample.orientation;
    EXPECT_LE((now.Q - Eigen::Quaterniond(q(0), q(1), q(2), q(3)).toRotationMatrix()).norm(), 32 * eps);
  }
}

TEST(Samples, haveNoJumpInTheAccelerationsAtTheKnots) {
  const auto motion = makeSamples(sampled(*helixTrajectory(), 31));
  for (int i = 1; i < 30; ++i) {
    const Real50 t(0.1 * i), h("1e-30");
    const Motion<Real50> before = motion->at(Real50(t - h)), after = motion->at(Real50(t + h));
    EXPECT_LE((before.p_ddot - after.p_ddot).norm().convert_to<double>(), 1e-26);
    EXPECT_LE((before.omega_dot - after.omega_dot).norm().convert_to<double>(), 1e-26);
  }
}

TEST(Samples, giveAQuinticBackHoweverUnevenTheTimes) {
  std::mt19937 random(20240607);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto polynomial = [](double t) { return 0.3 + t * (-0.5 + t * (0.2 + t * (0.7 + t * (-0.4 + 0.1 * t)))); };
  const auto second = [](double t) { return 0.4 + t * (4.2 + t * (-4.8 + 2.0 * t)); };
  std::vector<TimedPose> samples;
  for (int i = 0; i < 12; ++i) {
    const double t = i == 0 ? 0 : 0.2 * (i + 0.3 * unit(random));
    samples.push_back({t, {polynomial(t), 0, 1}, {1, 0, 0, 0}});
  }
  const auto motion = makeSamples(samples);
  for (const double t : instantsInside(motion->duration(), 50)) {
    // Values rounded to eps/2 are differentiated twice over steps of at least 0.14 s, which gives 16 / 0.14² roundings.
    EXPECT_NEAR(motion->at(t).p_ddot.x(), second(t), 1000 * eps * 40);
    EXPECT_NEAR(motion->at(t).p.x(), polynomial(t), 32 * eps);
  }
}

TEST(Samples, convergeOnTheHelixWithTheStepToTheFourth) {
  const auto helix = helixTrajectory();
  const auto error = [&](int count) {
    const auto motion = makeSamples(sampled(*helix, count));
    double worst = 0;
    for (const double t : instantsInside(3.0, 400)) {
      worst = std::max(worst, (motion->at(t).p_ddot - helix->at(t).p_ddot).norm());
      worst = std::max(worst, (motion->at(t).omega_dot - helix->at(t).omega_dot).norm());
    }
    return worst;
  };
  const double coarse = error(151), fine = error(301);
  EXPECT_LE(fine, 1e-7);
  EXPECT_GE(std::log2(coarse / fine), 3.5) << coarse << " " << fine;
}

TEST(Samples, fromATableAreThoseFromMemory) {
  const std::vector<TimedPose> samples = sampled(*helixTrajectory(), 11);
  const auto direct = makeSamples(samples), read = makeSamples(tableOf(samples));
  for (const double t : instantsInside(3.0, 7)) {
    EXPECT_EQ(direct->at(t).p, read->at(t).p);
    EXPECT_EQ(direct->at(t).omega_dot, read->at(t).omega_dot);
  }
}

TEST(Samples, ignoreOtherColumns) {
  CsvTable table = tableOf(sampled(*helixTrajectory(), 11));
  table.names.push_back("v_x_m_s");
  table.columns.push_back(std::vector<double>(11, 99.0));
  EXPECT_EQ(makeSamples(table)->at(1.0).p_dot, makeSamples(sampled(*helixTrajectory(), 11))->at(1.0).p_dot);
}

TEST(Samples, fromMemoryRefuseWithTheSample) {
  std::vector<TimedPose> samples = sampled(*helixTrajectory(), 11);
  samples[4].orientation *= 1 + 2e-6;
  EXPECT_THAT(refusedParameter([&] { makeSamples(samples); }),
              FieldsAre("trajectory.samples[5].orientation", HasSubstr("norm 1.000002"), "1 within 1e-06"));
  samples.resize(5);
  EXPECT_THAT(refusedParameter([&] { makeSamples(samples); }), FieldsAre("trajectory.samples", "5 poses", ">= 6"));
}

TEST(Samples, withinTheirLooserLengthAreNormalised) {
  std::vector<TimedPose> samples = sampled(*helixTrajectory(), 11);
  samples[4].orientation *= 1 + 0.9e-6;
  EXPECT_LE(orthonormalityError(makeSamples(samples)->at(1.2).Q), 16 * eps);
}

TEST(Samples, fromATableRefuseWithTheLine) {
  const std::vector<TimedPose> good = sampled(*helixTrajectory(), 11);
  const auto refused = [&](auto fault) {
    std::vector<TimedPose> samples = good;
    fault(samples);
    return refusal<CsvError>([&] { makeSamples(tableOf(samples)); });
  };
  EXPECT_THAT(refused([](auto& s) { s[3].time = s[2].time; }),
              StartsWith("pose.csv:5: error: time: 0.6, expected > 0.6"));
  EXPECT_THAT(refused([](auto& s) { s[0].time = -0.1; }), StartsWith("pose.csv:2: error: time: -0.1, expected 0,"));
  EXPECT_THAT(refused([](auto& s) { s[9].orientation *= 0.9; }), StartsWith("pose.csv:11: error: orientation: "));
  EXPECT_THAT(refused([](auto& s) { s.resize(5); }), StartsWith("pose.csv:2: error: 5 poses, expected >= 6"));
  EXPECT_THAT(refused([](auto& s) {
                s[6].orientation = {0, 1, 0, 0};
              }),
              HasSubstr("pose.csv:8: error: orientation: turned by"));
}

TEST(Samples, nameAMissingColumn) {
  CsvTable table = tableOf(sampled(*helixTrajectory(), 11));
  table.names[2] = "p_yy_m";
  EXPECT_EQ(refusal<CsvError>([&] { makeSamples(table); }),
            "pose.csv:1: error: missing column 'p_y_m', expected it in the header, did you mean 'p_yy_m'?");
}

/// Writes a motion in other columns, and reads it by their meaning.
CsvTable readFrom(const std::string& text, bool loads = false) {
  const auto file = std::filesystem::path(testing::TempDir()) / "by_meaning.csv";
  std::ofstream(file) << text;
  return readByMeaning(file, loads);
}

TEST(Columns, ofAMotionAreReadInTheirUnits) {
  const CsvTable table = readFrom(
      "time [ms];surge_mm;p_y_mm;heave;roll_deg;pitch_deg;yaw_rad;who\n0;1;2;3;90;0;0;a\n70;1;2;3;0;0;0,5;b\n");
  EXPECT_EQ(table.at("t_s"), (std::vector<double>{0, 0.07})) << "the nearest doubles";
  EXPECT_EQ(table.at("p_x_m").front(), 0.001);
  EXPECT_EQ(table.at("p_z_m").front(), 3);
  EXPECT_NEAR(table.at("q_x").front(), std::sqrt(0.5), eps);
  EXPECT_NEAR(table.at("q_z").back(), std::sin(0.25), eps);
  EXPECT_EQ(table.find("who"), nullptr);
}

TEST(Columns, byTheContractAreTakenAsTheyStand) {
  const std::string text = "t_s,p_x_m,p_y_m,p_z_m,q_w,q_x,q_y,q_z,t_ms,v_x_m_s\n0.1,1,2,3,1,0,0,0,7,8\n";
  EXPECT_EQ(readFrom(text).at("t_s").front(), 0.1);
  EXPECT_EQ(meaningInWords(std::filesystem::path(testing::TempDir()) / "by_meaning.csv", false),
            "not used beside them: 't_ms'");
  readFrom("t_s,p_x_m,p_y_m,p_z_m,q_w,q_x,q_y,q_z,roll_deg,pitch_deg,yaw_deg\n0.1,1,2,3,1,0,0,0,9,9,9\n");
  EXPECT_EQ(meaningInWords(std::filesystem::path(testing::TempDir()) / "by_meaning.csv", false),
            "not used beside them: 'roll_deg', 'pitch_deg', 'yaw_deg'");
  readFrom("t_s,p_x_m,p_y_m,p_z_m,q_w,q_x,q_y,q_z,v_x_m_s\n0.1,1,2,3,1,0,0,0,8\n");
  EXPECT_EQ(meaningInWords(std::filesystem::path(testing::TempDir()) / "by_meaning.csv", false), "");
  readFrom("t_ms,p_x_m,p_y_m,p_z_m,q_w,q_x,q_y,q_z\n0.1,1,2,3,1,0,0,0\n");
  EXPECT_EQ(meaningInWords(std::filesystem::path(testing::TempDir()) / "by_meaning.csv", false), "'t_ms' time × 0.001");
}

TEST(Columns, areRefusedWhereTheyAreDoubtful) {
  const auto refused = [](const std::string& text, bool loads = false) {
    return refusal<CsvError>([&] { readFrom(text, loads); });
  };
  EXPECT_THAT(refused("t_ms,time [us],p_x_m,p_y_m,p_z_m,q_w,q_x,q_y,q_z\n"), HasSubstr("'t_ms' time × 0.001 and"));
  EXPECT_THAT(refused("t_s,p_x_m,p_y_m,p_z_deg,q_w,q_x,q_y,q_z\n"),
              HasSubstr("by_meaning.csv:1: error: missing column 'p_z_m'"));
  EXPECT_THAT(refused("t_s,f_x_N,f_y_N,f_z_N,m_x_Nm,m_y_Nm\n", true), HasSubstr("missing column 'm_z_Nm'"));
  EXPECT_EQ(readFrom("t_s,f_x_kN,f_y_N,f_z_N,m_x_Nm,m_y_Nm,m_z_Nm\n0,1,2,3,4,5,6\n", true).at("f_x_N").front(), 1000);
}

}  // namespace
}  // namespace ursula
