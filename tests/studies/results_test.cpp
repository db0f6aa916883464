// results/paper-helix, as committed, against a fresh run.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "base/csv.h"
#include "report/files/report.h"
#include "report/files/written_files.h"
#include "validation/validate.h"

namespace ursula {
namespace {

const char* const folder = URSULA_RESULTS "/paper-helix";

const ValidationResult& fresh() {
  static const ValidationResult result = validate(readScenario(URSULA_SCENARIOS "/paper-helix.toml"));
  return result;
}

nlohmann::json committedSummary() {
  std::ifstream file(std::string(folder) + "/summary.json");
  return nlohmann::json::parse(file);
}

/// Both runs are within the rounding of exact torques that `torque.pointwise` allows, so they are within twice that of
/// each other. Returns the worst share of this, or NaN.
double worstShare(const CsvTable& committed, const TimeSeries& series, double perturbation) {
  double worst = 0;
  const std::vector<double>& limit = *series.find("limit_tau_Nm");
  for (int i = 1; i <= 6; ++i) {
    const std::string column = "tau_" + std::to_string(i) + "_Nm";
    const std::vector<double>&a = committed.at(column), &b = *series.find(column);
    if (a.size() != b.size()) return std::nan("");
    for (std::size_t k = 0; k < a.size(); ++k) {
      const double share = std::abs(a[k] + perturbation * limit[k] - b[k]) / (2 * limit[k]);
      if (!(share <= worst)) worst = share;
    }
  }
  return worst;
}

TEST(CommittedResults, haveTheVerdictAndTheChecksOfAFreshRun) {
  const nlohmann::json summary = committedSummary();
  EXPECT_EQ(summary["scenario"], fresh().scenario);
  EXPECT_EQ(summary["verdict"], name(fresh().verdict));
  EXPECT_EQ(summary["verdict"], "pass");
  std::set<std::string> committed, now;
  for (const nlohmann::json& check : summary["checks"]) {
    committed.insert(check["name"].get<std::string>());
    if (check["verdict"] == "not_applicable") continue;
    EXPECT_LE(check["value"].get<double>(), check["limit"].get<double>()) << check["name"];
  }
  for (const Check& check : fresh().checks) now.insert(check.name);
  EXPECT_EQ(committed, now) << "./dev results refreshes results/";
}

TEST(CommittedResults, haveTheTorquesOfAFreshRun) {
  const CsvTable committed = readCsv(std::string(folder) + "/inverse.csv");
  EXPECT_LE(worstShare(committed, fresh().timeseries, 0), 1) << "./dev results refreshes results/";
  EXPECT_GT(worstShare(committed, fresh().timeseries, 4), 1);  // control: a deviation of four limits shows
}

TEST(CommittedResults, areOfThisScenario) {
  const nlohmann::json provenance = committedSummary()["provenance"];
  std::string sha1;
  for (const auto& [key, text] : fresh().provenance)
    if (key == "scenario sha1") sha1 = text;
  EXPECT_FALSE(sha1.empty());
  EXPECT_EQ(provenance["scenario sha1"], sha1) << "./dev results refreshes results/";
}

}  // namespace
}  // namespace ursula
