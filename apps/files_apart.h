#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <initializer_list>
#include <string>

#include "model/mechanism_scenario.h"
#include "model/scenario.h"

namespace ursula {

/// Returns an error line if a call names one file twice, once for writing; "" otherwise. Checks the called verb and the
/// verbs within it.
std::string namedTwice(const CLI::App& app);

/// Throws UsageError if one of the options' values `written` is a file that the scenario names, such as its samples.
void requireApart(const Scenario& scenario, std::initializer_list<std::string> written);
/// The same for a scenario of either machine, by its text.
void requireApart(const std::string& text, const std::filesystem::path& scenario,
                  std::initializer_list<std::string> written);

/// Throws UsageError: results in `folder` would replace `read`.
[[noreturn]] void refuseToReplace(const std::string& folder, const std::filesystem::path& read);

/// Throws UsageError if one of the results `written` into `folder` would replace a file that is read: the scenario's,
/// one that it names, or `also`.
void requireKept(const Scenario& scenario, const std::string& folder, std::initializer_list<const char*> written,
                 const std::string& also = "");
/// The same for a scenario of either machine, by its text.
void requireKept(const std::string& text, const std::filesystem::path& scenario, const std::string& folder,
                 std::initializer_list<const char*> written, const std::string& also = "");

/// Throws UsageError if one of `written` is in a folder of `compared`, or a link to a file there. A file written into
/// results would mix several runs.
void requireOutside(std::initializer_list<std::string> compared, std::initializer_list<std::string> written);

}  // namespace ursula
