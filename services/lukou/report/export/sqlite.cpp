#include "services/lukou/report/export/sqlite.hpp"

#include <string>

#include "services/lukou/report/output_file.hpp"
#include "services/lukou/sqlite/writer.hpp"

namespace lukou::report {
namespace {

std::string_view type_of(CellKind kind) {
  switch (kind) {
    case CellKind::kWhole:
      return "INTEGER";
    case CellKind::kReal:
      return "REAL";
    case CellKind::kText:
      return "TEXT";
  }
  return "";
}

class SqliteFile final : public SheetSink {
 public:
  explicit SqliteFile(OutputFile file) : file_(std::move(file)), database_(file_.unfinished()) {}

  Expected<Done> open(SheetId id) override {
    const Sheet& of = sheet(id);
    std::string columns;
    for (const Column& column : of.columns) {
      columns += (columns.empty() ? "" : ", ") + std::string(column.name) + " " + std::string(type_of(column.kind));
    }
    database_.execute("CREATE TABLE " + std::string(of.name) + " (" + columns + ");");
    has_trajectories_ = has_trajectories_ || id == SheetId::kTrajectories;
    return state();
  }

  Expected<Done> row(SheetId id, std::span<const Cell> cells) override {
    database_.insert(std::string(sheet(id).name), cells);
    return state();
  }

  Expected<Done> finish() override {
    // What readers look for: one car, or one moment.
    if (has_trajectories_) {
      database_.execute(
          "CREATE INDEX trajectories_vehicle ON trajectories(vehicle, time_s);"
          "CREATE INDEX trajectories_time ON trajectories(time_s);");
    }
    if (!database_.finish()) return state();
    return file_.finish();
  }

  [[nodiscard]] Expected<Done> state() const {
    if (!database_.error()) return Done{};
    return Error{database_.error()->where, "cannot be written: " + database_.error()->what};
  }

 private:
  OutputFile file_;
  sqlite::Writer database_;  // ended before the file is taken away
  bool has_trajectories_ = false;
};

}  // namespace

Expected<std::unique_ptr<SheetSink>> sqlite_file(const std::filesystem::path& file) {
  auto output = OutputFile::create(file);
  if (!output) return output.error();
  auto database = std::make_unique<SqliteFile>(std::move(output).value());
  if (auto begun = database->state(); !begun) return begun.error();
  return std::unique_ptr<SheetSink>(std::move(database));
}

}  // namespace lukou::report
