#include "model/scenario_files.h"

#include <fmt/format.h>

#include <string_view>

#include "base/text.h"
#include "base/toml_bounds.h"
#include "model/columns.h"
#include "model/scenario_sections.h"
#include "model/toml_reader.h"

namespace ursula {

std::vector<std::filesystem::path> makeFilesAbsolute(toml::table& document, const std::filesystem::path& scenario) {
  std::vector<std::filesystem::path> found;
  for (const char* part : {"trajectory", "load", "mechanism"}) {
    toml::table* table = document[part].as_table();
    toml::value<std::string>* name = table == nullptr ? nullptr : (*table)["file"].as_string();
    if (name == nullptr) continue;
    found.push_back(std::filesystem::absolute(scenario.parent_path() / name->get()).lexically_normal());
    *name = found.back().string();
  }
  return found;
}

std::vector<std::filesystem::path> filesNamedBy(const std::string& text, const std::filesystem::path& file) {
  if (text.empty()) return {};
  toml::table document = parseToml(text, file.string());
  return makeFilesAbsolute(document, file);
}

std::vector<std::filesystem::path> filesNamedBy(const Scenario& scenario) {
  return filesNamedBy(scenario.text, scenario.file);
}

CsvTable readCsvBeside(const TomlSection& table, const std::string& key, bool loads) {
  std::string name;
  table.require(key, name);
  try {
    requirePath(name);
  } catch (const TextRefusal& refusal) {
    table.fail(key, refusal.what());
  }
  const std::filesystem::path file = std::filesystem::path(table.file()).parent_path() / name;
  std::error_code error;
  if (!std::filesystem::exists(file, error) || std::filesystem::is_directory(file, error))
    table.fail(key, "'" + shownPath(file.string()) + "', expected a CSV file");
  return readByMeaning(file, loads);
}

std::vector<std::string> readAs(const Scenario& scenario) {
  std::vector<std::string> out;
  if (scenario.text.empty()) return out;
  toml::table document = parseToml(scenario.text, scenario.file.string());
  makeFilesAbsolute(document, scenario.file);
  for (const char* part : {"trajectory", "load"})
    if (const auto file = document[part]["file"].value<std::string>()) {
      const std::string words = meaningInWords(*file, part == std::string_view("load"));
      if (!words.empty()) out.push_back(fmt::format("{}: read as: {}", shownPath(*file), words));
    }
  return out;
}

std::string scenarioText(const std::filesystem::path& file) {
  try {
    return readText(file, {most_toml_bytes, "a scenario in TOML"});
  } catch (const TextRefusal& refusal) {
    throw errorAt(file.string(), refusal);
  }
}

std::filesystem::path namedInput(const std::filesystem::path& file) { return file == "-" ? "<stdin>" : file; }

std::string scenarioTextOrInput(const std::filesystem::path& file) {
  if (file != "-") return scenarioText(file);
  try {
    return readStandardInput({most_toml_bytes, "a scenario in TOML"});
  } catch (const TextRefusal& refusal) {
    throw errorAt(namedInput(file).string(), refusal);
  }
}

}  // namespace ursula
