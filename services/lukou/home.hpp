#pragma once

#include <filesystem>

namespace lukou {

/// Where this program finds what belongs to it: in a build folder of the sources, or installed under a prefix.
struct Home {
  std::filesystem::path templates;    ///< of `lukou new`
  std::filesystem::path package;      ///< folder of LukouConfig.cmake
  std::filesystem::path python;       ///< folder of the Python module `lukou`
  std::filesystem::path report_page;  ///< folder of the charts' code for reports
};

Home find_home();

}  // namespace lukou
