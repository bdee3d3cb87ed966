#include "services/lukou/report/export/sqlite.hpp"

#include <sqlite3.h>

#include <array>
#include <string>

#include "services/lukou/report/output_file.hpp"

namespace lukou::report {
namespace {

struct CloseDatabase {
  void operator()(sqlite3* database) const { sqlite3_close(database); }
};
struct EndStatement {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Statement = std::unique_ptr<sqlite3_stmt, EndStatement>;

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
  explicit SqliteFile(OutputFile file) : file_(std::move(file)) {}

  Expected<Done> begin() {
    sqlite3* opened = nullptr;
    const int code = sqlite3_open(file_.unfinished().c_str(), &opened);
    database_.reset(opened);
    if (code != SQLITE_OK) return failure();
    // The file gets its name when it is whole: nobody needs a journal of it.
    return run("PRAGMA journal_mode=OFF; PRAGMA synchronous=OFF; BEGIN;");
  }

  Expected<Done> open(SheetId id) override {
    const Sheet& of = sheet(id);
    std::string columns;
    std::string places;
    for (const Column& column : of.columns) {
      const std::string separator = columns.empty() ? "" : ", ";
      columns += separator + std::string(column.name) + " " + std::string(type_of(column.kind));
      places += separator + "?";
    }
    const std::string name(of.name);
    if (auto made = run("CREATE TABLE " + name + " (" + columns + ");"); !made) return made;
    const std::string insert = "INSERT INTO " + name + " VALUES (" + places + ")";
    sqlite3_stmt* prepared = nullptr;
    const int code = sqlite3_prepare_v2(database_.get(), insert.c_str(), -1, &prepared, nullptr);
    inserts_[static_cast<std::size_t>(id)].reset(prepared);
    return code == SQLITE_OK ? Expected<Done>(Done{}) : failure();
  }

  Expected<Done> row(SheetId id, std::span<const Cell> cells) override {
    sqlite3_stmt* insert = inserts_[static_cast<std::size_t>(id)].get();
    int place = 0;
    for (const Cell& cell : cells) {
      ++place;
      if (const auto* whole = std::get_if<std::int64_t>(&cell)) {
        sqlite3_bind_int64(insert, place, *whole);
      } else if (const auto* number = std::get_if<double>(&cell)) {
        sqlite3_bind_double(insert, place, *number);
      } else if (const auto* text = std::get_if<std::string_view>(&cell)) {
        sqlite3_bind_text(insert, place, text->data(), static_cast<int>(text->size()), SQLITE_STATIC);
      } else {
        sqlite3_bind_null(insert, place);
      }
    }
    const bool done = sqlite3_step(insert) == SQLITE_DONE;
    sqlite3_reset(insert);
    return done ? Expected<Done>(Done{}) : failure();
  }

  Expected<Done> finish() override {
    // What readers look for: one car, or one moment.
    if (inserts_[static_cast<std::size_t>(SheetId::kTrajectories)]) {
      auto indexed =
          run("CREATE INDEX trajectories_vehicle ON trajectories(vehicle, time_s);"
              "CREATE INDEX trajectories_time ON trajectories(time_s);");
      if (!indexed) return indexed;
    }
    if (auto ended = run("COMMIT;"); !ended) return ended;
    for (Statement& insert : inserts_) insert.reset();
    database_.reset();
    return file_.finish();
  }

 private:
  Expected<Done> run(const std::string& statements) {
    const int code = sqlite3_exec(database_.get(), statements.c_str(), nullptr, nullptr, nullptr);
    return code == SQLITE_OK ? Expected<Done>(Done{}) : failure();
  }
  [[nodiscard]] Error failure() const {
    return {file_.unfinished().string(), std::string("cannot be written: ") + sqlite3_errmsg(database_.get())};
  }

  OutputFile file_;
  std::unique_ptr<sqlite3, CloseDatabase> database_;
  std::array<Statement, kSheets> inserts_;  // before the database is closed
};

}  // namespace

Expected<std::unique_ptr<SheetSink>> sqlite_file(const std::filesystem::path& file) {
  auto output = OutputFile::create(file);
  if (!output) return output.error();
  auto database = std::make_unique<SqliteFile>(std::move(output).value());
  if (auto begun = database->begin(); !begun) return begun.error();
  return std::unique_ptr<SheetSink>(std::move(database));
}

}  // namespace lukou::report
