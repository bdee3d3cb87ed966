#pragma once

#include <cstddef>
#include <vector>

#include "common/scenario/field_check.hpp"
#include "services/lukou/study/study.hpp"

namespace lukou::study {
class Study;  // idl/study.proto
}
namespace lukou::scenario {
class TextFile;
}

namespace lukou::studies {

/// The plain form of a parsed study with its defaults, but for the base scenario and the text. Adds what is wrong with
/// it, beyond the rules of its fields, to `findings`. The first `sets_of_file` settings stand in the file, the others
/// come from the command line.
Study plain_study(const study::Study& message, const scenario::TextFile& file, std::size_t sets_of_file,
                  std::vector<scenario::Finding>& findings);

}  // namespace lukou::studies
