// What identify does not reach yet; docs/identify.md has the figures.

#include "tests/studies/identify/paper_machine_log.h"

namespace ursula {
namespace {

using IdentifyOpen = Identify;

TEST_F(IdentifyOpen, elasticJointIsToldFromAllMassesAndInertias) {
  const IdentifyResult result = runWithCompliance();
  ASSERT_FALSE(result.causes.empty());
  EXPECT_TRUE(result.causes[0].outside);
}

}  // namespace
}  // namespace ursula
