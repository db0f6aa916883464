#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/call_words.h"

namespace ursula {
namespace {

/// Escapes text so that no line becomes a request and no hyphen a dash.
std::string roff(const std::string& text) {
  std::string out = "\\&";
  for (const char c : text) {
    if (c == '-' || c == '\\') out += '\\';
    out += c == '\\' ? 'e' : c;
  }
  return out;
}

std::string entry(const std::string& head, const std::string& text) {
  return ".TP\n" + head + "\n" + roff(text) + "\n";
}

std::string optionEntry(const OptionWords& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.names) names.push_back("\\fB" + roff(name) + "\\fR");
  return entry(fmt::format("{}{}", fmt::join(names, ", "), option.value.empty() ? "" : " " + roff(option.value)),
               option.description);
}

std::string synopsis(const VerbWords& verb) {
  std::string out = ".B ursula " + roff(verb.name) + "\n[OPTIONS]";
  for (const ArgumentWords& argument : verb.arguments) out += " \\fI" + roff(argument.name) + "\\fR";
  return out + "\n.br\n";
}

std::string section(const VerbWords& verb) {
  std::string out = ".SS " + roff(verb.name) + "\n" + roff(verb.description) + ".\n";
  for (const ArgumentWords& argument : verb.arguments)
    out += entry("\\fI" + roff(argument.name) + "\\fR", argument.description);
  for (const OptionWords& option : verb.options) out += optionEntry(option);
  return out + (verb.footer.empty() ? "" : ".PP\n" + roff(verb.footer) + "\n");
}

}  // namespace

std::string manPage(const ProgramWords& words) {
  const std::string& what = words.program.description;
  std::string synopses, sections, options;
  for (const VerbWords& verb : words.verbs) {
    synopses += synopsis(verb);
    sections += section(verb);
  }
  for (const OptionWords& option : words.program.options) options += optionEntry(option);
  return fmt::format(
      ".TH URSULA 1 \"\" \"ursula {}\" \"User commands\"\n.SH NAME\nursula \\- {}\n.SH SYNOPSIS\n{}.SH OPTIONS\n{}"
      ".SH VERBS\n{}.SH EXIT STATUS\n0 passed, 1 a check failed, 2 bad input or usage and nothing written, 3 "
      "inconclusive.\n.SH ENVIRONMENT\n{}{}.SH FILES\n.I /usr/share/ursula/scenarios\nscenarios that are installed "
      "with ursula\n",
      words.version.substr(0, words.version.find(' ')), roff(what.substr(what.find(": ") + 2)), synopses, options,
      sections, entry("NO_COLOR", "if it is set and not empty, the output has no colours"),
      entry("BROWSER", "the program that ursula open starts; default: xdg-open"));
}

}  // namespace ursula
