#include "apps/usage.h"

#include <fmt/format.h>

#include <vector>

#include "model/nearest.h"

namespace ursula {
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

/// The verb that is called of these; null where there is none.
const CLI::App* calledOf(const CLI::App& app) {
  for (const CLI::App* verb : app.get_subcommands({}))
    if (verb->parsed()) return verb;
  return nullptr;
}

}  // namespace

std::string unknownVerb(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || isOption(argv[1])) return "";
  const std::string word = argv[1];
  for (const CLI::App* verb : app.get_subcommands({}))
    if (verb->get_name() == word) return "";
  return fmt::format("ursula: no verb \"{}\"{} (ursula --help lists all)", word, suggestion(word, verbNames(app)));
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
    return fmt::format("{}: \"{}\" is one argument too many ({} --help says how it is called)", who, surplus.front(),
                       who);
  return fmt::format("{}: {} ({} --help says how it is called)", who, error.what(), who);
}

std::string emptyValue(const CLI::App& app) {
  for (const CLI::App* verb : app.get_subcommands())
    for (const CLI::App* at = verb; at != nullptr;
         at = at->get_subcommands().empty() ? nullptr : at->get_subcommands().front())
      for (const CLI::Option* option : at->get_options())
        for (const std::string& value : option->results())
          if (value.empty() && option->get_expected_min() > 0)
            return fmt::format("ursula {}: {} is empty, expected a value (ursula {} --help says how it is called)",
                               verb->get_name(), option->get_name(), verb->get_name());
  return "";
}

}  // namespace ursula
