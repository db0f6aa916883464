#include "studies/sweep/wire.h"

#include <cstdint>
#include <cstring>
#include <utility>

namespace ursula {
namespace {

class Writer {
 public:
  template <class T>
  void plain(const T& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void text(const std::string& value) {
    plain(static_cast<std::uint32_t>(value.size()));
    bytes_ += value;
  }
  std::string bytes_;
};

class Reader {
 public:
  explicit Reader(const char* at) : at_(at) {}
  template <class T>
  void plain(T& value) {
    std::memcpy(&value, at_, sizeof value);
    at_ += sizeof value;
  }
  void text(std::string& value) {
    std::uint32_t size = 0;
    plain(size);
    value.assign(at_, size);
    at_ += size;
  }

 private:
  const char* at_;
};

/// Lists the fields of a point, for packing and unpacking.
template <class Stream, class Point>
void fields(Stream& stream, Point& point) {
  stream.plain(point.id);
  stream.plain(point.seconds);
  stream.text(point.parameters);
  stream.text(point.verdict);
  stream.text(point.error);
}

template <class Stream, class Value>
void valueFields(Stream& stream, Value& value) {
  stream.text(value.name);
  stream.plain(value.value);
  stream.plain(value.limit);
  stream.text(value.verdict);
}

}  // namespace

std::string packed(const SweepPoint& point) {
  Writer out;
  out.plain(std::uint32_t{0});
  fields(out, point);
  out.plain(static_cast<std::uint32_t>(point.values.size()));
  for (const SweepValue& value : point.values) valueFields(out, value);
  const auto size = static_cast<std::uint32_t>(out.bytes_.size() - sizeof(std::uint32_t));
  std::memcpy(out.bytes_.data(), &size, sizeof size);
  return std::move(out.bytes_);
}

bool Unpacker::next(SweepPoint& point) {
  std::uint32_t size = 0;
  const std::size_t there = bytes_.size() - taken_;
  if (there >= sizeof size) std::memcpy(&size, bytes_.data() + taken_, sizeof size);
  if (there < sizeof size || there - sizeof size < size) {
    bytes_.erase(0, std::exchange(taken_, 0));
    return false;
  }
  Reader in(bytes_.data() + taken_ + sizeof size);
  fields(in, point);
  std::uint32_t count = 0;
  in.plain(count);
  point.values.resize(count);
  for (SweepValue& value : point.values) valueFields(in, value);
  taken_ += sizeof size + size;
  return true;
}

}  // namespace ursula
