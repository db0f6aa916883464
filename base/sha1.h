#pragma once

#include <string>

namespace ursula {

/// 40 hexadecimal digits, as `sha1sum` prints them.
std::string sha1(const std::string& text);

}  // namespace ursula
