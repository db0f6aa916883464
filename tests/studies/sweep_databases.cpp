#include "tests/studies/sweep_databases.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace ursula::test {

SweepPoint& MadeSweep::add(const std::vector<double>& values, const std::string& verdict, const std::string& error) {
  SweepPoint point;
  point.id = static_cast<std::int64_t>(points.size());
  for (std::size_t k = 0; k < values.size(); ++k)
    point.parameters += fmt::format("{}\"{}\":{:.17g}", k == 0 ? "{" : ",", identity.keys[k], values[k]);
  point.parameters += "}";
  point.verdict = verdict;
  point.error = error;
  points.push_back(point);
  return points.back();
}

void MadeSweep::result(SweepPoint& point, const std::string& name, double value) {
  point.values.push_back({name, value, std::numeric_limits<double>::quiet_NaN(), ""});
}

void MadeSweep::check(SweepPoint& point, const std::string& name, double value, double limit,
                      const std::string& verdict) {
  point.values.push_back({name, value, limit, verdict});
}

std::unique_ptr<Sqlite> MadeSweep::written(const std::string& name) const {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / (name + ".db");
  for (const char* part : {"", "-wal", "-shm"}) std::filesystem::remove(file.string() + part);
  {
    SweepDatabase database(file, identity);
    for (const SweepPoint& point : points) database.add(point);
    database.commit();
  }
  return std::make_unique<Sqlite>(file, Sqlite::Access::read);
}

MadeSweep madeSweep(const std::string& what, const std::string& design, const std::vector<std::string>& keys,
                    std::int64_t points) {
  MadeSweep out;
  out.identity.text = out.identity.scenario = "text";
  out.identity.hash = "hash";
  out.identity.version = "1.2.3";
  out.identity.file = "sweeps/made.toml";
  out.identity.name = "made <b>by hand</b>";
  out.identity.what = what;
  out.identity.design = design;
  out.identity.points = points;
  out.identity.keys = keys;
  return out;
}

double Dice::roll() {  // splitmix64
  std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return static_cast<double>((z ^ (z >> 31U)) >> 11U) * 0x1p-53;
}

}  // namespace ursula::test
