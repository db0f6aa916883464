#pragma once

#include <filesystem>

#include "exchange/model_graph.h"
#include "exchange/read/xml.h"

namespace ursula::exchange {

/// The graph of a parsed file, a reader a format. They throw ImportError at what they do not understand and what a
/// scenario has no words for.
ModelGraph readSdf(const Element& root);
ModelGraph readMjcf(const Element& root);
/// `file`: robot.yaml is looked for beside it.
ModelGraph readUrdf(const Element& root, const std::filesystem::path& file);

}  // namespace ursula::exchange
