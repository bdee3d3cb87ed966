#include "common/results/table.hpp"

#include <sys/resource.h>

#include <clocale>
#include <csignal>
#include <cstdint>
#include <limits>

#include "tests/unit/common/results/test_folder.hpp"

namespace lukou::results {
namespace {

TEST(RealText, HasAtMostSixDecimalsAndNoTrailingZeros) {
  EXPECT_EQ(real_text(12.5), "12.5");
  EXPECT_EQ(real_text(3.0), "3");
  EXPECT_EQ(real_text(1000000.0), "1000000");
  EXPECT_EQ(real_text(2.0 / 3.0), "0.666667");
  EXPECT_EQ(real_text(0.1 + 0.2), "0.3");
  EXPECT_EQ(real_text(-4.25), "-4.25");
  EXPECT_EQ(real_text(0.0), "0");
  EXPECT_EQ(real_text(-1e-9), "0");
  // 1/128 = 0.0078125 exactly, half way between two texts: to the even one.
  EXPECT_EQ(real_text(0.0078125), "0.007812");
  EXPECT_EQ(real_text(std::numeric_limits<double>::quiet_NaN()), "");
  EXPECT_EQ(real_text(std::numeric_limits<double>::infinity()), "");
}

using Table = InTestFolder;

TEST_F(Table, HoldsItsColumnsFromTheBeginning) {
  const auto table = TableWriter::create(folder() / "a.csv", "x,y");
  ASSERT_TRUE(table.ok());
  EXPECT_EQ(content("a.csv"), "x,y\n");
}

TEST_F(Table, WritesCellsOfEveryKind) {
  auto table = TableWriter::create(folder() / "a.csv", "a,b,c,d,e,f");
  ASSERT_TRUE(table.ok());
  table.value().whole(-5);
  table.value().count(18446744073709551615U);
  table.value().tenths(123);
  table.value().tenths(-4);
  table.value().name("WL");
  table.value().real(0.25);
  table.value().end_row();
  ASSERT_TRUE(table.value().flush().ok());
  EXPECT_EQ(content("a.csv"), "a,b,c,d,e,f\n-5,18446744073709551615,12.3,-0.4,WL,0.25\n");
}

TEST_F(Table, KeepsAnEmptyFirstCellEmpty) {
  auto table = TableWriter::create(folder() / "a.csv", "a,b");
  ASSERT_TRUE(table.ok());
  table.value().real(std::numeric_limits<double>::quiet_NaN());
  table.value().whole(1);
  table.value().end_row();
  ASSERT_TRUE(table.value().flush().ok());
  EXPECT_EQ(content("a.csv"), "a,b\n,1\n");
}

TEST_F(Table, WritesWholeRowsOnly) {
  auto table = TableWriter::create(folder() / "a.csv", "a,b");
  ASSERT_TRUE(table.ok());
  table.value().whole(1);
  table.value().whole(2);
  table.value().end_row();
  table.value().whole(3);
  ASSERT_TRUE(table.value().flush().ok());
  EXPECT_EQ(content("a.csv"), "a,b\n1,2\n");
  EXPECT_EQ(table.value().rows_flushed(), 1);
  table.value().whole(4);
  table.value().end_row();
  ASSERT_TRUE(table.value().flush().ok());
  EXPECT_EQ(content("a.csv"), "a,b\n1,2\n3,4\n");
  EXPECT_EQ(table.value().rows_flushed(), 2);
  EXPECT_EQ(table.value().sha256(), sha256_hex("a,b\n1,2\n3,4\n"));
}

TEST_F(Table, RefusesAFileThatIsThere) {
  write("a.csv", "old");
  const auto table = TableWriter::create(folder() / "a.csv", "a");
  ASSERT_FALSE(table.ok());
  EXPECT_EQ(table.error().text(), (folder() / "a.csv").string() + ": cannot be created: File exists");
  EXPECT_EQ(content("a.csv"), "old");
}

/// Lets no file grow above a number of bytes, as a full disk would.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    old_action_ = std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{bytes, old_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, old_action_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit old_{};
  void (*old_action_)(int) = nullptr;
};

TEST_F(Table, LeavesWholeRowsWhenTheDiskIsFullAndGoesOnWhenItIsNot) {
  auto table = TableWriter::create(folder() / "a.csv", "a");
  ASSERT_TRUE(table.ok());
  table.value().whole(11);
  table.value().end_row();
  ASSERT_TRUE(table.value().flush().ok());
  table.value().whole(22222);
  table.value().end_row();
  {
    const FileSizeLimit full(8);  // "a\n11\n" are 5 bytes: 3 of the next 6 fit
    const auto flushed = table.value().flush();
    ASSERT_FALSE(flushed.ok());
    EXPECT_EQ(flushed.error().text(), (folder() / "a.csv").string() + ": cannot be written: File too large");
    EXPECT_EQ(content("a.csv"), "a\n11\n");
    EXPECT_EQ(table.value().rows_flushed(), 1);
  }
  ASSERT_TRUE(table.value().flush().ok());
  EXPECT_EQ(content("a.csv"), "a\n11\n22222\n");
  EXPECT_EQ(table.value().sha256(), sha256_hex("a\n11\n22222\n"));
}

}  // namespace
}  // namespace lukou::results
