#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace ursula {

/// Text of somebody else's for a message: control signs and what is no UTF-8 as \x1b, whole lines kept. What a terminal
/// would obey it cannot hold.
std::string withoutControls(std::string_view text);

/// The same for one cell or name: newlines escaped, too, and cut behind `most` bytes, which "…" says.
std::string shown(std::string_view text, std::size_t most = 80);

/// A whole path, as long as any can be: a newline in it makes no line of its own.
std::string shownPath(std::string_view path);

}  // namespace ursula
