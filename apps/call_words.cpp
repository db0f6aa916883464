#include "apps/call_words.h"

#include <algorithm>

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

}  // namespace ursula
