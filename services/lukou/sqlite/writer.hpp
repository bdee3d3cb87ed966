#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "common/core/expected.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace lukou::sqlite {

/// What a cell of a table holds; nothing is NULL. A text must live until the row is inserted.
using Value = std::variant<std::monostate, std::int64_t, double, std::string_view>;

/// A new SQLite database that is filled in one go, without a journal: it should get its name when it is whole.
class Writer {
 public:
  /// The file must not be there, or be empty. The first error of this or any later call is kept; finish() tells it.
  explicit Writer(const std::filesystem::path& file);

  /// Any statements without a result.
  void execute(const std::string& statements);
  /// A row of a table, all of its columns.
  void insert(const std::string& table, std::span<const Value> values);
  void insert(const std::string& table, std::initializer_list<Value> values) {
    insert(table, std::span(values.begin(), values.size()));
  }
  /// Commits and closes.
  Expected<Done> finish();
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

 private:
  struct Close {
    void operator()(sqlite3* database) const;
    void operator()(sqlite3_stmt* statement) const;
  };
  void note(int code);

  std::filesystem::path file_;
  std::unique_ptr<sqlite3, Close> database_;
  std::map<std::string, std::unique_ptr<sqlite3_stmt, Close>> insertions_;  // by table; ended before the database
  std::optional<Error> error_;
};

/// An SQL literal of a name or a text.
std::string name_literal(const std::string& name);
std::string text_literal(const std::string& text);

}  // namespace lukou::sqlite
