#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace ursula {

enum class KeyType {
  number,
  share,  ///< a number, or a percentage as text
  integer,
  string,
  choice,
  choices,
  vector,
  numbers,  ///< an array of numbers of any length
  quaternion,
  center,
  inertia,
  table,
  tables,
  limits
};

/// The numbers that a key accepts, and the words for refusals.
struct KeyBound {
  const char* words = "";  ///< "> 0"; empty for any finite number
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();

  bool zero_too = true;

  bool holds(double value) const { return value >= least && value <= most && (zero_too || value != 0); }
};

/// One key of a scenario; the reader uses it and docs/scenario.md describes it.
struct ScenarioKey {
  const char* name;
  KeyType type;
  const char* unit;      ///< empty if it has none
  const char* fallback;  ///< in TOML; "!" if the key is required, empty if there is no default
  const char* meaning;
  KeyBound bound = {};
  std::vector<std::string> choices = {};  ///< values of a choice or choices, in the reader's order
  const char* of = "";                    ///< for table and tables: the ScenarioTable of their content

  bool isRequired() const { return fallback[0] == '!'; }
};

/// Returns the row of a table, or with KeyType::tables of an array of them; `of` names the ScenarioTable of their
/// content.
inline ScenarioKey tableKey(const char* name, const char* fallback, const char* meaning, const char* of,
                            KeyType type = KeyType::table) {
  return {name, type, "", fallback, meaning, {}, {}, of};
}

/// Returns the row of a key that takes one of these words.
inline ScenarioKey choiceKey(const char* name, const char* fallback, const char* meaning,
                             const std::vector<std::string>& choices) {
  return {name, KeyType::choice, "", fallback, meaning, {}, choices};
}

/// The keys of one table of a scenario, in the order of errors and docs.
struct ScenarioTable {
  const char* name;     ///< name for the reader: `manipulator.leg`
  const char* written;  ///< name in a scenario: `[[manipulator.leg]]`
  const char* meaning;
  std::vector<ScenarioKey> keys;

  std::vector<std::string> names() const;
  /// Throws std::out_of_range for an unknown key, which is a bug of the reader.
  const ScenarioKey& key(const std::string& name) const;
};

/// Returns all tables, the document first. The reader accepts exactly these; docs/scenario.md and
/// docs/scenario.schema.json are generated from them.
const std::vector<ScenarioTable>& scenarioTables();

/// Returns the second name of a friction coefficient on the paper's legs: `actuated` for `phi`, and vice versa. Returns
/// an empty string if there is none.
std::string otherFrictionName(const std::string& key);

/// Throws std::out_of_range for an unknown table.
const ScenarioTable& scenarioTable(std::string_view name);

/// Returns the tables of the machine, a part of scenarioTables().
std::vector<ScenarioTable> machineTables();

// Common parts of the lists of keys.
inline constexpr double least_positive = std::numeric_limits<double>::denorm_min();
inline constexpr KeyBound above_zero{"> 0", least_positive};
inline constexpr KeyBound not_negative{">= 0", 0};
inline constexpr KeyBound not_zero{"not 0", -std::numeric_limits<double>::max(), std::numeric_limits<double>::max(),
                                   false};
inline constexpr const char* required_key = "!";
inline constexpr const char* no_default = "";

}  // namespace ursula
