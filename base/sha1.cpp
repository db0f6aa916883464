#include "base/sha1.h"

#include <fmt/format.h>

#include <boost/uuid/detail/sha1.hpp>

namespace ursula {

std::string sha1(const std::string& text) {
  boost::uuids::detail::sha1 hash;
  hash.process_bytes(text.data(), text.size());
  boost::uuids::detail::sha1::digest_type digest;
  hash.get_digest(digest);
  std::string out;
  for (unsigned word : digest) out += fmt::format("{:08x}", word);
  return out;
}

}  // namespace ursula
