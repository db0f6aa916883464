#pragma once

#include <string>

namespace ursula {

/// Returns a text as UTF-8: a byte that is part of no UTF-8 character counts as Latin-1, in which many instruments
/// write µ and °.
std::string utf8(std::string text);

}  // namespace ursula
