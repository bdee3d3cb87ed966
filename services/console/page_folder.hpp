#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace lukou::console {

/// A file of the page, or why there is none.
struct PageFile {
  unsigned status = 200;  ///< of HTTP: 200 or 404
  std::string type;       ///< of its content
  std::string body;
  std::string tag;  ///< changes when the body does
};

/// The built page. Files are read when they are asked for, so that a new build is seen at once.
class PageFolder {
 public:
  explicit PageFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}
  /// `target`: path and query. Only files below the folder are found, whatever stands in it.
  [[nodiscard]] PageFile file(std::string_view target) const;

 private:
  std::filesystem::path folder_;
};

/// The content type of a file by the end of its name.
std::string_view type_of(std::string_view name);

}  // namespace lukou::console
