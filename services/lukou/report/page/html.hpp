#pragma once

#include <string>
#include <string_view>

#include "services/lukou/report/words.hpp"

namespace lukou::report::html {

/// Both languages of a text, of which the page shows one. The words themselves are text, not HTML.
std::string both(const Words& words);
/// <name attributes>content</name>; the content is HTML.
std::string element(std::string_view name, std::string_view content, std::string_view attributes = {});

/// A whole page in two languages: a choice of language at its top, its content, and nothing from elsewhere. `script`
/// and `style` come from the built page and may be empty; `data` is JSON for the script.
struct Page {
  Words title;
  Language first = Language::kEnglish;  ///< that it opens in
  std::string head;                     ///< HTML beside the choice of language
  std::string content;                  ///< HTML
  std::string script;
  std::string style;
  std::string data;
};
std::string document(const Page& page);

}  // namespace lukou::report::html
