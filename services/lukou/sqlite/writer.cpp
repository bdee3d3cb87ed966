#include "services/lukou/sqlite/writer.hpp"

#include <sqlite3.h>

namespace lukou::sqlite {
namespace {

int bind(sqlite3_stmt* statement, int column, const Value& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return sqlite3_bind_int64(statement, column, *whole);
  if (const auto* real = std::get_if<double>(&value)) return sqlite3_bind_double(statement, column, *real);
  if (const auto* text = std::get_if<std::string_view>(&value)) {
    // The text lives until the statement has run: no copy is needed.
    return sqlite3_bind_text(statement, column, text->data(), static_cast<int>(text->size()), nullptr);
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

void Writer::Close::operator()(sqlite3* database) const { sqlite3_close(database); }
void Writer::Close::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

Writer::Writer(const std::filesystem::path& file) : file_(file) {
  sqlite3* database = nullptr;
  const int opened = sqlite3_open(file.c_str(), &database);
  database_.reset(database);
  note(opened);
  execute("PRAGMA journal_mode=OFF; PRAGMA synchronous=OFF; BEGIN");
}

void Writer::note(int code) {
  if (code == SQLITE_OK || code == SQLITE_DONE || error_) return;
  error_ = Error{file_.string(), database_ ? sqlite3_errmsg(database_.get()) : sqlite3_errstr(code)};
}

void Writer::execute(const std::string& statements) {
  if (error_) return;
  note(sqlite3_exec(database_.get(), statements.c_str(), nullptr, nullptr, nullptr));
}

void Writer::insert(const std::string& table, std::span<const Value> values) {
  if (error_) return;
  auto& statement = insertions_[table];
  if (!statement) {
    std::string places;
    for (std::size_t i = 0; i < values.size(); ++i) places += i == 0 ? "?" : ",?";
    const std::string insertion = "INSERT INTO " + name_literal(table) + " VALUES (" + places + ")";
    sqlite3_stmt* prepared = nullptr;
    note(sqlite3_prepare_v2(database_.get(), insertion.c_str(), -1, &prepared, nullptr));
    statement.reset(prepared);
  }
  for (std::size_t i = 0; i < values.size() && !error_; ++i) {
    note(bind(statement.get(), static_cast<int>(i) + 1, values[i]));
  }
  if (error_) return;
  note(sqlite3_step(statement.get()));
  sqlite3_reset(statement.get());
}

Expected<Done> Writer::finish() {
  execute("COMMIT");
  if (error_) return *error_;
  insertions_.clear();
  database_.reset();
  return Done{};
}

std::string name_literal(const std::string& name) { return quoted(name, '"'); }
std::string text_literal(const std::string& text) { return quoted(text, '\''); }

}  // namespace lukou::sqlite
