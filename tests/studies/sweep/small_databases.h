#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>

#include "parts/sweep/sweep_database.h"

namespace ursula::test {

/// The identity of a sweep of four points.
inline SweepIdentity identity(const std::string& hash = "aa", int shard = 1, int shards = 1) {
  SweepIdentity out;
  out.hash = hash;
  out.version = "1.0";
  out.file = "s.toml";
  out.points = 4;
  out.shard = shard;
  out.shards = shards;
  out.keys = {"a.b"};
  return out;
}

inline SweepPoint point(std::int64_t id, double value = 1.5) {
  return {id, R"({"a.b":1})", "pass", 0.5, "", {{"tau", value, std::nan(""), ""}, {"check", 0.1, 0.2, "pass"}}};
}

/// All rows as text, without their seconds.
inline std::string rowsOf(const std::filesystem::path& file) {
  Sqlite database(file, Sqlite::Access::read);
  std::string out;
  Statement points(database, "SELECT id || parameters || verdict || coalesce(error, '-') FROM point");
  while (points.step()) out += points.text(0) + "\n";
  Statement results(database, "SELECT point || name || coalesce(value, '-') || coalesce(\"limit\", '-') FROM result");
  while (results.step()) out += results.text(0) + "\n";
  return out;
}

/// The number of points of a sound database.
inline std::int64_t pointsIn(const std::filesystem::path& file) {
  Sqlite database(file, Sqlite::Access::read);
  readIdentity(database);
  return database.number("SELECT count(*) FROM point");
}

}  // namespace ursula::test
