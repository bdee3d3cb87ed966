#include "services/lukou/home.hpp"

namespace lukou {

Home find_home() {
  namespace fs = std::filesystem;
  const fs::path above = fs::read_symlink("/proc/self/exe").parent_path().parent_path();
  const fs::path sources = above / "../services/rsu/templates";
  if (fs::is_directory(sources)) {
    return {sources.lexically_normal(), above, above / "python", above / "report_page"};
  }
  const fs::path library = above / LUKOU_LIBRARY_FOLDER;
  return {above / "share/lukou/templates", library / "cmake/Lukou", library / "lukou/python",
          above / "share/lukou/report_page"};
}

}  // namespace lukou
