#include <gtest/gtest.h>

#include "tests/determinism/golden.hpp"

namespace lukou::test {
namespace {

TEST(Golden, RunsGiveTheKnownBytes) {
  for (const GoldenRun& run : golden_runs()) EXPECT_EQ(fingerprint(run), run.golden) << run.name;
}

TEST(Golden, BytesAreTheSameOnAProcessorWithoutFusedMultiplyAdd) {
  // The C library picks its functions by the processor; this makes it pick those for a processor without FMA and AVX2.
  const bool has_fma = content("/proc/cpuinfo").find(" fma ") != std::string::npos;
  if (!has_fma) std::puts("note: this processor has no FMA, so the run below is the same as the run above");
  for (const GoldenRun& run : golden_runs()) {
    EXPECT_EQ(fingerprint(run, {"GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-AVX2"}), run.golden) << run.name;
  }
}

TEST(Golden, AnotherSeedGivesOtherBytes) {
  GoldenRun run = golden_runs().front();
  run.arguments.insert(run.arguments.end(), {"--set", "run.seed=2"});
  EXPECT_NE(fingerprint(run), run.golden);
}

}  // namespace
}  // namespace lukou::test
