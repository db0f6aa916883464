#pragma once

#include <boost/uuid/detail/sha1.hpp>
#include <string>

namespace ursula {

/// The SHA-1 hash of a text that comes in pieces.
class Sha1 {
 public:
  void add(const std::string& piece) { hash_.process_bytes(piece.data(), piece.size()); }
  /// Returns 40 hexadecimal digits, as `sha1sum` prints them. Call it once.
  std::string digits();

 private:
  boost::uuids::detail::sha1 hash_;
};

/// Returns the SHA-1 hash of a whole text.
std::string sha1(const std::string& text);

}  // namespace ursula
