#include "services/lukou/study/sqlite.hpp"

#include <sqlite3.h>

namespace lukou::studies {
namespace {

int bind(sqlite3_stmt* statement, int column, const SqlValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return sqlite3_bind_int64(statement, column, *whole);
  if (const auto* real = std::get_if<double>(&value)) return sqlite3_bind_double(statement, column, *real);
  if (const auto* text = std::get_if<std::string>(&value)) {
    // The text lives until the statement has run: no copy is needed.
    return sqlite3_bind_text(statement, column, text->c_str(), static_cast<int>(text->size()), nullptr);
  }
  return sqlite3_bind_null(statement, column);
}

std::string quoted(const std::string& text, char quote) {
  std::string safe(1, quote);
  for (const char c : text) {
    if (c == quote) safe += quote;
    safe += c;
  }
  return safe + quote;
}

}  // namespace

void SqliteWriter::Close::operator()(sqlite3* database) const { sqlite3_close(database); }

SqliteWriter::SqliteWriter(const std::filesystem::path& file) : file_(file) {
  std::error_code code;
  std::filesystem::remove(file, code);
  sqlite3* database = nullptr;
  const int opened = sqlite3_open(file.c_str(), &database);
  database_.reset(database);
  note(opened);
  // The file is renamed when it is whole, so a torn one is never seen.
  execute("PRAGMA journal_mode=OFF; PRAGMA synchronous=OFF; BEGIN");
}

void SqliteWriter::note(int code) {
  if (code == SQLITE_OK || code == SQLITE_DONE || error_) return;
  error_ = Error{file_.string(), database_ ? sqlite3_errmsg(database_.get()) : sqlite3_errstr(code)};
}

void SqliteWriter::execute(const std::string& statements) {
  if (error_) return;
  note(sqlite3_exec(database_.get(), statements.c_str(), nullptr, nullptr, nullptr));
}

void SqliteWriter::insert(const std::string& table, const std::vector<SqlValue>& values) {
  if (error_) return;
  std::string places;
  for (std::size_t i = 0; i < values.size(); ++i) places += i == 0 ? "?" : ",?";
  sqlite3_stmt* statement = nullptr;
  const std::string insertion = "INSERT INTO " + sql_name(table) + " VALUES (" + places + ")";
  note(sqlite3_prepare_v2(database_.get(), insertion.c_str(), -1, &statement, nullptr));
  for (std::size_t i = 0; i < values.size() && !error_; ++i) note(bind(statement, static_cast<int>(i) + 1, values[i]));
  if (!error_) note(sqlite3_step(statement));
  sqlite3_finalize(statement);
}

Expected<Done> SqliteWriter::finish() {
  execute("COMMIT");
  if (error_) return *error_;
  database_.reset();
  return Done{};
}

std::string sql_name(const std::string& name) { return quoted(name, '"'); }
std::string sql_text(const std::string& text) { return quoted(text, '\''); }

}  // namespace lukou::studies
