#pragma once

#include <toml++/toml.h>
#include <optional>
#include <string>
#include <vector>

#include "base/scalar.h"
#include "base/text_source.h"
#include "model/number_tolerances.h"
#include "model/scenario_excerpt.h"
#include "model/scenario_keys.h"

namespace ursula {

/// Returns `file:line:column` of a node.
std::string placeAt(const std::string& file, const toml::source_position& position);

/// Returns the error `file:line:column: error: message` at a node's place.
PlacedError errorAt(const std::string& file, const toml::source_position& position, const std::string& message);

/// Returns the same for a text that was refused.
PlacedError errorAt(const std::string& file, const TextRefusal& refusal);

/// Parses a document; `file` names it in errors. Throws ScenarioError for invalid TOML and if requireBounded refuses
/// it.
toml::table parseToml(const std::string& text, const std::string& file);

/// Reads one table of a scenario strictly: a value of another type throws a ScenarioError with its place. For a missing
/// key, `read` returns false and keeps `value`, and `require` throws. Numbers may be integers and must be finite.
/// Refers to the document, which must outlive it.
class TomlSection {
 public:
  TomlSection(const toml::table& table, std::string place, std::string file)
      : table_(&table), place_(std::move(place)), file_(std::move(file)) {}

  const std::string& place() const { return place_; }  ///< dotted key; empty for the document
  const std::string& file() const { return file_; }
  const toml::table& table() const { return *table_; }

  /// Returns an error for each unknown key, in the order of the file, with the nearest known one.
  std::vector<PlacedError> unknownKeys(const ScenarioTable& allowed) const;
  /// Throws the first of them.
  void allowOnly(const ScenarioTable& keys) const;
  bool has(const std::string& key) const { return table_->contains(key); }

  bool read(const std::string& key, double& value) const;
  bool read(const std::string& key, int& value) const;
  bool read(const std::string& key, std::string& value) const;
  bool read(const std::string& key, Vector3d& value) const;
  bool read(const std::string& key, Eigen::Vector4d& value) const;
  /// Reads [xx, yy, zz] or [xx, yy, zz, xy, xz, yz] into a symmetric matrix.
  bool readInertia(const std::string& key, Matrix3d& value) const;
  /// Reads an array of strings; nullopt if the key is missing.
  std::optional<std::vector<std::string>> readStrings(const std::string& key) const;
  /// Returns the string's index among the key's choices; nullopt if the key is missing.
  std::optional<std::size_t> readChoice(const ScenarioKey& key) const;
  /// Throws if the key is given and its number is out of bounds.
  void requireBound(const ScenarioKey& key, double value) const;

  /// Reads an angle in rad from `key`, or in degrees from `key`_deg and correctly rounded. Both together are an error.
  bool readAngle(const std::string& key, double& value) const;
  void requireAngle(const std::string& key, double& value) const {
    if (!readAngle(key, value)) missing(key, "a number, rad, or '" + key + "_deg' in degrees");
  }

  template <class T>
  void require(const std::string& key, T& value) const {
    if (!read(key, value)) missing(key, expectation(value));
  }

  /// Reads a number, or a percentage as text: "1%" is 0.01.
  void requireShare(const std::string& key, double& value) const;

  std::optional<TomlSection> section(const std::string& key) const;
  TomlSection requiredSection(const std::string& key) const;
  /// Reads an array of tables, `key[1]`, `key[2]`, …; empty if the key is missing.
  std::vector<TomlSection> sections(const std::string& key) const;

  [[noreturn]] void missing(const std::string& key, const std::string& expected) const;
  /// Fails at the value of `key`: `place.key: what`.
  [[noreturn]] void fail(const std::string& key, const std::string& what) const;
  /// Fails at the table itself: `place: what`.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::string placeOf(const std::string& key) const { return place_.empty() ? key : place_ + "." + key; }
  std::string inPlace() const { return place_.empty() ? "" : " in " + place_; }
  [[noreturn]] void failAt(const toml::node& node, const std::string& message) const;
  double number(const toml::node& node, const std::string& place) const;
  std::optional<std::vector<double>> numbers(const std::string& key, std::size_t size, std::size_t or_size) const;

  static const char* expectation(const double&) { return "a number"; }
  static const char* expectation(const int&) { return "an integer"; }
  static const char* expectation(const std::string&) { return "a string"; }
  static const char* expectation(const Vector3d&) { return "an array of 3 numbers"; }
  static const char* expectation(const Eigen::Vector4d&) { return "an array of 4 numbers"; }

  const toml::table* table_;
  std::string place_, file_;
};

/// Replaces `{ value = X, tolerance = Y }` by X, a number or an array of numbers. Returns each Y by the dotted path of
/// its number. Tables of an array count from 1, entries of an array of numbers from 0. For an array, Y is one number
/// for all entries or an array of the same length. Throws ScenarioError with the place for any other table with a
/// `value`.
NumberTolerances takeTolerances(toml::table& document, const std::string& file);

}  // namespace ursula
