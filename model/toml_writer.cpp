#include "model/toml_writer.h"

#include <fmt/format.h>

#include <cctype>
#include <cstring>
#include <sstream>

#include "base/text.h"

namespace ursula {
namespace {

/// Shortens numbers: 0.7 instead of toml++'s 0.69999999999999996, the shortest that parses to the same number. Strings
/// stay.
std::string withShortNumbers(const std::string& toml) {
  std::string out;
  char quote = '\0';
  for (const char* at = toml.c_str(); *at != '\0';) {
    const bool begins = quote == '\0' && (std::isdigit(static_cast<unsigned char>(*at)) != 0) &&
                        (out.empty() || std::strchr(" [=,-+", out.back()) != nullptr);
    const LeadingNumber read =
        begins ? leadingNumber({at, static_cast<std::size_t>(toml.c_str() + toml.size() - at)}) : LeadingNumber();
    if (std::string_view(at, read.length).find('.') != std::string_view::npos) {
      const std::string number = fmt::format("{}", read.value);
      out += number + (number.find_first_of(".e") == std::string::npos ? ".0" : "");
      at += read.length;
      continue;
    }
    if (quote == *at)
      quote = '\0';
    else if (quote == '\0' && (*at == '\'' || *at == '"'))
      quote = *at;
    else if (quote == '"' && *at == '\\' && at[1] != '\0')
      out += *at++;
    out += *at++;
  }
  return out;
}

}  // namespace

std::string tomlText(const toml::table& document) {
  std::ostringstream out;
  out << document << '\n';
  return withShortNumbers(out.str());
}

}  // namespace ursula
