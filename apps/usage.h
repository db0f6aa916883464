#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace ursula {

/// The first argument where it should be a verb and is none, as a line for people; "" where it is one, or no verb can
/// be expected there.
std::string unknownVerb(const CLI::App& app, int argc, char** argv);

/// A flag takes no value: --quiet=7 is refused.
void refuseFlagValues(CLI::App& app);

/// What was wrong with a call, in one line: the nearest option where one is misspelt, and whom to ask.
std::string misuse(const CLI::App& app, const CLI::ParseError& error);

/// A number that was given as CLI11 reads it and people do not write it, as a line for people; "" where there is none:
/// 010 is 8 to it, and 1e-400 is 0.
std::string oddNumber(const CLI::App& app);

/// An option or argument that was given and is empty, as a line for people; "" where there is none. It is a variable of
/// a script that was never set, and stands for nothing.
std::string emptyValue(const CLI::App& app);

/// That memory ran out, and which of the verb's numbers may be less.
std::string outOfMemory(const CLI::App& app);

}  // namespace ursula
