#pragma once

#include <string>
#include <string_view>

namespace lukou {

/// A text as it stands between tags, or in the quotes of an attribute, of XML and HTML.
std::string markup_text(std::string_view text);

}  // namespace lukou
