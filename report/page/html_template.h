#pragma once

#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace ursula::report {

/// What a tag of a template stands for: text, a condition, a list, or values with names. An empty text is a condition
/// that does not hold, and a whole number is its digits.
class HtmlValue {
 public:
  HtmlValue(const std::string& text);
  HtmlValue(const char* text);
  HtmlValue(const std::vector<HtmlValue>& list);
  HtmlValue(const std::vector<std::string>& texts);
  HtmlValue(std::initializer_list<std::pair<const char*, HtmlValue>> named);
  HtmlValue(bool holds);
  template <class Whole, std::enable_if_t<std::is_integral_v<Whole>, int> = 0>
  HtmlValue(Whole value) : HtmlValue(std::to_string(value)) {}
  HtmlValue(double) = delete;  // because the digits are the caller's choice

 private:
  struct Data;
  friend std::string rendered(std::string_view html, const HtmlValue& values);

  std::shared_ptr<const Data> data_;
};

/// Returns a list with `of(item)` for each item.
template <class Items, class Of>
std::vector<HtmlValue> listOf(const Items& items, const Of& of) {
  std::vector<HtmlValue> out;
  for (const auto& item : items) out.push_back(of(item));
  return out;
}

/// Returns a mustache template with its tags replaced: {{name}} by the value as `escaped` returns it, {{{name}}} by the
/// value as it is, which must be HTML. Throws std::logic_error for a tag without a value or a broken template.
std::string rendered(std::string_view html, const HtmlValue& values);

}  // namespace ursula::report
