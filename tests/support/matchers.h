#pragma once

#include <gmock/gmock.h>

namespace ursula {

using testing::AllOf, testing::ElementsAre, testing::EndsWith, testing::HasSubstr, testing::Not, testing::StartsWith;

}  // namespace ursula
