#include <fmt/format.h>

#include <array>
#include <sstream>
#include <string>
#include <vector>

#include "parts/sweep/report/sweep_outputs.h"

namespace ursula {
namespace {

struct Leaf {
  const char *key, *words, *unit;
};

constexpr Leaf leaves[] = {Leaf{"gravity", "gravity", "m/s²"},
                           {"mass", "mass", "kg"},
                           {"center_of_mass", "mass centre", "m"},
                           {"inertia", "inertia", "kg·m²"},
                           {"length", "length", "m"},
                           {"base_point", "base point", "m"},
                           {"platform_point", "platform point", "m"},
                           {"base_axis", "base axis", ""},
                           {"position", "position", "m"},
                           {"duration", "duration", "s"},
                           {"radius", "radius", "m"},
                           {"pitch", "pitch", "m/rad"},
                           {"time", "time", "s"}};

std::vector<std::string> partsOf(const std::string& key) {
  std::vector<std::string> out;
  std::istringstream in(key);
  for (std::string part; std::getline(in, part, '.');) out.push_back(part);
  return out;
}

bool isIndex(const std::string& part) { return part.find_first_not_of("0123456789") == std::string::npos; }

/// "z" for entry 2 of a vector, "xy" for entry 3 of a tensor.
std::string entryWords(const std::string& owner, const std::string& index) {
  const std::array<const char*, 6> tensor = {"xx", "yy", "zz", "xy", "xz", "yz"};
  const std::array<const char*, 3> vector = {"x", "y", "z"};
  const std::size_t k = index.size() == 1 ? static_cast<std::size_t>(index[0] - '0') : 9;
  if (owner == "inertia") return k < tensor.size() ? tensor[k] : index;
  return k < vector.size() ? vector[k] : index;
}

}  // namespace

std::string keyWords(const std::string& key) {
  const std::vector<std::string> parts = partsOf(key);
  std::string words, unit;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const std::string& part = parts[k];
    if (k == 0 && (part == "manipulator" || part == "mechanism")) continue;
    std::string word = part == "leg_defaults" ? "every leg" : part;
    for (char& c : word) c = c == '_' ? ' ' : c;
    if (k > 0 && isIndex(part) && parts[k - 1] != "leg" && parts[k - 1] != "points")
      word = entryWords(parts[k - 1], part);
    for (const Leaf& leaf : leaves)
      if (part == leaf.key) word = leaf.words, unit = leaf.unit;
    words += (words.empty() ? "" : " ") + word;
  }
  return unit.empty() ? words : fmt::format("{} ({})", words, unit);
}

}  // namespace ursula
