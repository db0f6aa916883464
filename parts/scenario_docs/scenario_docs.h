#pragma once

#include <string>

namespace ursula {

/// docs/scenario.md: every key with type, unit, default, bound and meaning.
std::string scenarioMarkdown();

/// docs/scenario.schema.json: a JSON Schema (draft 2020-12), for editors that know TOML.
std::string scenarioSchema();

}  // namespace ursula
