#include "services/console/viewer.hpp"

#include <gtest/gtest.h>

namespace lukou::console {
namespace {

Bytes words(std::size_t size) { return std::make_shared<const std::string>(size, 'x'); }

TEST(Viewer, GetsItsWordsInOrder) {
  Viewer viewer;
  EXPECT_EQ(viewer.pop(), nullptr);
  const Bytes first = words(1);
  const Bytes second = words(2);
  viewer.push(first);
  viewer.push(second);
  EXPECT_EQ(viewer.pop(), first);
  EXPECT_EQ(viewer.pop(), second);
  EXPECT_EQ(viewer.pop(), nullptr);
}

TEST(Viewer, IsTooSlowWithTooManyWordsOrBytes) {
  Viewer chatty;
  for (int i = 0; i < 512; ++i) chatty.push(words(1));
  EXPECT_FALSE(chatty.too_slow());
  chatty.push(words(1));
  EXPECT_TRUE(chatty.too_slow());
  static_cast<void>(chatty.pop());
  EXPECT_FALSE(chatty.too_slow());
  Viewer fat;
  for (int i = 0; i < 4; ++i) fat.push(words(1U << 20U));
  EXPECT_FALSE(fat.too_slow());
  fat.push(words(1));
  EXPECT_TRUE(fat.too_slow());
}

TEST(Viewer, WantsEachVersionOfAStateOnce) {
  Viewer viewer;
  EXPECT_FALSE(viewer.wants(Viewer::kStatus, 0)) << "there is none yet";
  EXPECT_TRUE(viewer.wants(Viewer::kStatus, 3));
  viewer.sent(Viewer::kStatus, 3);
  EXPECT_FALSE(viewer.wants(Viewer::kStatus, 3));
  EXPECT_TRUE(viewer.wants(Viewer::kStatus, 4));
}

TEST(Viewer, GetsNoThirdPictureBeforeOneIsDrawn) {
  Viewer viewer;
  viewer.sent(Viewer::kPicture, 1);
  EXPECT_TRUE(viewer.wants(Viewer::kPicture, 2));
  viewer.sent(Viewer::kPicture, 2);
  EXPECT_FALSE(viewer.wants(Viewer::kPicture, 3));
  EXPECT_TRUE(viewer.wants(Viewer::kStatistics, 1)) << "pictures alone wait";
  viewer.drawn();
  EXPECT_TRUE(viewer.wants(Viewer::kPicture, 3));
  for (int i = 0; i < 10; ++i) viewer.drawn();
  viewer.sent(Viewer::kPicture, 4);
  viewer.sent(Viewer::kPicture, 5);
  EXPECT_FALSE(viewer.wants(Viewer::kPicture, 6)) << "who says it ten times does not get ten more";
}

}  // namespace
}  // namespace lukou::console
