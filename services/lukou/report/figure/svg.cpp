#include "services/lukou/report/figure/svg.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "common/core/markup.hpp"

namespace lukou::figure {
namespace {

constexpr double kPtPerMm = 72.0 / 25.4;

/// Two decimals at most: a hundredth of a point is less than any printer resolves.
std::string number(double value) {
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), "%.2f", value);
  std::string cut = text.data();
  while (cut.back() == '0') cut.pop_back();
  if (cut.back() == '.') cut.pop_back();
  return cut == "-0" ? "0" : cut;
}

std::string attribute(std::string_view name, std::string_view value) {
  return " " + std::string(name) + "=\"" + std::string(value) + "\"";
}
std::string attribute(std::string_view name, double value) { return attribute(name, std::string_view(number(value))); }

std::string attributes(const Stroke& stroke) {
  std::string text = attribute("stroke", hex(stroke.colour)) + attribute("stroke-width", stroke.width_pt);
  if (!stroke.dashes.empty()) text += attribute("stroke-dasharray", stroke.dashes);
  return text;
}

std::string attributes(const Frame& frame) {
  return attribute("x", frame.left) + attribute("y", frame.top) + attribute("width", frame.width) +
         attribute("height", frame.height);
}

std::string places(std::span<const Point> points) {
  std::string text;
  for (const Point& point : points) text += (text.empty() ? "" : " ") + number(point.x) + "," + number(point.y);
  return text;
}

std::string_view name_of(Note::Anchor anchor) {
  switch (anchor) {
    case Note::Anchor::kStart:
      return "start";
    case Note::Anchor::kMiddle:
      return "middle";
    case Note::Anchor::kEnd:
      return "end";
  }
  return "start";
}

/// Code point at `at`, which moves on behind it; a broken one counts as one byte.
char32_t next_code_point(std::string_view text, std::size_t& at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(at);
  const std::size_t length = first < 0x80 ? 1 : first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : first >= 0xC0 ? 2 : 1;
  if (length == 1 || at + length > text.size()) {
    ++at;
    return first;
  }
  char32_t code = first & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) code = (code << 6U) | (byte(at + i) & 0x3FU);
  at += length;
  return code;
}

/// Advance of a letter in shares of the type size, from DejaVu Sans.
double advance(char32_t code) {
  if (code >= 0x2E80) return 1.0;  // Chinese and its punctuation
  if (code >= 0x80) return 0.7;
  const auto in = [code](std::string_view letters) {
    return letters.find(static_cast<char>(code)) != std::string_view::npos;
  };
  if (in("ijlI.,:;'|! ")) return 0.32;
  if (in("frt()[]{}/\\-\"*")) return 0.41;
  if (in("mMW%@")) return 0.95;
  if (in("wGOQDHNU+=<>_~#&")) return 0.82;
  return code >= 'A' && code <= 'Z' ? 0.69 : 0.62;
}

/// Chinese letters, without the punctuation, which stays with what is before it.
bool is_chinese(char32_t code) { return code >= 0x3400 && code < 0xFB00; }

/// Parts of a text between which a line may end, with the blanks behind them: words, and single letters of Chinese.
std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  std::size_t from = 0;
  for (std::size_t at = 0; at < text.size();) {
    const char32_t code = next_code_point(text, at);
    std::size_t behind = at;
    const char32_t next = at < text.size() ? next_code_point(text, behind) : U' ';
    const bool may_end = code == U' ' ? next != U' ' : is_chinese(next) && code >= 0x2E80;
    if (!may_end && at < text.size()) continue;
    words.push_back(text.substr(from, at - from));
    from = at;
  }
  return words;
}

}  // namespace

void Svg::line(Point from, Point to, const Stroke& stroke) {
  body_ += "<line" + attribute("x1", from.x) + attribute("y1", from.y) + attribute("x2", to.x) + attribute("y2", to.y) +
           attributes(stroke) + "/>\n";
}

void Svg::polyline(std::span<const Point> points, const Stroke& stroke) {
  body_ += "<polyline fill=\"none\" stroke-linejoin=\"round\"" + attributes(stroke) +
           attribute("points", std::string_view(places(points))) + "/>\n";
}

void Svg::polygon(std::span<const Point> points, Colour fill, double opacity) {
  body_ += "<polygon" + attribute("fill", hex(fill)) + attribute("fill-opacity", opacity) +
           attribute("points", std::string_view(places(points))) + "/>\n";
}

void Svg::rectangle(const Frame& frame, Colour fill, double opacity, std::string_view hover) {
  body_ += "<rect" + attributes(frame) + attribute("fill", hex(fill));
  if (opacity < 1.0) body_ += attribute("fill-opacity", opacity);
  body_ += hover.empty() ? "/>\n" : "><title>" + escaped(hover) + "</title></rect>\n";
}

void Svg::outline(const Frame& frame, const Stroke& stroke) {
  body_ += "<rect fill=\"none\"" + attributes(frame) + attributes(stroke) + "/>\n";
}

void Svg::hatching(const Frame& frame, Colour colour) {
  constexpr double kEvery_pt = 3.5;
  // On each line x + y is a constant; the same constants everywhere.
  std::string path;
  const auto last = static_cast<int>(std::floor((frame.right() + frame.bottom()) / kEvery_pt));
  for (auto i = static_cast<int>(std::ceil((frame.left + frame.top) / kEvery_pt)); i <= last; ++i) {
    const double sum = i * kEvery_pt;
    const double from = std::max(frame.left, sum - frame.bottom());
    const double to = std::min(frame.right(), sum - frame.top);
    path += "M" + number(from) + " " + number(sum - from) + "L" + number(to) + " " + number(sum - to);
  }
  // The mouse is meant for what lies below.
  body_ += "<path fill=\"none\" pointer-events=\"none\"" + attributes(Stroke{.colour = colour, .width_pt = 0.5}) +
           attribute("d", std::string_view(path)) + "/>\n";
}

void Svg::marker(Point at, Marker marker, double size_pt, Colour colour) {
  const double half = size_pt / 2.0;
  const auto shape = [&](std::vector<Point> corners) {
    for (Point& corner : corners) corner = {at.x + corner.x * half, at.y + corner.y * half};
    polygon(corners, colour, 1.0);
  };
  const auto strokes = [&](Point a, Point b) {
    const Stroke stroke{.colour = colour, .width_pt = size_pt * 0.28};
    line({at.x + a.x * half, at.y + a.y * half}, {at.x - a.x * half, at.y - a.y * half}, stroke);
    line({at.x + b.x * half, at.y + b.y * half}, {at.x - b.x * half, at.y - b.y * half}, stroke);
  };
  switch (marker) {
    case Marker::kCircle:
      body_ += "<circle" + attribute("cx", at.x) + attribute("cy", at.y) + attribute("r", half) +
               attribute("fill", hex(colour)) + "/>\n";
      break;
    case Marker::kSquare:
      return shape({{-0.9, -0.9}, {0.9, -0.9}, {0.9, 0.9}, {-0.9, 0.9}});
    case Marker::kTriangle:
      return shape({{-1.05, 0.85}, {1.05, 0.85}, {0.0, -1.0}});
    case Marker::kDiamond:
      return shape({{-1.1, 0.0}, {0.0, -1.25}, {1.1, 0.0}, {0.0, 1.25}});
    case Marker::kCross:
      return strokes({0.9, 0.9}, {0.9, -0.9});
    case Marker::kPlus:
      return strokes({1.1, 0.0}, {0.0, 1.1});
  }
}

void Svg::text(Point at, std::string_view text, const TextStyle& style) {
  if (text.empty()) return;
  std::string place = attribute("x", at.x) + attribute("y", at.y + 0.35 * style.size_pt);
  if (style.turn_deg != 0.0) {
    place += " transform=\"rotate(" + number(style.turn_deg) + " " + number(at.x) + " " + number(at.y) + ")\"";
  }
  std::string look = attribute("font-size", style.size_pt);
  if (style.anchor != Note::Anchor::kStart) look += attribute("text-anchor", name_of(style.anchor));
  if (style.bold) look += attribute("font-weight", std::string_view("bold"));
  look += " pointer-events=\"none\"";
  const std::string words = ">" + escaped(text) + "</text>\n";
  if (style.halo) {
    body_ += "<text aria-hidden=\"true\" stroke=\"#ffffff\" stroke-width=\"2\" stroke-linejoin=\"round\"" + place +
             look + attribute("fill", hex(kWhite)) + words;
  }
  body_ += "<text" + place + look + attribute("fill", hex(style.colour)) + words;
}

void Svg::begin_moved(Point by) { body_ += "<g transform=\"translate(" + number(by.x) + " " + number(by.y) + ")\">\n"; }

void Svg::begin_clipped(const Frame& frame) {
  body_ += "<svg overflow=\"hidden\"" + attributes(frame) + " viewBox=\"" + number(frame.left) + " " +
           number(frame.top) + " " + number(frame.width) + " " + number(frame.height) + "\">\n";
}

std::string Svg::document(double width_pt, double height_pt, std::string_view title) const {
  const std::string size = number(width_pt) + " " + number(height_pt);
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + number(width_pt / kPtPerMm) + "mm\" height=\"" +
         number(height_pt / kPtPerMm) + "mm\" viewBox=\"0 0 " + size +
         "\" role=\"img\" font-family=\"Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', 'Noto Sans CJK SC', "
         "'Microsoft YaHei', 'PingFang SC', 'WenQuanYi Zen Hei', sans-serif\">\n<title>" +
         escaped(title) + "</title>\n<rect width=\"" + number(width_pt) + "\" height=\"" + number(height_pt) +
         "\" fill=\"#ffffff\"/>\n" + body_ + "</svg>\n";
}

std::string escaped(std::string_view text) {
  // XML knows no other control characters than these of a layout, which a picture has not.
  std::string plain(text);
  for (char& c : plain)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  return markup_text(plain);
}

double text_width_pt(std::string_view text, double size_pt) {
  double width = 0.0;
  for (std::size_t at = 0; at < text.size();) width += advance(next_code_point(text, at));
  return width * size_pt;
}

std::vector<std::string> wrapped(const std::string& text, double size_pt, double width_pt) {
  // A blank behind the last word of a line may stand out.
  const auto trimmed = [](const std::string& line) { return line.substr(0, line.find_last_not_of(' ') + 1); };
  std::vector<std::string> lines;
  std::string line;
  for (const std::string_view word : words_of(text)) {
    const std::string longer = line + std::string(word);
    const bool fits = line.empty() || text_width_pt(trimmed(longer), size_pt) <= width_pt;
    if (!fits) lines.push_back(trimmed(line));
    line = fits ? longer : std::string(word);
  }
  if (!trimmed(line).empty()) lines.push_back(trimmed(line));
  return lines;
}

}  // namespace lukou::figure
