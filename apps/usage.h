#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace ursula {

/// The first argument where it should be a verb and is none, as a line for people; "" where it is one, or no verb can
/// be expected there.
std::string unknownVerb(const CLI::App& app, int argc, char** argv);

/// What was wrong with a call, in one line: the nearest option where one is misspelt, and whom to ask.
std::string misuse(const CLI::App& app, const CLI::ParseError& error);

}  // namespace ursula
