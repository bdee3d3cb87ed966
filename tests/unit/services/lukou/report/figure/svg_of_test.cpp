#include <gtest/gtest.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <cmath>
#include <limits>
#include <sstream>

#include "services/lukou/report/figure/figure.hpp"
#include "services/lukou/report/figure/svg.hpp"

namespace lukou::figure {
namespace {

using Tree = boost::property_tree::ptree;

/// The document as a tree; throws if it is no XML.
Tree parsed(const std::string& svg) {
  std::istringstream stream(svg);
  Tree tree;
  boost::property_tree::read_xml(stream, tree);
  return tree;
}

/// Calls `visit` with name and content of every element.
template <class Visit>
void for_each_element(const Tree& tree, const Visit& visit) {
  for (const auto& [name, child] : tree) {
    if (name == "<xmlattr>") continue;
    visit(name, child);
    for_each_element(child, visit);
  }
}

std::vector<std::string> texts_of(const std::string& svg) {
  std::vector<std::string> texts;
  for_each_element(parsed(svg), [&](const std::string& name, const Tree& element) {
    if (name == "text" && element.get("<xmlattr>.aria-hidden", "") != "true") texts.push_back(element.data());
  });
  return texts;
}

int count(const std::string& svg, const std::string& element) {
  int found = 0;
  for_each_element(parsed(svg), [&](const std::string& name, const Tree&) { found += name == element ? 1 : 0; });
  return found;
}

bool contains(const std::vector<std::string>& texts, const std::string& text) {
  return std::find(texts.begin(), texts.end(), text) != texts.end();
}

/// One of each kind of layer.
Figure everything() {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  Cells cells{.x_edges = {0.0, 1.0, 2.0},
              .y_edges = {0.0, 1.0, 2.0},
              .values = {1.0, 2.0, 3.0, nothing},
              .texts = {"1", "2", "3", ""},
              .hovers = {"one", "two", "three", ""},
              .hatched = {false, true, false, false},
              .hatched_name = "not told apart",
              .scale = {.min = 0.0, .max = 4.0, .label = "gain [%]"}};
  return {
      .title = "A < B & \"C\"",
      .subtitle = "五个种子的平均值",
      .x = {.label = "time", .unit = "s"},
      .y = {.label = "queue", .unit = "veh"},
      .layers = {Line{.name = "mean", .points = {{0, 0}, {1, 1}, {nothing, 0}, {2, 1}, {2, 2}}, .markers = true},
                 Line{.name = "signal", .points = {{0, 0}, {1, 1}}, .steps = true},
                 Band{.name = "interval", .x = {0, 1}, .low = {0, 1}, .high = {1, 2}},
                 Scatter{.name = "runs", .points = {{0.5, 0.5}}, .look = 1},
                 Intervals{.intervals = {{{1, 1}, 0.5, 1.5}}}, Bars{.name = "bars", .bars = {{1, 0, 2}}, .width = 0.5},
                 Boxes{.name = "red", .boxes = {{0, 1, 0, 1}}, .colour = kRedLamp}, cells,
                 Contours{.name = "contours", .x = {0, 1}, .y = {0, 1}, .values = {0, 1, 0, 1}, .levels = {0.5}},
                 Rule{.name = "cliff", .at = 1.5, .vertical = true}, Note{.at = {1, 1}, .text = "here"}}};
}

TEST(SvgOf, IsXmlWithEveryTextOfTheFigure) {
  const std::string svg = svg_of(everything());
  const auto texts = texts_of(svg);
  for (const char* text : {"A < B & \"C\"", "五个种子的平均值", "time [s]", "queue [veh]", "mean", "signal", "interval",
                           "runs", "bars", "red", "contours", "cliff", "here", "not told apart", "gain [%]"}) {
    EXPECT_TRUE(contains(texts, text)) << text;
  }
  EXPECT_EQ(parsed(svg).get<std::string>("svg.title"), "A < B & \"C\"");
}

TEST(SvgOf, GivesTheSameBytesForTheSameFigure) { EXPECT_EQ(svg_of(everything()), svg_of(everything())); }

TEST(SvgOf, HasTheSizeInMillimetres) {
  const Tree tree = parsed(svg_of(Figure{.title = "empty", .size = {85.0, 66.0}}));
  EXPECT_EQ(tree.get<std::string>("svg.<xmlattr>.width"), "85mm");
  EXPECT_EQ(tree.get<std::string>("svg.<xmlattr>.height"), "66mm");
}

TEST(SvgOf, InterruptsALineWhereThereIsNoNumber) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  const Figure figure{.layers = {Line{.points = {{0, 0}, {1, 1}, {2, nothing}, {3, 1}, {4, 2}}}}};
  EXPECT_EQ(count(svg_of(figure), "polyline"), 2);
}

TEST(SvgOf, LeavesACellWithoutAValueEmpty) {
  Figure figure;
  Cells cells{.x_edges = {0, 1, 2}, .y_edges = {0, 1}, .values = {1.0, 2.0}, .hovers = {"a", "b"}};
  figure.layers = {cells};
  const int both = count(svg_of(figure), "rect");
  cells.values[1] = std::numeric_limits<double>::quiet_NaN();
  figure.layers = {cells};
  EXPECT_EQ(count(svg_of(figure), "rect"), both - 1);
}

TEST(SvgOf, ClipsWhatReachesBeyondAnAxisThatIsCutAndNothingElse) {
  Figure figure{.layers = {Line{.points = {{0, 0}, {1, 10}}}}};
  EXPECT_EQ(count(svg_of(figure), "svg"), 1);
  figure.y.max = 5.0;
  EXPECT_EQ(count(svg_of(figure), "svg"), 2);
}

TEST(SvgOf, PutsPanelsBesideAndBelowEachOther) {
  const std::vector<Figure> panels(3, Figure{.title = "a", .size = {80.0, 60.0}});
  const Tree tree = parsed(svg_of(panels, 2));
  EXPECT_EQ(tree.get<std::string>("svg.<xmlattr>.width"), "160mm");
  EXPECT_EQ(tree.get<std::string>("svg.<xmlattr>.height"), "120mm");
}

TEST(SvgOf, HasNoReferencesThatTwoFiguresOnAPageCouldConfuse) {
  const std::string svg = svg_of(everything());
  EXPECT_EQ(svg.find(" id="), std::string::npos);
  EXPECT_EQ(svg.find("url("), std::string::npos);
}

TEST(Hatching, StaysInItsRectangle) {
  Svg svg;
  svg.hatching({10.0, 20.0, 30.0, 5.0}, kGrey);
  const std::string path = parsed(svg.document(100, 100, "")).get<std::string>("svg.path.<xmlattr>.d");
  std::istringstream numbers(path);
  int lines = 0;
  for (char letter = 0; numbers >> letter;) {
    double x = 0.0;
    double y = 0.0;
    numbers >> x >> y;
    EXPECT_GE(x, 10.0 - 0.01);
    EXPECT_LE(x, 40.0 + 0.01);
    EXPECT_GE(y, 20.0 - 0.01);
    EXPECT_LE(y, 25.0 + 0.01);
    lines += letter == 'M' ? 1 : 0;
  }
  EXPECT_EQ(lines, 10);  // x + y from 30 to 65 in steps of 3.5: 31.5, 35, ... 63
}

TEST(TextWidth, CountsAChineseCharacterAsWideAsItIsHigh) {
  EXPECT_DOUBLE_EQ(text_width_pt("路口", 10.0), 20.0);
  EXPECT_GT(text_width_pt("WWW", 10.0), text_width_pt("iii", 10.0));
}

TEST(TextWidth, TakesBrokenUtf8AsItComes) { EXPECT_GT(text_width_pt("\xE8\xB7", 10.0), 0.0); }

TEST(Wrapped, BreaksBetweenWords) {
  const auto lines = wrapped("one two three", 10.0, text_width_pt("one two", 10.0));
  EXPECT_EQ(lines, (std::vector<std::string>{"one two", "three"}));
  EXPECT_EQ(wrapped("indivisible", 10.0, 1.0).size(), 1U);
  EXPECT_TRUE(wrapped("", 10.0, 100.0).empty());
}

}  // namespace
}  // namespace lukou::figure
