// A disk that is full: a small file system in memory, which a mount namespace of the test's own needs root for.

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/system/program.hpp"

namespace lukou::test {
namespace {

class DiskOf : public testing::TestWithParam<const char*> {};

TEST_P(DiskOf, AFullDiskEndsTheRunWithItsReasonAndWholeRows) {
  if (geteuid() != 0) GTEST_SKIP() << "needs root: it mounts a file system";
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "disk");
  const std::string disk = folder / "disk";
  const std::string lukou_run = std::string(LUKOU_PROGRAM) + " run paper --duration 1200 --quiet --mode " + GetParam();
  Program run({"-m", "/bin/sh", "-c",
               "mount -t tmpfs -o size=400k lukou " + disk + " || exit 99; " + lukou_run + " --out " + disk +
                   "/r; code=$?; cp -r " + disk + "/r " + disk + "/../kept; exit $code"},
              {}, "/usr/bin/unshare");
  EXPECT_EQ(run.wait(120.0), 5) << run.err();
  EXPECT_NE(run.err().find("No space left on device"), std::string::npos) << run.err();
  // Rows are whole in any case. The manifest of the launcher, which writes it last, may have found no room.
  const std::string manifest = content(folder / "kept/manifest.json");
  const Finished inspection = lukou({"inspect", folder / "kept"});
  if (manifest.empty()) {
    EXPECT_NE(inspection.out.find("complete to step"), std::string::npos) << inspection.out;
  } else {
    EXPECT_NE(manifest.find(R"("ended_by": "disk")"), std::string::npos) << manifest;
    EXPECT_EQ(inspection.code, 0) << inspection.out << inspection.err;
  }
}

INSTANTIATE_TEST_SUITE_P(EachMode, DiskOf, testing::Values("processes", "in-process"), [](const auto& mode) {
  return mode.param == std::string("processes") ? "Processes" : "InProcess";
});

}  // namespace
}  // namespace lukou::test
