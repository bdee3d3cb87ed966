#pragma once

#include <string>

namespace lukou::launch {

/// A text as one word of a shell's line.
std::string shell_word(const std::string& text);

}  // namespace lukou::launch
