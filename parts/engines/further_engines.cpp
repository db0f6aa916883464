#include "parts/engines/further_engines.h"

#include <algorithm>

namespace ursula {

const EngineKind* furtherEngineOf(const std::string& check) {
  const auto* found = std::find_if(further_engines.begin(), further_engines.end(),
                                   [&](const EngineKind& engine) { return check == engine.check; });
  return found == further_engines.end() ? nullptr : found;
}

OfFurtherEngines<std::unique_ptr<Engine>> makeFurtherEngines(const Manipulator& manipulator,
                                                             const std::shared_ptr<const Load>& load) {
  OfFurtherEngines<std::unique_ptr<Engine>> out;
  for (std::size_t k = 0; k < further_engine_count; ++k)
    if (further_engines[k].available()) out[k] = further_engines[k].make(manipulator, load);
  return out;
}

}  // namespace ursula
