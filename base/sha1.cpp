#include "base/sha1.h"

#include <fmt/format.h>

namespace ursula {

std::string Sha1::digits() {
  boost::uuids::detail::sha1::digest_type digest;
  hash_.get_digest(digest);
  std::string out;
  for (unsigned word : digest) out += fmt::format("{:08x}", word);
  return out;
}

std::string sha1(const std::string& text) {
  Sha1 hash;
  hash.add(text);
  return hash.digits();
}

}  // namespace ursula
