#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "common/core/expected.hpp"

namespace lukou::report {

/// A file that comes whole or not at all: it is written under another name and gets its own at the end. Never replaces
/// what is there.
class OutputFile {
 public:
  /// Makes the folders above. Errors: the file is there already, or cannot be made.
  static Expected<OutputFile> create(const std::filesystem::path& file);
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&& other) noexcept;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  /// Without finish() nothing is left.
  ~OutputFile();

  /// Where the bytes go until the end; for a library that wants to open the file by itself.
  [[nodiscard]] const std::filesystem::path& unfinished() const { return unfinished_; }
  /// Puts bytes into a buffer, and on the disk when it is full.
  Expected<Done> write(std::string_view bytes);
  /// Writes the rest, waits until the disk has it, and gives the file its name.
  Expected<Done> finish();

 private:
  OutputFile(int file, std::filesystem::path path, std::filesystem::path unfinished);
  Expected<Done> flush();
  void abandon();

  int file_ = -1;
  std::filesystem::path path_;
  std::filesystem::path unfinished_;
  std::string buffer_;
};

/// A whole file at once.
Expected<Done> write_new_file(const std::filesystem::path& file, std::string_view content);

/// Gives what has been written its name, if nothing else has it by now. Errors: the disk, or the name is taken.
Expected<Done> give_name(const std::filesystem::path& unfinished, const std::filesystem::path& name);

}  // namespace lukou::report
