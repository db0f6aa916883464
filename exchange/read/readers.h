#pragma once

#include <filesystem>

#include "exchange/model_graph.h"
#include "exchange/read/xml.h"

namespace ursula::exchange {

/// One reader per format returns the graph of a parsed file. Readers throw ImportError for unknown elements and for
/// elements that a scenario cannot express.
ModelGraph readSdf(const Element& root);
ModelGraph readMjcf(const Element& root);
/// Looks for robot.yaml next to `file`.
ModelGraph readUrdf(const Element& root, const std::filesystem::path& file);

}  // namespace ursula::exchange
