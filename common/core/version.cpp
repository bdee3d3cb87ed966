#include "common/core/version.hpp"

namespace lukou {

std::string_view version() { return LUKOU_VERSION; }

}  // namespace lukou
