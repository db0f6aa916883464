#pragma once

#include <string>
#include <vector>

namespace ursula::report {

/// How many columns of a terminal UTF-8 takes, each character one.
std::size_t columnsOf(const std::string& text);

enum class Align { left, right };

/// `text` with spaces up to `width` columns.
std::string padded(const std::string& text, std::size_t width, Align align = Align::left);

/// Cells by rows, each column as wide as its widest cell, two spaces between, none at a line's end.
std::vector<std::string> alignedRows(const std::vector<std::vector<std::string>>& rows,
                                     const std::vector<Align>& columns);

/// `head`, then `text` from column `margin` on, in lines of at most 100 columns that end between words.
std::string wrapped(const std::string& head, std::size_t margin, const std::string& text);

/// Where colours are wanted, between the escapes that make it so and those that end it.
enum class Paint { good, bad, open, quiet, strong };
std::string painted(const std::string& text, Paint paint, bool coloured);

}  // namespace ursula::report
