#include "services/console/page_folder.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace lukou::console {
namespace {

namespace fs = std::filesystem;

class PageFolderTest : public testing::Test {
 protected:
  PageFolderTest() {
    fs::create_directories(root_ / "page/assets");
    write("page/index.html", "<!doctype html>");
    write("page/assets/index-a_B1.js", "1;");
    write("page/.secret", "hidden");
    write("outside.txt", "outside");
  }
  ~PageFolderTest() override { fs::remove_all(root_); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(root_ / name) << text; }

  fs::path root_ = fs::temp_directory_path() / ("lukou-page-" + std::to_string(getpid()));
  PageFolder page_{root_ / "page"};
};

TEST_F(PageFolderTest, GivesFilesWithTheirType) {
  const PageFile index = page_.file("/");
  EXPECT_EQ(index.status, 200U);
  EXPECT_EQ(index.body, "<!doctype html>");
  EXPECT_EQ(index.type, "text/html; charset=utf-8");
  EXPECT_EQ(page_.file("/index.html?token=x").tag, index.tag);
  EXPECT_EQ(page_.file("/assets/index-a_B1.js").type, "text/javascript; charset=utf-8");
}

TEST_F(PageFolderTest, GivesAnotherTagToAnotherContent) {
  const std::string before = page_.file("/").tag;
  write("page/index.html", "<!doctype html><p>");
  EXPECT_NE(page_.file("/").tag, before);
}

TEST_F(PageFolderTest, GivesNothingFromOutsideAndNothingHidden) {
  for (const char* target : {"/../outside.txt", "/assets/../../outside.txt", "/%2e%2e/outside.txt", "//outside.txt",
                             "/.secret", "/assets/", "/assets", "", "outside.txt", "/a\\b", "/\xc3\xa4", "/no.html"}) {
    EXPECT_EQ(page_.file(target).status, 404U) << target;
  }
}

TEST_F(PageFolderTest, SaysHowToBuildAPageThatIsNotThere) {
  const PageFile missing = PageFolder(root_ / "nowhere").file("/");
  EXPECT_EQ(missing.status, 404U);
  EXPECT_NE(missing.body.find("launch_scripts/setup.sh"), std::string::npos);
}

}  // namespace
}  // namespace lukou::console
