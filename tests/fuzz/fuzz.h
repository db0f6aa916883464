#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

/// A target of libFuzzer: whatever the bytes, an error of the reader's own or an answer, and nothing else.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace ursula::fuzz {

/// Inputs that were read and not refused: none, and a target tests only how its reader refuses.
inline std::size_t accepted = 0;

inline std::string textOf(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Two files in one: before and after the first line of dashes.
inline std::pair<std::string, std::string> twoOf(const std::string& text) {
  const std::string between = "\n---\n";
  const std::size_t at = text.find(between);
  return at == std::string::npos ? std::pair{text, text}
                                 : std::pair{text.substr(0, at + 1), text.substr(at + between.size())};
}

}  // namespace ursula::fuzz
