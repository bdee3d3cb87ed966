#include "common/core/markup.hpp"

#include <gtest/gtest.h>

namespace lukou {
namespace {

TEST(MarkupText, IsTextBetweenTagsAndInQuotes) {
  EXPECT_EQ(markup_text(R"(a < b && c > "d")"), "a &lt; b &amp;&amp; c &gt; &quot;d&quot;");
  EXPECT_EQ(markup_text("第一行\n'2'"), "第一行\n'2'");
}

}  // namespace
}  // namespace lukou
