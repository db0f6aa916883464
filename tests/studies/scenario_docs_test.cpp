// docs/scenario.md, docs/scenario.schema.json and docs/checks.md agree with their tables; ./dev docs writes them.

#include "parts/scenario_docs/scenario_docs.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "model/mechanism_keys.h"
#include "model/scenario_keys.h"
#include "report/text/result_facts.h"
#include "tests/base/temporary_folder.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

std::string committed(const std::string& name) {
  return TemporaryFolder::read(std::filesystem::path(URSULA_DOCS) / name);
}

TEST(ScenarioDocs, areTheTables) {
  EXPECT_TRUE(committed("scenario.md") == scenarioMarkdown()) << "run ./dev docs";
  EXPECT_TRUE(committed("scenario.schema.json") == scenarioSchema()) << "run ./dev docs";
}

TEST(CheckDocs, areTheCatalogue) {
  EXPECT_TRUE(committed("checks.md") == report::checksMarkdown()) << "run ./dev docs";
}

TEST(ScenarioDocs, nameEveryKey) {
  const std::string page = scenarioMarkdown();
  for (const ScenarioTable& table : scenarioTables())
    for (const ScenarioKey& key : table.keys) EXPECT_THAT(page, HasSubstr("\n| `" + std::string(key.name) + "` | "));
}

TEST(ScenarioDocs, theSchemaHoldsTypesBoundsAndWhatIsRequired) {
  const auto schema = nlohmann::json::parse(scenarioSchema());
  EXPECT_EQ(schema["required"], nlohmann::json({"name", "trajectory"}));
  EXPECT_EQ(schema["oneOf"][0]["required"], nlohmann::json({"manipulator"}));
  const auto& platform = schema["properties"]["manipulator"]["properties"]["platform"];
  EXPECT_EQ(platform["properties"]["mass"]["exclusiveMinimum"], 0);
  EXPECT_EQ(platform["additionalProperties"], false);
  EXPECT_EQ(schema["properties"]["simulation"]["properties"]["samples"]["maximum"], 1000000);
  EXPECT_EQ(schema["else"]["properties"]["trajectory"]["oneOf"].size(), 4u);
  EXPECT_EQ(schema["properties"]["manipulator"]["properties"]["leg"]["minItems"], 3);
  const auto& leg = schema["properties"]["manipulator"]["properties"]["leg"]["items"]["properties"];
  EXPECT_EQ(leg["kind"]["enum"].size(), 4u);
  EXPECT_EQ(leg["actuated"]["items"]["enum"], nlohmann::json({"phi", "psi", "theta", "d"}));
}

TEST(ScenarioDocs, haveMechanismsToo) {
  const std::string page = scenarioMarkdown();
  const std::string loops = page.substr(page.find("\n## Any closed loop"));
  for (const ScenarioTable& table : mechanismTables())
    for (const ScenarioKey& key : table.keys) EXPECT_THAT(loops, HasSubstr("\n| `" + std::string(key.name) + "` | "));
  const auto schema = nlohmann::json::parse(scenarioSchema());
  EXPECT_EQ(schema["oneOf"][1]["required"], nlohmann::json({"mechanism"}));
  EXPECT_EQ(schema["properties"]["mechanism"]["required"], nlohmann::json({"file"}));
  EXPECT_EQ(schema["properties"]["mechanism"]["properties"]["motors"]["items"]["type"], "string");
  EXPECT_EQ(schema["then"]["properties"]["trajectory"]["oneOf"].size(), 3u);
  EXPECT_EQ(schema["then"]["properties"]["load"], false);
}

}  // namespace
}  // namespace ursula
