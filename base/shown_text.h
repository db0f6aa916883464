#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace ursula {

/// Makes foreign text safe for a message and a terminal. Control characters and invalid UTF-8 become \x1b and the like;
/// lines stay.
std::string withoutControls(std::string_view text);

/// The same for one cell or name: newlines are escaped, too. Text beyond `most` bytes is cut and marked by "…".
std::string shown(std::string_view text, std::size_t most = 80);

/// Returns a whole path of any length; a newline in it is escaped.
std::string shownPath(std::string_view path);

}  // namespace ursula
