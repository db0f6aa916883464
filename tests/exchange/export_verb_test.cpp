// ursula export, as a user calls it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/end_to_end/program.h"

namespace ursula {
namespace {

using testing::HasSubstr, testing::IsEmpty, testing::StartsWith;

TEST(ExportVerb, WritesToStandardOutputOrToAFile) {
  const Program ursula;
  for (const std::string format : {"sdf", "mjcf", "urdf"}) {
    const UrsulaRun shown = ursula("export " + helix + " --format " + format);
    const UrsulaRun kept = ursula("export " + helix + " --format " + format + " --out models/machine.xml");
    EXPECT_EQ(shown.exit_code, 0) << shown.err;
    EXPECT_EQ(kept.exit_code, 0) << kept.err;
    EXPECT_THAT(kept.out, IsEmpty());
    EXPECT_THAT(shown.out, StartsWith("<?xml"));
    EXPECT_EQ(ursula.read("models/machine.xml"), shown.out);
    EXPECT_THAT(
        shown.err,
        HasSubstr("note: trajectory: The file has the machine at its first instant; it leaves out the motion ("));
  }
}

TEST(ExportVerb, RefusesWhatItCannotWrite) {
  const Program ursula;
  const UrsulaRun format = ursula.ending(2, "export " + helix + " --format obj");
  EXPECT_THAT(format.err, HasSubstr("mjcf|sdf|urdf"));
  ursula.ending(2, "export " + helix);
  std::string away = Program::shipped("hold.toml");
  const std::size_t at = away.find("position = ");
  ASSERT_NE(at, std::string::npos);
  away.replace(at, away.find('\n', at) - at, "position = [0.0, 0.0, 50.0]");
  ursula.write("away.toml", away);
  const UrsulaRun far = ursula.ending(2, "export away.toml --format sdf --out far.sdf");
  EXPECT_THAT(far.err, HasSubstr("away.toml:"));
  EXPECT_THAT(far.err, HasSubstr("leg 1 would have to reach over"));
  EXPECT_FALSE(std::filesystem::exists(ursula.folder() / "far.sdf"));
}

}  // namespace
}  // namespace ursula
