#pragma once

#include <iostream>

namespace ursula::dart_engine {

/// DART warns of each body without mass, which is meant.
class Silence {
 public:
  Silence() : before_(std::cerr.rdbuf(nullptr)) {}
  ~Silence() { std::cerr.rdbuf(before_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  std::streambuf* before_;
};

}  // namespace ursula::dart_engine
