#include "report/page/html_template.h"

#include <kainjow/mustache.hpp>
#include <stdexcept>

#include "report/text/text.h"

namespace ursula::report {
namespace {

namespace mustache = kainjow::mustache;

/// Mustache itself takes a name without a value for an empty text.
class StrictContext : public mustache::context<std::string> {
 public:
  using mustache::context<std::string>::context;

  const mustache::data* get(const std::string& name) const override {
    if (const mustache::data* value = mustache::context<std::string>::get(name)) return value;
    throw std::logic_error("template without a value for " + name);
  }
};

mustache::data textOrNot(const std::string& text) { return text.empty() ? mustache::data(false) : text; }

}  // namespace

struct HtmlValue::Data {
  mustache::data value;
};

HtmlValue::HtmlValue(const std::string& text) : data_(new Data{textOrNot(text)}) {}
HtmlValue::HtmlValue(const char* text) : HtmlValue(std::string(text)) {}
HtmlValue::HtmlValue(bool holds) : data_(new Data{mustache::data(holds)}) {}

HtmlValue::HtmlValue(const std::vector<HtmlValue>& list) {
  mustache::data value(mustache::data::type::list);
  for (const HtmlValue& each : list) value.push_back(each.data_->value);
  data_.reset(new Data{std::move(value)});
}

HtmlValue::HtmlValue(const std::vector<std::string>& texts)
    : HtmlValue(std::vector<HtmlValue>(texts.begin(), texts.end())) {}

HtmlValue::HtmlValue(std::initializer_list<std::pair<const char*, HtmlValue>> named) {
  mustache::data value;
  for (const auto& [name, each] : named) value.set(name, each.data_->value);
  data_.reset(new Data{std::move(value)});
}

std::string rendered(std::string_view html, const HtmlValue& values) {
  mustache::mustache page{std::string(html)};
  page.set_custom_escape(escaped);
  StrictContext context(&values.data_->value);
  std::string out = page.is_valid() ? page.render(context) : "";
  if (!page.is_valid()) throw std::logic_error("template: " + page.error_message());
  return out;
}

}  // namespace ursula::report
