#include "apps/usage.h"

#include <fmt/format.h>
#include <algorithm>
#include <vector>

#include "apps/part_verbs.h"
#include "base/errors.h"
#include "base/text.h"

namespace ursula {
namespace {

std::string inOneLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

VerbWords verbOf(const CLI::App& app) {
  VerbWords verb{app.get_name(), inOneLine(app.get_description()), inOneLine(app.get_footer()), {}, {}};
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;
    if (option->get_positional()) {
      verb.arguments.push_back({option->get_name(true), inOneLine(option->get_description())});
      continue;
    }
    OptionWords words;
    for (const std::string& name : option->get_snames()) words.names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) words.names.push_back("--" + name);
    const std::string type = option->get_type_name();  // its bounds follow a colon
    if (option->get_items_expected_max() > 0) words.value = type.substr(0, type.find(':'));
    words.description = inOneLine(option->get_description());
    verb.options.push_back(words);
  }
  return verb;
}

}  // namespace

ProgramWords wordsOf(const CLI::App& app) {
  ProgramWords words{"ursula", inOneLine(app.version()), verbOf(app), {}};
  for (const CLI::App* verb : app.get_subcommands({}))
    if (!verb->get_group().empty()) words.verbs.push_back(verbOf(*verb));
  return words;
}

namespace {

std::string suggestion(const std::string& word, const std::vector<std::string>& known) {
  const std::string best = nearest(word, known);
  return best.empty() ? "" : fmt::format("; did you mean \"{}\"?", best);
}

bool isOption(const std::string& argument) { return argument.size() > 1 && argument[0] == '-'; }

std::vector<std::string> verbNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* verb : app.get_subcommands({}))
    if (!verb->get_group().empty()) names.push_back(verb->get_name());
  return names;
}

std::vector<std::string> optionNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

/// Returns the called verb; null if there is none.
const CLI::App* calledOf(const CLI::App& app) {
  for (const CLI::App* verb : app.get_subcommands({}))
    if (verb->parsed()) return verb;
  return nullptr;
}

/// Calls `wrong` with each given value and returns its first non-empty line; "" if there is none.
template <class Wrong>
std::string firstOf(const CLI::App& app, const Wrong& wrong) {
  for (const CLI::App* verb : app.get_subcommands())
    for (const CLI::App* at = verb; at != nullptr;
         at = at->get_subcommands().empty() ? nullptr : at->get_subcommands().front())
      for (const CLI::Option* option : at->get_options())
        for (const std::string& value : option->results())
          if (const std::string what = wrong(*option, value); !what.empty())
            return fmt::format("ursula {}: {} {} (ursula {} --help shows the usage)", verb->get_name(),
                               option->get_name(), what, verb->get_name());
  return "";
}

}  // namespace

std::string unknownVerb(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || isOption(argv[1])) return "";
  const std::string word = argv[1];
  for (const CLI::App* verb : app.get_subcommands({}))
    if (verb->get_name() == word) return "";
  const std::vector<std::string>& of_parts = verbsOfParts();
  if (std::find(of_parts.begin(), of_parts.end(), word) != of_parts.end())
    return fmt::format("ursula: the verb \"{}\" is not in this build; ./dev build adds it", word);
  return fmt::format("ursula: no verb \"{}\"{} (ursula --help lists all)", word, suggestion(word, verbNames(app)));
}

void refuseFlagValues(CLI::App& app) {
  for (CLI::Option* option : app.get_options())
    if (option->get_expected_max() == 0) option->disable_flag_override();
  for (CLI::App* verb : app.get_subcommands({})) refuseFlagValues(*verb);
}

std::string misuse(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App* last = &app;
  std::string who = "ursula";
  for (const CLI::App* next = calledOf(*last); next != nullptr; next = calledOf(*last)) {
    last = next;
    who += " " + last->get_name();
  }
  const CLI::App& verb = *last;
  const std::vector<std::string> surplus = verb.remaining();
  for (const std::string& argument : surplus) {
    if (!isOption(argument)) continue;
    const std::string name = argument.substr(0, argument.find('='));
    return fmt::format("{}: no option \"{}\"{} ({} --help lists all)", who, name, suggestion(name, optionNames(verb)),
                       who);
  }
  if (!surplus.empty())
    return fmt::format("{}: \"{}\" is one argument too many ({} --help shows the usage)", who, surplus.front(), who);
  const char* expected = error.get_name() == "ConversionError" ? ", expected a number" : "";
  return fmt::format("{}: {}{} ({} --help shows the usage)", who, error.what(), expected, who);
}

std::string emptyValue(const CLI::App& app) {
  return firstOf(app, [](const CLI::Option& option, const std::string& value) {
    return value.empty() && option.get_expected_min() > 0 ? "is empty, expected a value" : "";
  });
}

std::string oddNumber(const CLI::App& app) {
  return firstOf(app, [](const CLI::Option& option, const std::string& value) -> std::string {
    const std::string type = option.get_type_name();  // its bounds follow a colon
    const bool is_whole = type.rfind("INT", 0) == 0 || type.rfind("UINT", 0) == 0;
    if (!is_whole && type.rfind("FLOAT", 0) != 0) return "";
    const std::string digits = value.substr(value.find_first_not_of("+-"));
    const bool is_plain =
        leadingNumber(value).length == value.size() && (!is_whole || digits.size() == 1 || digits.front() != '0');
    return is_plain ? "" : fmt::format("{}: is not a {}", value, is_whole ? "whole number in plain digits" : "number");
  });
}

std::string outOfMemory(const CLI::App& app) {
  const CLI::App& verb = *app.get_subcommands().front();
  const auto has = [&verb](const char* option) { return verb.get_option_no_throw(option) != nullptr; };
  if (verb.get_name() == "validate" || verb.get_name() == "sweep") return out_of_memory_for_scenario;
  std::string less = has("--samples") ? "--samples" : "";
  if (has("--jobs")) less += less.empty() ? "--jobs" : " or --jobs";
  return less.empty() ? out_of_memory : fmt::format("{}: fewer {} need less", out_of_memory, less);
}

}  // namespace ursula
