#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "common/core/expected.hpp"
#include "common/core/hash.hpp"
#include "common/core/step.hpp"

namespace lukou::results {

/// An append-only table (CSV, commas, "\n") that always holds whole rows on disk, even if the disk fills up or the
/// process dies. The bytes depend on the numbers alone: no locale, no rounding that differs between machines.
class TableWriter {
 public:
  /// Makes the file, which must not exist, with one line of column names. `columns` is written as it stands.
  static Expected<TableWriter> create(const std::filesystem::path& file, std::string_view columns);

  TableWriter(TableWriter&& other) noexcept;
  TableWriter& operator=(TableWriter&& other) noexcept;
  TableWriter(const TableWriter&) = delete;
  TableWriter& operator=(const TableWriter&) = delete;
  /// Closes the file; rows that have not been flushed are lost.
  ~TableWriter();

  /// The next cell of the row.
  void whole(std::int64_t number);
  void count(std::uint64_t number);
  /// A time that is a whole number of tenths of a second: 123 -> "12.3".
  void tenths(std::int64_t tenths_of_s);
  /// At most six decimals, without trailing zeros: "12.5", "3". Empty if it is not a finite number: not known.
  void real(double number);
  /// Must hold no comma, quote or line end.
  void name(std::string_view text);
  /// Ends the row. Requires at least one cell.
  void end_row();

  /// Writes all ended rows with one call; on failure the file is cut back to whole rows and the rows stay buffered.
  Expected<Done> flush();
  /// flush(), then waits until the disk has it all.
  Expected<Done> sync();

  [[nodiscard]] std::size_t buffered_bytes() const { return buffer_.size(); }
  [[nodiscard]] std::int64_t rows_flushed() const { return rows_flushed_; }
  /// SHA-256 of what has been flushed, header included.
  [[nodiscard]] std::string sha256() const { return hash_->hex(); }

 private:
  TableWriter(int file, std::filesystem::path path);
  void end_cell();

  int file_ = -1;
  std::filesystem::path path_;
  std::string buffer_;
  std::size_t whole_rows_size_ = 0;  ///< bytes of the buffer that are whole rows
  std::int64_t rows_buffered_ = 0;
  std::int64_t rows_flushed_ = 0;
  std::int64_t size_ = 0;  ///< bytes in the file
  std::unique_ptr<Sha256> hash_;
};

/// The text of TableWriter::real().
std::string real_text(double number);

}  // namespace lukou::results
