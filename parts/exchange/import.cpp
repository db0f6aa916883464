#include "parts/exchange/import.h"

#include <fmt/format.h>

#include "base/text.h"
#include "base/text_source.h"
#include "model/scenario.h"
#include "parts/exchange/read/xml.h"
#include "parts/exchange/recognise/machine.h"

namespace ursula::exchange {
namespace {

/// Refuses templates, which only generate a model.
void refuseTemplates(const std::string& text, const std::string& file) {
  if (const std::size_t at = text.find("<%"); at != std::string::npos)
    throw ImportError(
        fmt::format("a template (ERB), which is not expanded here; run: erb {} > model.sdf", file),
        1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n')));
  if (text.find("<xacro:") != std::string::npos || text.find("${") != std::string::npos)
    throw ImportError(fmt::format("xacro, which is not expanded here; run: xacro {} > model.urdf", file), 1);
}

ModelGraph readText(const std::string& text, const std::filesystem::path& file) {
  tinyxml2::XMLDocument document;
  requireModest(text);
  refuseTemplates(text, file.filename().string());
  parseXml(text, document);
  const Element& root = *document.RootElement();
  const std::string kind = root.Name();
  ModelGraph graph;
  if (kind == "sdf" || kind == "gazebo")
    graph = readSdf(root);
  else if (kind == "mujoco")
    graph = readMjcf(root);
  else if (kind == "robot")
    graph = readUrdf(root, file);
  else
    throw ImportError(fmt::format("the root element is <{}>, expected <sdf>, <mujoco> or <robot> (URDF)", shown(kind)),
                      root.GetLineNum());
  if (graph.name.empty()) graph.name = file.stem().string();
  return graph;
}

/// Adds the file and the line to every error.
template <class Run>
auto inFile(const std::filesystem::path& file, const Run& run) {
  constexpr std::size_t most = 4000;
  const std::string name = shownPath(file.string());
  const auto bounded = [](const std::string& text) { return text.size() > most ? shown(text, most) : text; };
  try {
    return run();
  } catch (const ImportError& error) {
    const std::string place = error.line > 0 ? fmt::format(":{}", error.line) : "";
    throw ImportError(fmt::format("{}{}: error: {}", name, place, bounded(error.what())), error.line);
  } catch (const TextRefusal& error) {
    const std::string place = error.line > 0 ? fmt::format(":{}:{}", error.line, error.column) : "";
    throw ImportError(fmt::format("{}{}: error: {}", name, place, bounded(error.what())));
  }
}

ModelGraph readFile(const std::filesystem::path& file) {
  return readText(ursula::readText(file, {most_model_bytes, "a model (SDF, MJCF or URDF)"}), file);
}

/// Requires that the written scenario can be read. Numbers that no scenario may have are the file's fault.
void requireReadable(const std::string& scenario) {
  try {
    static_cast<void>(parseScenario(scenario, "scenario"));
  } catch (const ScenarioError& error) {
    throw ImportError(fmt::format("its scenario would be refused: {}", error.what()));
  }
}

}  // namespace

ModelGraph readModel(const std::filesystem::path& file) {
  return inFile(file, [&] { return readFile(file); });
}

Imported importModel(const std::filesystem::path& file, const ImportChoices& choices) {
  return inFile(file, [&] {
    const ImportedMachine machine = recognise(readFile(file), choices);
    Imported out{scenarioText(machine, file.filename().string()), machine.assumptions};
    requireReadable(out.scenario);
    return out;
  });
}

}  // namespace ursula::exchange
