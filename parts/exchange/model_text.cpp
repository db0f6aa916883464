#include "parts/exchange/model_text.h"

#include <algorithm>

#include "base/text_source.h"
#include "parts/exchange/read/xml.h"

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
  if (document.RootElement()->Name() == std::string("mujoco")) takeIncludes(document, file);
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

}  // namespace

ModelGraph readGraph(const std::filesystem::path& file) {
  return readText(ursula::readText(file, {most_model_bytes, "a model (SDF, MJCF or URDF)"}), file);
}

}  // namespace ursula::exchange
