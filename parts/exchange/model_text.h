#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "base/text.h"
#include "base/text_source.h"
#include "parts/exchange/model_graph.h"

namespace ursula::exchange {

/// Reads the graph of a model. The text of an error has no file and no line yet: see inFile().
ModelGraph readGraph(const std::filesystem::path& file);

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

}  // namespace ursula::exchange
