// The content of a sweep's file, and refusals of anything else.

#include <gtest/gtest.h>

#include "tests/model/refusals.h"
#include "tests/studies/sweep/sweeps.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

const std::string mass = vary("manipulator.platform.mass", "uniform = [400.0, 600.0]");

std::string refusedFile(const std::string& rest) {
  return refusal<ScenarioError>([&] { parseSweepFile(sweepText("inverse", rest), "sweep.toml"); });
}

std::string refusedPlan(const std::string& rest) {
  return refusal<ScenarioError>([&] { planOf("inverse", rest); });
}

TEST(SweepFile, readsAllThatItMaySay) {
  const SweepFile sweep =
      parseSweepFile(sweepText("validate",
                               "pointwise = true\ndesign = \"sobol\"\ncount = 7\nseed = 3\n"
                               "samples = 21\n" +
                                   mass +
                                   "[slurm]\npartition = \"p\"\n"
                                   "time = \"01:00:00\"\nmemory = \"1G\"\noptions = [\"--account=x\"]\n"),
                     "folder/sweep.toml");
  EXPECT_EQ(sweep.work, SweepWork::validate);
  EXPECT_TRUE(sweep.pointwise);
  EXPECT_EQ(sweep.design, SweepDesign::sobol);
  EXPECT_EQ(sweep.count, 7);
  EXPECT_EQ(sweep.seed, 3u);
  EXPECT_EQ(sweep.samples, 21);
  ASSERT_EQ(sweep.vary.size(), 1u);
  EXPECT_EQ(sweep.vary[0].by.kind, Variation::Kind::uniform);
  EXPECT_EQ(sweep.slurm.partition, "p");
  EXPECT_EQ(sweep.slurm.options, std::vector<std::string>{"--account=x"});
}

TEST(SweepFile, refusesWithThePlaceWhatItDoesNotUnderstand) {
  EXPECT_THAT(refusedFile("design = \"random\"\ncount = 5\nsead = 1\n" + mass),
              testing::AllOf(HasSubstr("sweep.toml:5:1: error: unknown key 'sead'"), HasSubstr("did you mean 'seed'")));
  EXPECT_THAT(refusedFile("design = \"random\"\n" + mass), HasSubstr("missing key 'count'"));
  EXPECT_THAT(refusedFile("design = \"random\"\ncount = 0\n" + mass),
              HasSubstr("sweep.toml:4:9: error: count: 0, expected"));
  EXPECT_THAT(refusedFile("design = \"random\"\ncount = 2.5\n" + mass), HasSubstr("expected an integer"));
  EXPECT_THAT(refusedFile("design = \"random\"\ncount = 5\nseed = -1\n" + mass), HasSubstr("seed: -1, expected"));
  EXPECT_THAT(refusedFile("design = \"random\"\ncount = 5\n"), HasSubstr("missing key 'vary'"));
  EXPECT_THAT(refusedFile("design = \"grid\"\ncount = 5\n" + mass), HasSubstr("a grid has none"));
  EXPECT_THAT(refusedFile("design = \"grid\"\n" + mass), HasSubstr("expected 'values' or 'steps'"));
  EXPECT_THAT(refusedFile("design = \"random\"\ncount = 5\n" + vary("a.b", "")), HasSubstr("no ways to vary"));
  EXPECT_THAT(refusedFile("design = \"random\"\ncount = 5\n" + vary("a.b", "relative = 1.0\nvalues = [1]")),
              HasSubstr("several ways to vary"));
  EXPECT_THAT(refusedFile("design = \"random\"\ncount = 5\n" + vary("a.b", "uniform = [2.0, 1.0]")),
              HasSubstr("from < to"));
  EXPECT_THAT(refusedFile("design = \"random\"\ncount = 5\n" + vary("a.b", "normal = [2.0, 0.0]")),
              HasSubstr("deviation 0"));
  EXPECT_THAT(refusedFile("design = \"random\"\ncount = 5\n" + vary("a.b", "values = [1, nan]")), HasSubstr("finite"));
  EXPECT_THAT(refusedFile("design = \"random\"\ncount = 5\npointwise = true\n" + mass),
              HasSubstr("expected what = 'validate'"));
  EXPECT_THAT(refusedFile("design = \"random\"\ncount = 5\n" + mass + "[slurm]\npartition = \"a b\"\n"),
              HasSubstr("without blanks"));
  const std::string in_one_line =
      refusedFile("design = \"random\"\ncount = 5\n" + mass + "[slurm]\noptions = [\"--a\\n--wrap=x\"]\n");
  EXPECT_THAT(in_one_line, HasSubstr("'--a\\x0a--wrap=x'"));
  EXPECT_EQ(in_one_line.find('\n'), std::string::npos);
  EXPECT_THAT(refusedFile("design = \"random\"\ncount = 5\n" + mass + "[slurm]\noptions = [\"x\"]\n"),
              HasSubstr("an option of sbatch"));
}

TEST(SweepFile, refusesAtItsPlaceAKeyThatLeadsToNoNumber) {
  const std::string random = "design = \"random\"\ncount = 5\n";
  EXPECT_THAT(
      refusedPlan(random + vary("manipulator.platform.mas", "relative = 0.1")),
      testing::AllOf(HasSubstr("sweep.toml:6:7: error:"), HasSubstr("no key 'mas'"), HasSubstr("did you mean 'mass'")));
  EXPECT_THAT(refusedPlan(random + vary("manipulator.platform", "relative = 0.1")), HasSubstr("has numbers within it"));
  EXPECT_THAT(refusedPlan(random + vary("name", "relative = 0.1")), HasSubstr("is not a number"));
  EXPECT_THAT(refusedPlan(random + vary("leg.0.base_point.0", "relative = 0.1")),
              HasSubstr("expected an index from 1 to 6"));
  EXPECT_THAT(refusedPlan(random + vary("leg.7.base_point.0", "relative = 0.1")),
              HasSubstr("expected an index from 1 to 6"));
  EXPECT_THAT(refusedPlan(random + vary("leg.1.base_point.3", "plus_minus = 0.1")),
              HasSubstr("expected an index from 0 to 2"));
  EXPECT_THAT(refusedPlan(random + vary("leg.1.base_point.2", "relative = 0.1")), HasSubstr("is 0 in the scenario"));
  EXPECT_THAT(refusedPlan(random + mass + vary("platform.mass", "relative = 0.1")), HasSubstr("varies twice"));
  EXPECT_THAT(refusedPlan(random + vary("leg_defaults.base_point.0", "plus_minus = 0.1")),
              HasSubstr("it has no default"));
  EXPECT_THAT(refusedPlan(random + vary("platform.mass.*", "relative = 0.1")), HasSubstr("stands for no array"));
  EXPECT_THAT(refusedPlan(random + vary("simulation.samples", "uniform = [2.0, 9.0]")),
              HasSubstr("expected an integer"));
}

TEST(SweepFile, refusesADefaultThatEveryLegOverrides) {
  const TemporaryFolder folder;
  const std::string leg = "[[manipulator.leg]]\n";
  for (const std::string name : {"phi", "actuated"}) {
    std::string helix = TemporaryFolder::read(helix_file);
    for (std::size_t at = helix.find(leg); at != std::string::npos; at = helix.find(leg, at + 1))
      helix.insert(at + leg.size(), "friction = { " + name + " = 1.0 }\n");
    SweepFile sweep = parseSweepFile(sweepText("inverse", "design = \"random\"\ncount = 5\n" +
                                                              vary("leg_defaults.friction.phi", "plus_minus = 1.0")),
                                     "sweep.toml");
    sweep.scenario = folder.write("helix.toml", helix);
    EXPECT_THAT(refusal<ScenarioError>([&] { SweepPlan plan(sweep); }), HasSubstr("every leg gives its own")) << name;
  }
}

}  // namespace
}  // namespace ursula
