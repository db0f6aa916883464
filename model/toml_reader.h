#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>
#include <vector>

#include "base/scalar.h"
#include "base/text_source.h"
#include "model/scenario.h"
#include "model/scenario_keys.h"

namespace ursula {

/// `file:line:column` of a node.
std::string placeAt(const std::string& file, const toml::source_position& position);

/// The error `file:line:column: error: message` at a node's place.
ScenarioError errorAt(const std::string& file, const toml::source_position& position, const std::string& message);

/// The same for text that was not taken.
ScenarioError errorAt(const std::string& file, const TextRefusal& refusal);

/// A document; `file` names it in errors. Throws ScenarioError at what is no TOML, and for what requireBounded refuses.
toml::table parseToml(const std::string& text, const std::string& file);

/// One table of a scenario, read strictly: whatever is not of the type asked for throws a ScenarioError with its place.
/// `read` leaves `value` alone and returns false where the key is not given; `require` throws then.
/// Numbers may be written as integers and must be finite. Refers to the document, which has to outlive it.
class TomlSection {
 public:
  TomlSection(const toml::table& table, std::string place, std::string file)
      : table_(&table), place_(std::move(place)), file_(std::move(file)) {}

  const std::string& place() const { return place_; }  ///< dotted key; empty for the document
  const std::string& file() const { return file_; }
  const toml::table& table() const { return *table_; }

  /// Throws for the first key that is none of the table's, naming the nearest of them.
  void allowOnly(const ScenarioTable& keys) const;
  bool has(const std::string& key) const { return table_->contains(key); }

  bool read(const std::string& key, double& value) const;
  bool read(const std::string& key, int& value) const;
  bool read(const std::string& key, std::string& value) const;
  bool read(const std::string& key, Vector3d& value) const;
  bool read(const std::string& key, Eigen::Vector4d& value) const;
  /// [xx, yy, zz] or [xx, yy, zz, xy, xz, yz], tensor entries, into a symmetric matrix.
  bool readInertia(const std::string& key, Matrix3d& value) const;
  /// An array of strings; none where the key is not given.
  std::optional<std::vector<std::string>> readStrings(const std::string& key) const;
  /// The index among the key's choices of the string given.
  std::optional<std::size_t> readChoice(const ScenarioKey& key) const;
  /// Throws where the key is given and its number is not within its bound.
  void requireBound(const ScenarioKey& key, double value) const;

  /// An angle, rad, from `key`, or in degrees from `key`_deg, correctly rounded; both are refused.
  bool readAngle(const std::string& key, double& value) const;
  void requireAngle(const std::string& key, double& value) const {
    if (!readAngle(key, value)) missing(key, "a number, rad, or '" + key + "_deg' in degrees");
  }

  template <class T>
  void require(const std::string& key, T& value) const {
    if (!read(key, value)) missing(key, expectation(value));
  }

  std::optional<TomlSection> section(const std::string& key) const;
  TomlSection requiredSection(const std::string& key) const;
  /// An array of tables, `key[1]`, `key[2]`, …; empty where the key is not given.
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

}  // namespace ursula
