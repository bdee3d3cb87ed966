#pragma once

#include <filesystem>
#include <memory>

#include "services/lukou/report/export/sheets.hpp"

namespace lukou::report {

/// An SQLite database with a table for each sheet, and indexes by vehicle and time. Errors: the file is there already.
Expected<std::unique_ptr<SheetSink>> sqlite_file(const std::filesystem::path& file);

}  // namespace lukou::report
