// Completions and man page contain what --help lists, verb by verb.

#include <gtest/gtest.h>

#include <regex>

#include "tests/end_to_end/program.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

std::vector<std::string> matches(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> out;
  for (auto at = std::sregex_iterator(text.begin(), text.end(), regex); at != std::sregex_iterator(); ++at)
    out.push_back((*at)[1]);
  return out;
}

std::vector<std::string> listedVerbs(const Program& ursula) {
  const std::string help = ursula("--help").out;
  return matches(help.substr(help.find("Judge:")), "\n  ([a-z]+) ");
}

/// Each `--long` option that begins a line of the help, or follows its short form.
std::vector<std::string> listedOptions(const Program& ursula, const std::string& verb) {
  return matches(ursula(verb + " --help").out, "\n  (?:-[a-z],)?(--[a-z-]+)");
}

/// The part of a text from the first `from` to the next `to`.
std::string between(const std::string& text, const std::string& from, const std::string& to) {
  const std::size_t begin = text.find(from);
  return begin == std::string::npos ? "" : text.substr(begin, text.find(to, begin + from.size()) - begin);
}

std::string unescaped(const std::string& roff) { return std::regex_replace(roff, std::regex(R"(\\-)"), "-"); }

TEST(Completion, isNotMixedWithTheManPage) {
  const Program ursula;
  const UrsulaRun both = ursula.ending(2, "docs --man --completion bash");
  EXPECT_EQ(both.out, "");
  EXPECT_THAT(both.err, HasSubstr("--completion excludes --man"));
}

TEST(Completion, holdsEachVerbAndOptionOfTheHelp) {
  const Program ursula;
  const std::string bash = ursula("docs --completion bash").out, zsh = ursula("docs --completion zsh").out,
                    fish = ursula("docs --completion fish").out, man = unescaped(ursula("docs --man").out);
  const std::vector<std::string> verbs = listedVerbs(ursula);
  ASSERT_THAT(verbs, testing::IsSupersetOf({"validate", "explain", "open"}));
  std::size_t options = 0;
  for (const std::string& verb : verbs) {
    EXPECT_THAT(bash, testing::ContainsRegex("offered='(.* )?" + verb + " .*--version'")) << verb;
    EXPECT_THAT(zsh, HasSubstr("'" + verb + ":")) << verb;
    EXPECT_THAT(fish, HasSubstr("-a " + verb + " -d '")) << verb;
    EXPECT_THAT(man, HasSubstr(".B ursula \\&" + verb + "\n")) << verb;
    const std::string in_bash = between(bash, "    " + verb + ") offered=", ";;");
    const std::string in_zsh = between(zsh, "    " + verb + ")\n", ";;");
    const std::string in_man = between(man, ".SS \\&" + verb + "\n", ".SS ");
    for (const std::string& option : listedOptions(ursula, verb)) {
      ++options;
      EXPECT_THAT(in_bash, HasSubstr(option)) << verb;
      EXPECT_THAT(in_zsh, HasSubstr(option)) << verb;
      EXPECT_THAT(fish, testing::ContainsRegex("__fish_seen_subcommand_from " + verb + "' (-s . )?-l " +
                                               option.substr(2) + " "));
      EXPECT_THAT(in_man, HasSubstr(option)) << verb;
    }
  }
  EXPECT_GT(options, 40u);
}

/// Returns what bash itself offers for a line.
std::vector<std::string> offered(const Program& ursula, const std::string& line) {
  ursula.write("complete.bash", "source completion\nCOMP_WORDS=(" + line +
                                    ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_ursula\n"
                                    "printf '%s\\n' \"${COMPREPLY[@]}\" > offered\n");
  const std::string call = "cd '" + ursula.folder().string() + "' && bash complete.bash";
  EXPECT_EQ(std::system(call.c_str()), 0);
  return matches("\n" + ursula.read("offered"), "([^\n]+)");
}

TEST(Completion, completesInBash) {
  const Program ursula;
  ursula.write("completion", ursula("docs --completion bash").out);
  EXPECT_THAT(offered(ursula, "ursula val"), ElementsAre("validate"));
  EXPECT_THAT(offered(ursula, "ursula validate --qu"), ElementsAre("--quiet"));
  EXPECT_THAT(offered(ursula, "ursula explain torque.t"), ElementsAre("torque.twin"));
  EXPECT_THAT(offered(ursula, "ursula validate complet"), testing::UnorderedElementsAre("completion", "complete.bash"));
}

}  // namespace
}  // namespace ursula
