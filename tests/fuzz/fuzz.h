#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

/// A target of libFuzzer. Any bytes give an answer or the reader's own error, and nothing else.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace ursula::fuzz {

/// The number of accepted inputs. If it is 0, a target tests only refusals.
inline std::size_t accepted = 0;

inline std::string textOf(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Splits a text into two files at the first line of dashes.
inline std::pair<std::string, std::string> twoOf(const std::string& text) {
  const std::string between = "\n---\n";
  const std::size_t at = text.find(between);
  return at == std::string::npos ? std::pair{text, text}
                                 : std::pair{text.substr(0, at + 1), text.substr(at + between.size())};
}

}  // namespace ursula::fuzz
