#include "report/files/run.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>
#include <utility>

#include "base/csv.h"
#include "base/sha1.h"
#include "report/files/written_files.h"

namespace ursula::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t digits = 16;
constexpr const char *run_key = "run", *series_key = "timeseries.csv sha1";

/// Returns nullopt if there is no file. Throws MixedResults for a device or a pipe, which may never end.
std::optional<std::string> contentOf(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::file_status there = std::filesystem::status(file, error);
  if (!std::filesystem::exists(there)) return std::nullopt;
  if (!std::filesystem::is_regular_file(there))
    throw MixedResults(file.string() + ": error: is not a regular file, expected one that a run writes");
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
}

/// Returns an empty object if there is no such file.
Json jsonIn(const std::filesystem::path& file) {
  const std::optional<std::string> text = contentOf(file);
  if (!text) return Json::object();
  Json json = Json::parse(*text, nullptr, false);
  if (!json.is_object())
    throw MixedResults(file.string() + ": error: is not a JSON object, expected one that a run writes");
  return json;
}

std::string textAt(const Json& json, const char* key) {
  return json.is_object() && json.contains(key) && json.at(key).is_string() ? json.at(key).get<std::string>() : "";
}

std::string runIn(const Json& summary) {
  return summary.contains("provenance") ? textAt(summary.at("provenance"), run_key) : "";
}

[[noreturn]] void refuse(const std::filesystem::path& file, const char* beside, const std::string& run) {
  throw MixedResults(file.string() + ": error: is not of the run " + run + " of the " + beside +
                     " beside it, expected the files of one run as it left them");
}

void requireNamed(const std::filesystem::path& file, const char* beside, const std::string& run) {
  const std::optional<std::string> text = contentOf(file);
  if (text && text->find(run) == std::string::npos) refuse(file, beside, run);
}

void refuseMixtureOfOne(const std::filesystem::path& folder) {
  const Json summary = jsonIn(folder / "summary.json");
  const std::string run = runIn(summary);
  if (run.empty()) return;
  const std::optional<std::string> series = contentOf(folder / "timeseries.csv");
  if (series && sha1(*series) != textAt(summary.at("provenance"), series_key))
    refuse(folder / "timeseries.csv", "summary.json", run);
  requireNamed(folder / "report.html", "summary.json", run);
  if (!std::filesystem::exists(folder / "suite.json")) requireNamed(folder / "junit.xml", "summary.json", run);
}

void refuseMixtureOfSuite(const std::filesystem::path& folder) {
  const Json suite = jsonIn(folder / "suite.json");
  const std::string run = textAt(suite, run_key);
  if (run.empty()) return;
  for (const char* file : {"index.html", "junit.xml"}) requireNamed(folder / file, "suite.json", run);
  for (const Json& scenario : suite.value("scenarios", Json::array())) {
    const std::filesystem::path file = folder / textAt(scenario, "folder") / "summary.json";
    const std::string expected = textAt(scenario, run_key);
    if (!expected.empty() && std::filesystem::exists(file) && runIn(jsonIn(file)) != expected)
      refuse(file, "suite.json above", expected);
  }
}

/// Whether a scenario's folder is one level below; a changed file may name another.
bool isBelow(const std::filesystem::path& folder) {
  return !folder.empty() && !folder.has_parent_path() && folder != "." && folder != "..";
}

}  // namespace

std::string timeseriesCsv(const ValidationResult& result, const std::function<void(const std::string&)>& take) {
  Sha1 hash;
  csvPieces(result.timeseries.names, result.timeseries.columns, NanAs::empty_cell, [&](const std::string& piece) {
    hash.add(piece);
    take(piece);
  });
  return hash.digits();
}

void stamp(const std::string& timeseries_sha1, ValidationResult& result) {
  if (!result.run.empty()) return;
  result.provenance.emplace_back(series_key, timeseries_sha1);
  result.run = sha1(summaryJson(result)).substr(0, digits);
  result.provenance.emplace_back(run_key, result.run);
}

ValidationResult stamped(const ValidationResult& result) {
  ValidationResult out = result;
  stamp(timeseriesCsv(result, [](const std::string&) {}), out);
  return out;
}

std::string runOf(const std::vector<SuiteEntry>& entries) {
  std::string text;
  for (const SuiteEntry& entry : entries) text += entry.scenario + "\n" + entry.run + "\n" + entry.error + "\n";
  return sha1(text).substr(0, digits);
}

Paths resultsIn(const std::filesystem::path& folder) {
  Paths paths;
  std::error_code ignored;
  if (std::filesystem::exists(folder / "summary.json", ignored)) paths.insert(result_files.begin(), result_files.end());
  const std::optional<std::string> text = contentOf(folder / "suite.json");
  if (!text) return paths;
  const Json suite = Json::parse(*text, nullptr, false);
  if (!suite.is_object() || !suite.contains("scenarios") || !suite.at("scenarios").is_array()) return paths;
  paths.insert(suite_files.begin(), suite_files.end());
  for (const Json& scenario : suite.at("scenarios")) {
    const std::filesystem::path below = textAt(scenario, "folder");
    if (!isBelow(below)) continue;
    paths.insert(below);
    for (const char* file : result_files) paths.insert(below / file);
  }
  return paths;
}

/// Compares names of files, for every result file at any depth.
std::filesystem::path replacedInput(const std::vector<std::filesystem::path>& inputs,
                                    const std::filesystem::path& folder) {
  const auto isResult = [](const std::filesystem::path& name) {
    const auto is = [&name](const char* each) { return name == each; };
    return std::any_of(result_files.begin(), result_files.end(), is) ||
           std::any_of(suite_files.begin(), suite_files.end(), is);
  };
  std::error_code ignored;
  const std::filesystem::path there = std::filesystem::weakly_canonical(folder, ignored);
  for (const std::filesystem::path& input : inputs) {
    const std::filesystem::path end = std::filesystem::weakly_canonical(input, ignored);
    const std::filesystem::path below = end.lexically_relative(there);
    if (isResult(end.filename()) && !below.empty() && *below.begin() != "..") return input;
  }
  return {};
}

void refuseMixture(const std::filesystem::path& folder) {
  const auto look = [&folder] {
    refuseMixtureOfOne(folder);
    refuseMixtureOfSuite(folder);
  };
  try {
    look();
  } catch (const MixedResults&) {  // another run may be replacing the folder between two files
    constexpr std::chrono::milliseconds until_it_is_whole{20};
    std::this_thread::sleep_for(until_it_is_whole);
    look();
  }
}

}  // namespace ursula::report
