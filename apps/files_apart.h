#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace ursula {

/// What is wrong where a call names one file twice, once to be written: a line for people; "" where nothing is. Looks
/// at the verb that was called, and those within it.
std::string namedTwice(const CLI::App& app);

}  // namespace ursula
