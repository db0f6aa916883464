#include "validation/verdict/effort_words.h"

#include <cctype>
#include <cstring>
#include <string_view>
#include <utility>

namespace ursula {
namespace {

bool isOneOf(const char* list, char c) { return c != '\0' && std::strchr(list, c) != nullptr; }

bool isLetter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// Returns whether the word is part of a name: `torque.pointwise`, `--torques`, `[acceptance] torque`, `torques.csv`,
/// `id="efforts"`.
bool isOfName(std::string_view text, std::size_t begin, std::size_t end) {
  const char before = begin == 0 ? ' ' : text[begin - 1], after = end < text.size() ? text[end] : ' ';
  const bool begins = std::isupper(static_cast<unsigned char>(text[begin])) != 0;
  if (isLetter(before) || isOneOf("-_./#=", before) || (before == '"' && !begins)) return true;
  if (begin >= 2 && text[begin - 2] == ']') return true;
  if (isLetter(after) || isOneOf("_=/", after)) return true;
  return after == '.' && end + 1 < text.size() && isLetter(text[end + 1]);
}

void replaceWord(std::string_view word, const std::string& noun, std::string& text) {
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    const bool plural = end < text.size() && text[end] == 's';
    if (isOfName(text, at, plural ? end + 1 : end)) continue;
    std::string with = noun;
    if (std::isupper(static_cast<unsigned char>(word[0])) != 0)
      with[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(with[0])));
    const bool vowel = noun[0] == 'e' && at >= 2 && text[at - 1] == ' ' && isOneOf("aA", text[at - 2]) &&
                       (at == 2 || !isLetter(text[at - 3]));
    text.replace(at, word.size(), with);
    if (vowel) text.insert(at - 1, "n");
  }
}

}  // namespace

std::string effortNoun(const Motors& motors) {
  return allSlide(motors) ? "force" : anySlides(motors) ? "effort" : "torque";
}

std::string inEffortWords(const std::string& noun, const std::string& text) {
  if (noun == "torque") return text;
  std::string out = text;
  for (const std::string_view word : {"torque", "Torque"}) replaceWord(word, noun, out);
  if (noun != "force") return out;
  for (const auto& [an, a] : {std::pair("an effort", "a effort"), {"An effort", "A effort"}})
    for (std::size_t at = out.find(an); at != std::string::npos; at = out.find(an, at)) out.replace(at, 9, a);
  for (const std::string_view word : {"effort", "Effort"}) replaceWord(word, noun, out);
  return out;
}

void addEffortWords(ValidationResult& result) {
  const auto say = [&result](std::string& text) { text = inEffortWords(result.effort, text); };
  for (Check& check : result.checks) say(check.basis), say(check.why), say(check.off);
  for (Finding& finding : result.findings) say(finding.name), say(finding.words);
  say(result.cause_words.off), say(result.cause_words.cause);
  for (Event& event : result.events) say(event.what);
  for (Curve& curve : result.curves) {
    say(curve.title);
    for (CurveLine& line : curve.lines) say(line.label);
  }
}

}  // namespace ursula
