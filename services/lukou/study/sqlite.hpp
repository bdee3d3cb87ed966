#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/core/expected.hpp"

struct sqlite3;

namespace lukou::studies {

/// What a cell of a table holds; nothing is NULL.
using SqlValue = std::variant<std::monostate, std::int64_t, double, std::string>;

template <class T>
SqlValue sql(const std::optional<T>& value) {
  return value ? SqlValue(*value) : SqlValue();
}
inline SqlValue sql(std::size_t value) { return static_cast<std::int64_t>(value); }
inline SqlValue sql(int value) { return std::int64_t{value}; }
inline SqlValue sql(bool value) { return std::int64_t{value ? 1 : 0}; }

/// A new SQLite database that is filled in one go.
class SqliteWriter {
 public:
  /// Replaces the file. The first error of any later call is kept; finish() tells it.
  explicit SqliteWriter(const std::filesystem::path& file);

  /// Any statements without a result.
  void execute(const std::string& statements);
  /// A row of a table, all of its columns.
  void insert(const std::string& table, const std::vector<SqlValue>& values);
  /// Commits and closes.
  Expected<Done> finish();

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  void note(int code);

  std::filesystem::path file_;
  std::unique_ptr<sqlite3, Close> database_;
  std::optional<Error> error_;
};

/// An SQL literal of a name or a text.
std::string sql_name(const std::string& name);
std::string sql_text(const std::string& text);

}  // namespace lukou::studies
