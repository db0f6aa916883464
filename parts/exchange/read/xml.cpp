#include "parts/exchange/read/xml.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

#include "base/text.h"

namespace ursula::exchange {
namespace {

constexpr std::string_view white = " \t\r\n\f\v";

std::string trimmed(std::string_view text) {
  const std::size_t from = text.find_first_not_of(white);
  if (from == std::string_view::npos) return "";
  return std::string(text.substr(from, text.find_last_not_of(white) - from + 1));
}

/// Visits the words between white space.
template <class Visit>
void eachWord(std::string_view text, const Visit& visit) {
  for (std::size_t i = text.find_first_not_of(white); i < text.size(); i = text.find_first_not_of(white, i)) {
    const std::size_t end = std::min(text.find_first_of(white, i), text.size());
    visit(text.substr(i, end - i));
    i = end;
  }
}

int lineAt(const std::string& text, std::size_t place) {
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(place), '\n'));
}

/// Counts tags and attributes before the text is parsed, because the parser is slow and takes much memory for huge
/// counts.
class Size {
 public:
  explicit Size(const std::string& text) : text_(text) {}

  void requireModest() {
    for (std::size_t at = text_.find('<'); at != std::string::npos; at = text_.find('<', at)) {
      if (text_.compare(at, 4, "<!--") == 0)
        at = behind("-->", at);
      else if (text_.compare(at, 9, "<![CDATA[") == 0)
        at = behind("]]>", at);
      else
        at = tag(at);
    }
  }

 private:
  std::size_t behind(const char* end, std::size_t at) const {
    const std::size_t found = text_.find(end, at);
    return found == std::string::npos ? text_.size() : found + 3;
  }

  std::size_t tag(std::size_t at) {
    if (text_.compare(at, 8, "<!ENTITY") == 0)
      throw ImportError("an entity is declared, expected a model without; none is expanded", lineAt(text_, at));
    if (++tags_ > most_tags)
      throw ImportError(fmt::format("more than {} tags, expected a model of one machine", most_tags),
                        lineAt(text_, at));
    std::size_t own = 0, i = at + 1;
    while (i < text_.size() && text_[i] != '>' && text_[i] != '<') {
      if (text_[i] == '"' || text_[i] == '\'') {
        ++own;
        i = std::min(text_.find(text_[i], i + 1), text_.size());
      }
      if (i < text_.size()) ++i;
    }
    attributes_ += own;
    if (own > most_attributes_of_one || attributes_ > most_attributes)
      throw ImportError(fmt::format("{} attributes in one tag and {} in all, expected at most {} and {}", own,
                                    attributes_, most_attributes_of_one, most_attributes),
                        lineAt(text_, at));
    return std::max(i, at + 1);
  }

  const std::string& text_;
  std::size_t tags_ = 0, attributes_ = 0;
};

}  // namespace

void requireModest(const std::string& text) { Size(text).requireModest(); }

void parseXml(const std::string& text, tinyxml2::XMLDocument& document) {
  document.Parse(text.data(), text.size());
  if (document.ErrorID() == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED)
    throw ImportError(fmt::format("elements nested deeper than {}, expected a model", TINYXML2_MAX_ELEMENT_DEPTH),
                      document.ErrorLineNum());
  if (document.Error())
    throw ImportError(fmt::format("not valid XML ({}), expected SDF, MJCF or URDF",
                                  tinyxml2::XMLDocument::ErrorIDToName(document.ErrorID())),
                      document.ErrorLineNum());
  if (document.RootElement() == nullptr) throw ImportError("nothing in it, expected SDF, MJCF or URDF", 1);
}

std::string named(const Element& element) {
  const char* name = element.Attribute("name");
  return name == nullptr ? fmt::format("<{}>", shown(element.Name()))
                         : fmt::format("<{} name=\"{}\">", shown(element.Name()), shown(name));
}

void refuse(const Element& element, const std::string& what) {
  throw ImportError(named(element) + ": " + what, element.GetLineNum());
}

std::string attribute(const Element& element, const char* name) {
  const char* found = element.Attribute(name);
  return found == nullptr ? "" : trimmed(found);
}

std::string requiredAttribute(const Element& element, const char* name) {
  const std::string found = attribute(element, name);
  if (found.empty()) refuse(element, fmt::format("no '{}', expected one", name));
  return found;
}

std::string textOf(const Element& element) {
  const tinyxml2::XMLText* found = nullptr;
  for (const tinyxml2::XMLNode* node = element.FirstChild(); node != nullptr; node = node->NextSibling()) {
    if (node->ToComment() != nullptr) continue;
    if (node->ToText() == nullptr || found != nullptr)
      refuse(element, "a text in pieces, of which readers take different ones, expected one text");
    found = node->ToText();
  }
  return found == nullptr ? "" : trimmed(found->Value());
}

std::string childText(const Element& element, const char* name) {
  const Element* child = onlyChild(element, name);
  return child == nullptr ? "" : textOf(*child);
}

const Element* onlyChild(const Element& element, const char* name) {
  const Element* child = element.FirstChildElement(name);
  if (child != nullptr && child->NextSiblingElement(name) != nullptr)
    refuse(element, fmt::format("a second <{}>, expected one", name));
  return child;
}

std::vector<double> numbersOf(const Element& at, std::string_view text, std::size_t count, const std::string& what,
                              double most) {
  std::vector<double> out;
  eachWord(text, [&](std::string_view word) {
    const LeadingNumber number = leadingNumber(word);
    if (number.length != word.size() || !std::isfinite(number.value))
      refuse(at, fmt::format("{} has '{}', expected finite decimal numbers", what, shown(word)));
    if (std::abs(number.value) > most)
      refuse(at, fmt::format("{} has {}, expected at most {:g} in size", what, shown(word), most));
    out.push_back(number.value);
    if (out.size() > most_numbers) refuse(at, fmt::format("{} has more than {} numbers", what, most_numbers));
  });
  if (count != 0 && out.size() != count)
    refuse(at, fmt::format("{} has {} number{}, expected {}", what, out.size(), out.size() == 1 ? "" : "s", count));
  return out;
}

double numberOf(const Element& at, std::string_view text, const std::string& what, double most) {
  return numbersOf(at, text, 1, what, most)[0];
}

Vector3d vectorOf(const Element& at, std::string_view text, const std::string& what) {
  const std::vector<double> v = numbersOf(at, text, 3, what);
  return {v[0], v[1], v[2]};
}

bool truthOf(const Element& at, const std::string& text, const std::string& what) {
  if (text == "true" || text == "1" || text == "True") return true;
  if (text == "false" || text == "0" || text == "False") return false;
  refuse(at, fmt::format("{} is '{}', expected true or false", what, shown(text)));
}

double halfLastDigit(std::string_view text) {
  double largest = 0;
  eachWord(text, [&largest](std::string_view word) {
    const std::size_t e = std::min(word.find_first_of("eE"), word.size());
    const std::size_t dot = word.substr(0, e).find('.');
    const double decimals = dot == std::string_view::npos ? 0 : static_cast<double>(e - dot - 1);
    const double exponent = e < word.size() ? leadingNumber(word.substr(e + 1)).value : 0;
    // A whole number, above all zero, says nothing about its precision.
    if (dot != std::string_view::npos || exponent != 0)
      largest = std::max(largest, 0.5 * std::pow(10.0, exponent - decimals));
  });
  return largest;
}

std::set<std::string> wordsOf(const std::string& text) {
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

void listUnknown(const Element& element, const std::set<std::string>& children, Assumptions& assumptions) {
  eachChild(element, nullptr, [&](const Element& child) {
    const std::string name = child.Name();
    if (children.count(name) == 0 && name.find(':') == std::string::npos)
      assumptions.push_back(
          {fmt::format("Nothing is known of <{}>, which is left out", shown(name)), named(element), 1, "1"});
  });
}

void listUnknownAttributes(const Element& element, const std::set<std::string>& attributes, Assumptions& assumptions) {
  for (const tinyxml2::XMLAttribute* a = element.FirstAttribute(); a != nullptr; a = a->Next())
    if (attributes.count(a->Name()) == 0)
      assumptions.push_back({fmt::format("Nothing is known of the attribute {}, which is left out", shown(a->Name())),
                             named(element), 1, "1"});
}

void refuseCouplings(const Element& element, const std::set<std::string>& children,
                     const std::function<bool(const std::string&)>& is_machines) {
  static const std::set<std::string> harmless =
      wordsOf("group group_state disable_collisions drake:collision_filter_group");
  std::set<std::string> found;
  const std::function<void(const Element&)> gather = [&](const Element& e) {
    const auto take = [&](const char* text) {
      if (text != nullptr && is_machines(trimmed(text))) found.insert(trimmed(text));
    };
    for (const tinyxml2::XMLAttribute* a = e.FirstAttribute(); a != nullptr; a = a->Next()) take(a->Value());
    take(e.GetText());
    eachChild(e, nullptr, gather);
  };
  eachChild(element, nullptr, [&](const Element& child) {
    if (children.count(child.Name()) != 0 || harmless.count(child.Name()) != 0) return;
    found.clear();
    gather(child);
    if (found.size() >= 2)
      refuse(child,
             fmt::format("nothing is known of this element, which names {} and {} and may couple them; expected a "
                         "file without it, or one that says it in known words",
                         shown(*found.begin()), shown(*std::next(found.begin()))));
  });
}

std::string nameOr(const Element& element, const std::string& kind) {
  if (const std::string name = attribute(element, "name"); !name.empty()) return name;
  if (element.GetLineNum() > 0) return fmt::format("{} of line {}", kind, element.GetLineNum());
  for (const tinyxml2::XMLNode* node = element.Parent(); node != nullptr && node->ToElement(); node = node->Parent())
    if (const std::string name = attribute(*node->ToElement(), "name"); !name.empty())
      return fmt::format("{} of {}", kind, name);
  return kind + " of an included file";
}

GraphJoint jointAt(const Element& element, const std::string& name, JointKind kind) {
  GraphJoint out;
  out.name = name;
  out.line = element.GetLineNum();
  out.kind = kind;
  return out;
}

}  // namespace ursula::exchange
