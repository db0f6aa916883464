#pragma once

#include <limits>
#include <string>
#include <vector>

namespace ursula {

enum class KeyType {
  number,
  integer,
  string,
  choice,
  choices,
  vector,
  quaternion,
  center,
  inertia,
  table,
  tables,
  limits
};

/// What numbers a key takes, and how refusals say so.
struct KeyBound {
  const char* words = "";  ///< "> 0"; empty: any finite number
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();

  bool zero_too = true;

  bool holds(double value) const { return value >= least && value <= most && (zero_too || value != 0); }
};

/// One key of a scenario, as the reader takes it and docs/scenario.md describes it.
struct ScenarioKey {
  const char* name;
  KeyType type;
  const char* unit;      ///< empty where it has none
  const char* fallback;  ///< as TOML writes it; "!" where the key is required, empty where there is no default
  const char* meaning;
  KeyBound bound = {};
  std::vector<std::string> choices = {};  ///< of a choice or choices, in the reader's order
  const char* of = "";                    ///< of table and tables: the ScenarioTable that says what is in it

  bool isRequired() const { return fallback[0] == '!'; }
};

/// The keys of one table of a scenario, in the order in which errors and docs list them.
struct ScenarioTable {
  const char* name;     ///< by which the reader asks: `manipulator.leg`
  const char* written;  ///< how a scenario writes it: `[[manipulator.leg]]`
  const char* meaning;
  std::vector<ScenarioKey> keys;

  std::vector<std::string> names() const;
  /// Throws std::out_of_range for what is none of its keys, which is an error of the reader's.
  const ScenarioKey& key(const std::string& name) const;
};

/// All of them, from the document down. What the reader accepts is this list, and docs/scenario.md and
/// docs/scenario.schema.json are made of it.
const std::vector<ScenarioTable>& scenarioTables();

/// The other name that the friction of a coordinate may have on a leg of the paper's: `actuated` of `phi`, and back.
/// Empty where there is none.
std::string otherFrictionName(const std::string& key);

/// Throws std::out_of_range for what is no table.
const ScenarioTable& scenarioTable(const std::string& name);

}  // namespace ursula
