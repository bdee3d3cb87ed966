#include "services/lukou/report/page/html.hpp"

#include "common/core/markup.hpp"

namespace lukou::report::html {
namespace {

/// Screen and paper. The choice of language needs no script: what is not chosen is not shown.
constexpr std::string_view kStyle = R"(
:root { --ink: #17202a; --muted: #55616e; --line: #d5dbe1; --ground: #eef1ef; --panel: #fff; --accent: #1f5fbf;
  --warn: #fff3d6; --bad: #fde8e6; color-scheme: light; }
* { box-sizing: border-box; }
body { margin: 0; background: var(--ground); color: var(--ink); font: 15px/1.5 system-ui, 'Segoe UI', Roboto, 'Noto Sans',
  'Noto Sans CJK SC', 'WenQuanYi Zen Hei', sans-serif; font-variant-numeric: tabular-nums; }
#language-en:checked ~ * .zh, #language-zh:checked ~ * .en { display: none; }
.choice { position: absolute; opacity: 0; pointer-events: none; }
header, main { max-width: 1120px; margin: 0 auto; padding: 0 24px; }
header { padding-top: 24px; }
header nav { float: right; display: flex; border: 1px solid #8b97a3; border-radius: 6px; overflow: hidden; }
header label { padding: 2px 12px; cursor: pointer; background: var(--panel); }
#language-en:checked ~ header label[for='language-en'], #language-zh:checked ~ header label[for='language-zh'] {
  background: var(--accent); color: #fff; }
#language-en:focus-visible ~ header label[for='language-en'], #language-zh:focus-visible ~ header label[for='language-zh'] {
  outline: 2px solid var(--accent); outline-offset: 1px; }
h1 { font-size: 26px; line-height: 1.25; margin: 0 0 4px; overflow-wrap: anywhere; }
h2 { font-size: 19px; margin: 0 0 8px; }
h3 { font-size: 15px; margin: 12px 0 0; }
p { margin: 4px 0; max-width: 78ch; }
.muted { color: var(--muted); }
section { background: var(--panel); border: 1px solid var(--line); border-radius: 8px; padding: 16px 20px; margin: 16px 0; }
section.warnings { background: var(--warn); }
section.bad { background: var(--bad); }
ul { margin: 4px 0; padding-left: 20px; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: 14px; }
th, td { padding: 2px 12px; border-bottom: 1px solid var(--line); text-align: left; vertical-align: top; }
th:first-child, td:first-child { padding-left: 0; }
.number { text-align: right; white-space: nowrap; }
code, pre { font-family: ui-monospace, 'DejaVu Sans Mono', 'Liberation Mono', monospace; font-size: 13px; }
code { overflow-wrap: anywhere; }
pre { background: var(--ground); padding: 12px; overflow-x: auto; margin: 8px 0; }
summary { cursor: pointer; }
figure { margin: 8px 0 0; }
.picture { overflow-x: auto; }
.picture svg { max-width: 100%; height: auto; }
.charts { display: none; }
.drawn .charts { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 440px), 1fr)); gap: 8px 24px; }
.drawn .picture.of-charts { display: none; }
.charts .names { font-size: 13px; color: var(--muted); }
@media print {
  @page { margin: 14mm; }
  body { background: #fff; font-size: 10pt; }
  header, main { max-width: none; padding: 0; }
  header nav { display: none; }
  section { border: 0; padding: 0; margin: 12pt 0; break-inside: avoid-page; }
  section.long { break-inside: auto; }
  h2, h3 { break-after: avoid; }
  figure { break-inside: avoid; }
  .drawn .charts { display: none; }
  .drawn .picture.of-charts { display: block; }
  .on-screen { display: none; }
  pre { white-space: pre-wrap; overflow-wrap: anywhere; }
}
)";

/// What stands inside <script> or <style> must not end it.
std::string inside(std::string_view text) {
  std::string safe;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find("</", from), text.size());
    safe.append(text, from, to - from);
    if (to < text.size()) safe += "<\\/";
    from = to + 2;
  }
  return safe;
}

std::string choice(Language language, std::string_view code, bool first) {
  const std::string id = "language-" + std::string(code);
  const std::string_view name = language == Language::kChinese ? "中文" : "English";
  return "<input class=\"choice\" type=\"radio\" name=\"language\" id=\"" + id + "\" value=\"" + std::string(code) +
         "\" aria-label=\"" + std::string(name) + "\"" + (first ? " checked" : "") + ">\n";
}

}  // namespace

std::string both(const Words& words) {
  return "<span class=\"en\" lang=\"en\">" + markup_text(words.en) + "</span><span class=\"zh\" lang=\"zh-CN\">" +
         markup_text(words.zh) + "</span>";
}

std::string element(std::string_view name, std::string_view content, std::string_view attributes) {
  std::string text = "<" + std::string(name);
  if (!attributes.empty()) text += " " + std::string(attributes);
  return text + ">" + std::string(content) + "</" + std::string(name) + ">";
}

std::string document(const Page& page) {
  const bool chinese = page.first == Language::kChinese;
  std::string html = "<!doctype html>\n<html lang=\"" + std::string(chinese ? "zh-CN" : "en") +
                     "\">\n<head>\n<meta charset=\"utf-8\">\n"
                     "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                     // Nothing comes from elsewhere, whoever opens the page.
                     "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
                     "style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:\">\n" +
                     element("title", markup_text(page.title.in(page.first))) + "\n<style>" + std::string(kStyle);
  html += inside(page.style) + "</style>\n</head>\n<body>\n";
  html += choice(Language::kEnglish, "en", !chinese) + choice(Language::kChinese, "zh", chinese);
  html +=
      "<header>\n<nav class=\"on-screen\"><label for=\"language-en\">English</label>"
      "<label for=\"language-zh\">中文</label></nav>\n" +
      page.head + "</header>\n<main>\n" + page.content + "</main>\n";
  if (!page.script.empty()) {
    html += "<script type=\"application/json\" id=\"lukou-data\">" + inside(page.data) + "</script>\n";
    html += "<script>" + inside(page.script) + "</script>\n";
  }
  return html + "</body>\n</html>\n";
}

}  // namespace lukou::report::html
