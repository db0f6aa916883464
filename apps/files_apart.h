#pragma once

#include <CLI/CLI.hpp>
#include <initializer_list>
#include <string>

#include "model/scenario.h"

namespace ursula {

/// What is wrong where a call names one file twice, once to be written: a line for people; "" where nothing is. Looks
/// at the verb that was called, and those within it.
std::string namedTwice(const CLI::App& app);

/// Throws UsageError where one of `written`, options' values, is a file that the scenario names, of samples for one.
void requireApart(const Scenario& scenario, std::initializer_list<std::string> written);

/// Throws UsageError where one of `written` is in one of `compared` that is a folder, or a link to a file there:
/// results that something is written into are no longer of one run.
void requireOutside(std::initializer_list<std::string> compared, std::initializer_list<std::string> written);

}  // namespace ursula
