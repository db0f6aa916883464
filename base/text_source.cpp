#include "base/text_source.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <vector>

#include "base/text.h"

namespace ursula {
namespace {

constexpr std::size_t piece = std::size_t{1} << 18;

/// No text has a zero byte; /dev/zero has nothing else.
void refuseZeroByte(const std::string& text, std::size_t from) {
  const std::size_t at = text.find('\0', from);
  if (at == std::string::npos) return;
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  const std::size_t before = text.rfind('\n', at);
  throw TextRefusal("a zero byte, expected text", line, before == std::string::npos ? at + 1 : at - before);
}

std::string readAll(std::FILE* in, const TextBounds& bounds) {
  std::string text;
  std::vector<char> buffer(piece);
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), in)) {
    const std::size_t before = text.size();
    text.append(buffer.data(), count);
    refuseZeroByte(text, before);
    if (text.size() > bounds.most_bytes)
      throw TextRefusal(
          fmt::format("more than {0} bytes, expected at most {0} of {1}", bounds.most_bytes, bounds.kind));
  }
  if (std::ferror(in) != 0) throw TextRefusal(fmt::format("cannot be read, expected {}", bounds.kind));
  return text;
}

constexpr int wait_for_writer = 500;  // ms

/// A pipe that nobody writes to would be waited for without end.
void refuseLonelyPipe(int file, const TextBounds& bounds) {
  pollfd ready = {file, POLLIN, 0};
  char none = 0;
  if (::poll(&ready, 1, wait_for_writer) == 0 && ::read(file, &none, 1) == 0)
    throw TextRefusal(fmt::format("a pipe that nobody writes to, expected {}", bounds.kind));
  ::fcntl(file, F_SETFL, ::fcntl(file, F_GETFL) & ~O_NONBLOCK);
}

/// Returns ", did you mean 'my.toml'?", of the names in the missing file's folder.
std::string nearName(const std::filesystem::path& file) {
  constexpr std::size_t most = 1000;
  std::vector<std::string> names;
  std::error_code error;
  std::filesystem::directory_iterator at(file.has_parent_path() ? file.parent_path() : ".", error);
  // A common extension would make short names alike.
  const auto near = [](const std::string& a, const std::string& b) { return a == b || !nearest(a, {b}).empty(); };
  for (; !error && at != std::filesystem::directory_iterator() && names.size() < most; at.increment(error)) {
    const std::filesystem::path& name = at->path();
    if (near(file.stem().string(), name.stem().string()) && near(file.extension().string(), name.extension().string()))
      names.push_back(name.filename().string());
  }
  std::sort(names.begin(), names.end());
  return didYouMean(file.filename().string(), names);
}

}  // namespace

void requirePath(const std::string& path) {
  if (path.empty()) throw TextRefusal("an empty path, expected a file");
  if (path.find('\0') != std::string::npos) throw TextRefusal("a path with a zero byte, expected one without");
}

std::string readText(const std::filesystem::path& file, const TextBounds& bounds) {
  requirePath(file.string());
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) throw TextRefusal(fmt::format("a folder, expected {}", bounds.kind));
  // Without O_NONBLOCK opening a named pipe waits for its writer.
  const int opened = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> in(opened < 0 ? nullptr : ::fdopen(opened, "rb"), &std::fclose);
  if (!in) {
    const bool is_missing = errno == ENOENT;
    throw TextRefusal(fmt::format("{}, expected {}{}", is_missing ? "no such file" : "cannot be read", bounds.kind,
                                  is_missing ? nearName(file) : ""));
  }
  refuseLonelyPipe(opened, bounds);
  return readAll(in.get(), bounds);
}

std::string readStandardInput(const TextBounds& bounds) { return readAll(stdin, bounds); }

namespace {

constexpr std::size_t most_before = 60, most_shown = 100;  // characters that fit in a terminal

/// Returns the UTF-8 characters of a line, with blanks for those that move the cursor.
std::vector<std::string> charactersOf(const std::string& line) {
  std::vector<std::string> out;
  for (const char byte : line) {
    const bool follows = (static_cast<unsigned char>(byte) & 0xC0) == 0x80;
    if (follows && !out.empty())
      out.back() += byte;
    else
      out.emplace_back(1, static_cast<unsigned char>(byte) < 0x20 ? ' ' : byte);
  }
  return out;
}

}  // namespace

std::string excerptOf(const std::string& text, std::size_t line, std::size_t column) {
  std::size_t begin = 0;
  for (std::size_t k = 1; k < line; ++k) {
    begin = text.find('\n', begin);
    if (begin == std::string::npos) return "";
    ++begin;
  }
  const std::vector<std::string> all =
      charactersOf(text.substr(begin, std::min(text.find('\n', begin), text.size()) - begin));
  const std::size_t at = std::min(std::max<std::size_t>(column, 1) - 1, all.size());
  const std::size_t from = at > most_before ? at - most_before : 0;
  std::string shown_line;
  for (std::size_t k = from; k < all.size() && k < from + most_shown; ++k) shown_line += all[k];
  const std::string number = std::to_string(line), gap(number.size() < 4 ? 4 - number.size() : 0, ' ');
  return gap + number + " | " + withoutControls(shown_line) + "\n" + std::string(gap.size() + number.size(), ' ') +
         " | " + std::string(at - from, ' ') + "^";
}

}  // namespace ursula
