#pragma once

#include <filesystem>
#include <memory>

#include "services/lukou/report/export/sheets.hpp"

namespace lukou::report {

/// A folder with a CSV file for each sheet: commas, a line of names, `\n`, the fewest digits that give a number back.
/// Errors: the folder holds something.
Expected<std::unique_ptr<SheetSink>> csv_folder(const std::filesystem::path& folder);

}  // namespace lukou::report
