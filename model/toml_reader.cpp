#include "model/toml_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <regex>
#include <sstream>

#include "base/text.h"
#include "base/toml_bounds.h"
#include "model/quaternions.h"

namespace ursula {
namespace {

std::string typeName(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a float";
    case toml::node_type::boolean:
      return "a boolean";
    default:
      return "a date or time";
  }
}

/// No SI quantity is larger than this or smaller than its inverse; a double holds products of a few such numbers.
constexpr double largest_number = 1e100;

std::string quotedList(const std::vector<std::string>& words) {
  std::string list;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) list += i + 1 < words.size() ? ", " : " or ";
    list += "'" + words[i] + "'";
  }
  return list;
}

/// Returns ", did you mean 142.0?" where a line ends with 142,0.
std::string decimalPoint(const std::string& text, std::size_t line) {
  std::istringstream lines(text);
  std::string at;
  for (std::size_t k = 0; k < line; ++k) std::getline(lines, at);
  static const std::regex with_comma(R"(^[^=#"]{1,100}=\s*([-+]?\d{1,20}),(\d{1,20})\s*(#.*)?$)");
  std::smatch found;
  if (at.size() > 300 || !std::regex_match(at, found, with_comma)) return "";
  return fmt::format(", did you mean {}.{}?", found.str(1), found.str(2));
}

/// Returns the parser's message without its own "Error", and with what was expected.
std::string syntaxError(const std::string& message) {
  static const std::string prefix = "Error while parsing ";
  const std::string said = message.rfind(prefix, 0) == 0 ? "while parsing " + message.substr(prefix.size()) : message;
  return said.find("expected ") == std::string::npos ? said + ", expected valid TOML" : said;
}

}  // namespace

std::string placeAt(const std::string& file, const toml::source_position& position) {
  // Without a position toml++ gives line 0; people and editors count from 1.
  return fmt::format("{}:{}:{}", shownPath(file), std::max(position.line, 1U), std::max(position.column, 1U));
}

PlacedError errorAt(const std::string& file, const toml::source_position& position, const std::string& message) {
  return {placeAt(file, position) + ": error: " + message, position.line, position.column};
}

PlacedError errorAt(const std::string& file, const TextRefusal& refusal) {
  const std::string place = refusal.line > 0 ? fmt::format(":{}:{}", refusal.line, refusal.column) : "";
  return {fmt::format("{}{}: error: {}", shownPath(file), place, refusal.what()), refusal.line, refusal.column};
}

toml::table parseToml(const std::string& text, const std::string& file) {
  try {
    requireBounded(text);
    return toml::parse(std::string_view(text), std::string_view(file));
  } catch (const TextRefusal& refusal) {
    throw errorAt(file, refusal).in(text);
  } catch (const toml::parse_error& error) {
    const toml::source_position place = error.source().begin;
    throw errorAt(file, place, syntaxError(shown(error.description(), 400)) + decimalPoint(text, place.line)).in(text);
  }
}

void TomlSection::failAt(const toml::node& node, const std::string& message) const {
  throw errorAt(file_, node.source().begin, message);
}

void TomlSection::fail(const std::string& what) const { failAt(*table_, place_.empty() ? what : place_ + ": " + what); }

void TomlSection::fail(const std::string& key, const std::string& what) const {
  failAt(*table_->get(key), placeOf(key) + ": " + what);
}

void TomlSection::missing(const std::string& key, const std::string& expected) const {
  failAt(*table_, fmt::format("missing key '{}'{}, expected {}", key, inPlace(), expected));
}

std::vector<PlacedError> TomlSection::unknownKeys(const ScenarioTable& allowed) const {
  const std::vector<std::string> keys = allowed.names();
  std::vector<PlacedError> out;
  for (const auto& [key, node] : *table_) {
    const std::string name(key.str());
    if (std::find(keys.begin(), keys.end(), name) == keys.end())
      out.push_back(errorAt(file_, key.source().begin,
                            fmt::format("unknown key '{}'{}, expected {}{}", shown(name), inPlace(), quotedList(keys),
                                        didYouMean(name, keys))));
  }
  // toml++ orders keys by name
  std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.position() < b.position(); });
  return out;
}

void TomlSection::allowOnly(const ScenarioTable& allowed) const {
  if (const std::vector<PlacedError> unknown = unknownKeys(allowed); !unknown.empty())
    throw PlacedError(unknown.front());
}

double TomlSection::number(const toml::node& node, const std::string& place) const {
  if (!node.is_number()) failAt(node, fmt::format("{}: {}, expected a number", place, typeName(node)));
  const double value =
      node.is_integer() ? static_cast<double>(node.as_integer()->get()) : node.as_floating_point()->get();
  if (!std::isfinite(value)) failAt(node, fmt::format("{}: {}, expected a finite number", place, value));
  if (value != 0 && !(std::abs(value) <= largest_number && std::abs(value) >= 1 / largest_number))
    failAt(node,
           fmt::format("{}: {}, expected 0 or a size from {} to {}", place, value, 1 / largest_number, largest_number));
  return value;
}

std::optional<std::vector<double>> TomlSection::numbers(const std::string& key, std::size_t size,
                                                        std::size_t or_size) const {
  const toml::node* node = table_->get(key);
  if (!node) return std::nullopt;
  const std::string expected = fmt::format(
      "an array of {} numbers", size == or_size ? std::to_string(size) : fmt::format("{} or {}", size, or_size));
  const toml::array* array = node->as_array();
  if (!array) fail(key, typeName(*node) + ", expected " + expected);
  if (array->size() != size && array->size() != or_size)
    fail(key, fmt::format("an array of {}, expected {}", array->size(), expected));
  std::vector<double> values;
  for (std::size_t i = 0; i < array->size(); ++i)
    values.push_back(number(*array->get(i), fmt::format("{}[{}]", placeOf(key), i + 1)));
  return values;
}

bool TomlSection::read(const std::string& key, double& value) const {
  const toml::node* node = table_->get(key);
  if (node) value = number(*node, placeOf(key));
  return node != nullptr;
}

void TomlSection::requireShare(const std::string& key, double& value) const {
  const toml::node* node = table_->get(key);
  if (!node || !node->is_string()) return require(key, value);
  const std::string& text = node->as_string()->get();
  const std::optional<double> share = percentage(text);
  if (!share) fail(key, fmt::format("'{}', expected a number or a percentage, such as 0.01 or \"1%\"", shown(text)));
  value = *share;
}

bool TomlSection::read(const std::string& key, int& value) const {
  const toml::node* node = table_->get(key);
  if (!node) return false;
  if (!node->is_integer()) fail(key, typeName(*node) + ", expected an integer");
  const std::int64_t given = node->as_integer()->get();
  if (given < std::numeric_limits<int>::min() || given > std::numeric_limits<int>::max())
    fail(key, fmt::format("{}, expected an integer of 32 bits", given));
  value = static_cast<int>(given);
  return true;
}

bool TomlSection::read(const std::string& key, std::string& value) const {
  const toml::node* node = table_->get(key);
  if (!node) return false;
  if (!node->is_string()) fail(key, typeName(*node) + ", expected a string");
  value = node->as_string()->get();
  return true;
}

bool TomlSection::read(const std::string& key, Vector3d& value) const {
  const auto given = numbers(key, 3, 3);
  if (given) value = Eigen::Map<const Vector3d>(given->data());
  return given.has_value();
}

bool TomlSection::read(const std::string& key, Eigen::Vector4d& value) const {
  const auto given = numbers(key, 4, 4);
  if (given) value = Eigen::Map<const Eigen::Vector4d>(given->data());
  return given.has_value();
}

bool TomlSection::readInertia(const std::string& key, Matrix3d& value) const {
  const auto given = numbers(key, 3, 6);
  if (!given) return false;
  const std::vector<double>& i = *given;
  value = Vector3d(i[0], i[1], i[2]).asDiagonal();
  if (i.size() == 6) {
    value(0, 1) = value(1, 0) = i[3];
    value(0, 2) = value(2, 0) = i[4];
    value(1, 2) = value(2, 1) = i[5];
  }
  return true;
}

std::optional<std::vector<std::string>> TomlSection::readStrings(const std::string& key) const {
  const toml::node* node = table_->get(key);
  if (!node) return std::nullopt;
  const toml::array* array = node->as_array();
  if (!array) fail(key, typeName(*node) + ", expected an array of strings");
  std::vector<std::string> out;
  for (const toml::node& element : *array) {
    if (!element.is_string()) failAt(element, placeOf(key) + ": " + typeName(element) + ", expected a string");
    out.push_back(element.as_string()->get());
  }
  return out;
}

void TomlSection::requireBound(const ScenarioKey& key, double value) const {
  if (has(key.name) && !key.bound.holds(value)) fail(key.name, fmt::format("{}, expected {}", value, key.bound.words));
}

bool TomlSection::readAngle(const std::string& key, double& value) const {
  const std::string in_degrees = key + "_deg";
  if (!has(in_degrees)) return read(key, value);
  if (has(key)) fail(in_degrees, "given beside '" + key + "', expected one of the two");
  double degrees = 0;
  require(in_degrees, degrees);
  value = radians(degrees);
  return true;
}

std::optional<std::size_t> TomlSection::readChoice(const ScenarioKey& key) const {
  const std::vector<std::string>& choices = key.choices;
  const toml::node* node = table_->get(key.name);
  if (!node) return std::nullopt;
  if (!node->is_string()) fail(key.name, fmt::format("{}, expected {}", typeName(*node), quotedList(choices)));
  const std::string given = node->as_string()->get();
  const auto found = std::find(choices.begin(), choices.end(), given);
  if (found == choices.end())
    fail(key.name, fmt::format("'{}', expected {}{}", shown(given), quotedList(choices), didYouMean(given, choices)));
  return found - choices.begin();
}

std::optional<TomlSection> TomlSection::section(const std::string& key) const {
  const toml::node* node = table_->get(key);
  if (!node) return std::nullopt;
  if (!node->is_table()) fail(key, typeName(*node) + ", expected a table");
  return TomlSection(*node->as_table(), placeOf(key), file_);
}

TomlSection TomlSection::requiredSection(const std::string& key) const {
  const auto found = section(key);
  if (!found) missing(key, "a table");
  return *found;
}

std::vector<TomlSection> TomlSection::sections(const std::string& key) const {
  const toml::node* node = table_->get(key);
  if (!node) return {};
  if (!node->is_array()) fail(key, typeName(*node) + ", expected an array of tables");
  std::vector<TomlSection> all;
  for (const toml::node& element : *node->as_array()) {
    const std::string place = fmt::format("{}[{}]", placeOf(key), all.size() + 1);
    if (!element.is_table()) failAt(element, fmt::format("{}: {}, expected a table", place, typeName(element)));
    all.emplace_back(*element.as_table(), place, file_);
  }
  return all;
}

}  // namespace ursula
