#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "base/utf8.h"

namespace ursula {

/// Makes every text and key of a document UTF-8, as utf8() does.
template <class Json>
Json inUtf8(const Json& json) {
  if (json.is_string()) return utf8(json.template get_ref<const std::string&>());
  if (!json.is_structured()) return json;
  Json out(json.type());
  for (const auto& [key, value] : json.items())
    if (json.is_array())
      out.push_back(inUtf8(value));
    else
      out[utf8(key)] = inUtf8(value);
  return out;
}

/// Writes a document in UTF-8, whatever bytes a file's name or a foreign header has; `indent` as for dump().
template <class Json>
std::string jsonText(const Json& json, int indent = -1) {
  try {
    return json.dump(indent);
  } catch (const typename Json::type_error&) {
    return inUtf8(json).dump(indent);
  }
}

}  // namespace ursula
