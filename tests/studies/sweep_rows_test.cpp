#include "parts/sweep/report/sweep_rows.h"

#include "parts/sweep/report/sweep_summary.h"
#include "tests/studies/sweep_databases.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

using test::MadeSweep;
using test::madeSweep;

TEST(SweepRows, RefuseADamagedPoint) {
  for (const char* parameters : {"{\"x\":", "[1]", "{\"y\":1}", "{\"x\":\"1\"}"}) {
    MadeSweep sweep = madeSweep("inverse", "random", {"x"}, 2);
    for (int k = 0; k < 2; ++k) MadeSweep::result(sweep.add({1}), "tau_1_Nm", 1);
    sweep.points.back().parameters = parameters;
    const auto database = sweep.written("damaged");
    try {
      summarise(*database);
      ADD_FAILURE() << parameters;
    } catch (const DatabaseError& error) {
      EXPECT_THAT(error.what(), HasSubstr("damaged.db: error: "));
      EXPECT_THAT(error.what(), HasSubstr("point 1"));
    }
  }
}

TEST(SweepRows, AreThoseOfOneMomentWhoeverWrites) {
  MadeSweep sweep = madeSweep("inverse", "random", {"x"}, 3);
  for (int k = 0; k < 2; ++k) MadeSweep::result(sweep.add({1.0 * k}), "tau_1_Nm", k);
  const auto database = sweep.written("snapshot");
  const auto count = [&](const auto& before_reading) {
    SweepRows rows(*database, sweep.identity.keys);
    before_reading();
    int read = 0;
    for (SweepRow row; rows.next(row); ++read) EXPECT_EQ(row.values.size(), 1U);
    return read;
  };
  EXPECT_EQ(count([&] {
              SweepDatabase writer(database->file(), sweep.identity);
              MadeSweep::result(sweep.add({7}), "a_new_name", 7);
              writer.add(sweep.points.back());
              writer.commit();
            }),
            2);
  EXPECT_EQ(count([] {}), 3);
}

}  // namespace
}  // namespace ursula
