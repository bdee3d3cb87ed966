#include "common/results/result_folder.hpp"

#include <limits>
#include <nlohmann/json.hpp>

#include "common/results/json.hpp"
#include "tests/unit/common/results/test_folder.hpp"

namespace lukou::results {
namespace {

namespace fs = std::filesystem;
using Folder = InTestFolder;

TEST_F(Folder, IsMadeWithTheFoldersAboveIt) {
  const auto result = ResultFolder::create(folder() / "a/b/c/");
  ASSERT_TRUE(result.ok()) << result.error().text();
  EXPECT_TRUE(fs::is_directory(folder() / "a/b/c"));
}

TEST_F(Folder, MayBeThereIfItIsEmpty) {
  fs::create_directory(folder() / "out");
  EXPECT_TRUE(ResultFolder::create(folder() / "out").ok());
}

TEST_F(Folder, ThatHoldsSomethingIsRefused) {
  fs::create_directory(folder() / "out");
  write("out/old.csv", "x");
  const auto result = ResultFolder::create(folder() / "out");
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().text(),
            (folder() / "out").string() + ": is not empty; results go into a new or an empty folder");
}

TEST_F(Folder, ThatIsAFileIsRefused) {
  write("out", "x");
  const auto result = ResultFolder::create(folder() / "out");
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().text(), (folder() / "out").string() + ": is no folder");
}

TEST_F(Folder, NamedByTimeAndPaceGetsANumberOnAClash) {
  const auto name = [&] {
    const auto result = ResultFolder::create_new(folder() / "result", "20300102-030405", "max");
    EXPECT_TRUE(result.ok());
    return result.value().path().filename().string();
  };
  EXPECT_EQ(name(), "20300102-030405-max");
  EXPECT_EQ(name(), "20300102-030405-max-2");
  EXPECT_EQ(name(), "20300102-030405-max-3");
}

TEST_F(Folder, ReplacesAFileAsAWhole) {
  const auto result = ResultFolder::create(folder() / "out");
  ASSERT_TRUE(result.ok());
  ASSERT_TRUE(result.value().write_file("summary.json", "old and long").ok());
  ASSERT_TRUE(result.value().write_file("summary.json", "new").ok());
  EXPECT_EQ(content("out/summary.json"), "new");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder() / "out"), fs::directory_iterator{}), 1)
      << "nothing but the file itself is left";
}

TEST_F(Folder, ThatIsGoneIsAnErrorOfWriting) {
  const auto written = write_file(folder() / "none" / "a.json", "x");
  ASSERT_FALSE(written.ok());
  EXPECT_EQ(written.error().text(),
            (folder() / "none/a.json.unfinished").string() + ": cannot be created: No such file or directory");
}

TEST(JsonText, KeepsTheOrderAndTheNumbers) {
  nlohmann::ordered_json json;
  json["zeta"] = 0.1;
  json["alpha"] = std::numeric_limits<double>::quiet_NaN();
  json["name"] = "\xff";  // not UTF-8: the replacement character
  EXPECT_EQ(json_text(json), "{\n  \"zeta\": 0.1,\n  \"alpha\": null,\n  \"name\": \"\xEF\xBF\xBD\"\n}\n");
}

}  // namespace
}  // namespace lukou::results
