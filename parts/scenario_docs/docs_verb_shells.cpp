#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/usage.h"
#include "model/check_catalogue.h"

namespace ursula {
namespace {

std::string optionsOf(const VerbWords& verb) {
  std::vector<std::string> names;
  for (const OptionWords& option : verb.options) names.insert(names.end(), option.names.begin(), option.names.end());
  return fmt::format("{}", fmt::join(names, " "));
}

/// Quotes text inside a shell's '…', with a backslash before each of `special`.
std::string quoted(const std::string& text, const std::string& special = "") {
  std::string out;
  for (const char c : text) {
    if (special.find(c) != std::string::npos) out += '\\';
    out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return out;
}

std::string checks() { return fmt::format("{}", fmt::join(namesOfChecks(), " ")); }

/// The format of _arguments: '(-h --help)'{-h,--help}'[what it does]:value:_files'.
std::string zshOption(const OptionWords& option) {
  const std::string names = fmt::format("{}", fmt::join(option.names, ","));
  const std::string value = option.value.empty() ? "" : ":" + quoted(option.value, ":[]") + ":_files";
  const std::string rest = fmt::format("'[{}]{}'", quoted(option.description, ":[]"), value);
  if (option.names.size() == 1) return names + rest;
  return fmt::format("'({})'{{{}}}{}", fmt::join(option.names, " "), names, rest);
}

std::string zshArguments(const VerbWords& verb, const std::string& indent) {
  std::string out = indent + "_arguments";
  for (const OptionWords& option : verb.options) out += " \\\n" + indent + "  " + zshOption(option);
  if (verb.name == "explain") return out + " \\\n" + indent + "  '1:check:(" + checks() + ")'\n";
  return out + (verb.arguments.empty() ? "" : " \\\n" + indent + "  '*:file:_files'") + "\n";
}

std::string fishOptions(const VerbWords& verb, const std::string& condition) {
  std::string out;
  for (const OptionWords& option : verb.options) {
    out += "complete -c ursula -n '" + condition + "'";
    for (const std::string& name : option.names)
      out += name.rfind("--", 0) == 0 ? " -l " + name.substr(2) : " -s " + name.substr(1);
    out += fmt::format("{} -d '{}'\n", option.value.empty() ? "" : " -r", quoted(option.description));
  }
  return out;
}

}  // namespace

std::string bashCompletion(const ProgramWords& words) {
  std::string names, cases;
  for (const VerbWords& verb : words.verbs) {
    names += verb.name + " ";
    cases += fmt::format("    {}) offered='{}' ;;\n", verb.name, optionsOf(verb));
  }
  return fmt::format(R"(# Completion of ursula for bash, made by ursula docs --completion bash.
_ursula() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} offered=''
  case ${{COMP_WORDS[1]}} in
{}  esac
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    offered='{}{}'
  elif [[ ${{COMP_WORDS[1]}} == explain && $word != -* ]]; then
    offered='{}'
  elif [[ $word != -* ]]; then
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
    return
  fi
  mapfile -t COMPREPLY < <(compgen -W "$offered" -- "$word")
}}
complete -F _ursula ursula
)",
                     cases, names, optionsOf(words.program), checks());
}

std::string zshCompletion(const ProgramWords& words) {
  std::string verbs, cases;
  for (const VerbWords& verb : words.verbs) {
    verbs += fmt::format("    '{}:{}'\n", verb.name, quoted(verb.description, ":"));
    cases += fmt::format("    {})\n{}      ;;\n", verb.name, zshArguments(verb, "      "));
  }
  return fmt::format(R"(#compdef ursula
# Completion of ursula for zsh, made by ursula docs --completion zsh.
_ursula() {{
  local -a verbs
  verbs=(
{}  )
  if (( CURRENT == 2 )); then
    _describe -t verbs verb verbs
{}    return
  fi
  local verb=$words[2]
  shift words
  (( CURRENT-- ))
  case $verb in
{}  esac
}}
_ursula "$@"
)",
                     verbs, zshArguments(words.program, "    "), cases);
}

std::string fishCompletion(const ProgramWords& words) {
  std::string out = "# Completion of ursula for fish, made by ursula docs --completion fish.\n" +
                    fishOptions(words.program, "__fish_use_subcommand");
  for (const VerbWords& verb : words.verbs) {
    out += fmt::format("complete -c ursula -n __fish_use_subcommand -f -a {} -d '{}'\n", verb.name,
                       quoted(verb.description));
    out += fishOptions(verb, "__fish_seen_subcommand_from " + verb.name);
  }
  return out + "complete -c ursula -n '__fish_seen_subcommand_from explain' -f -a '" + checks() + "'\n";
}

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
      ".TH URSULA 1 \"\" \"ursula {}\" \"User commands\"\n.SH NAME\nursula \\- {}\n.SH SYNOPSIS\n{}.SH OPTIONS\n{}.SH "
      "VERBS\n{}.SH EXIT STATUS\n0 passed, 1 a check failed, 2 bad input or usage and nothing written, 3 "
      "inconclusive.\n.SH ENVIRONMENT\n{}{}.SH FILES\n.I /usr/share/ursula/scenarios\nscenarios that are installed "
      "with ursula\n",
      words.version.substr(0, words.version.find(' ')), roff(what.substr(what.find(": ") + 2)), synopses, options,
      sections, entry("NO_COLOR", "if it is set and not empty, the output has no colours"),
      entry("BROWSER", "the program that ursula open starts; default: xdg-open"));
}

}  // namespace ursula
