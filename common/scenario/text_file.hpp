#pragma once

// For this room and for others that read a text of their own: a message in Protobuf's text format, and where in the
// file its errors stand.

#include <google/protobuf/text_format.h>

#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

#include "common/core/expected.hpp"
#include "common/scenario/field_check.hpp"

namespace lukou::scenario {

/// A field that was set after the text had been read, and how errors name that.
struct Setting {
  FieldPath path;
  std::string label;  ///< "--set run.seed=x (1st --set)"
};

/// An error with the key that it is sorted by: the file from top to bottom, then defaults, then each setting.
struct Placed {
  std::tuple<int, std::size_t, int> order;
  std::string line;
};

/// An error about the setting of that index.
Placed placed(std::size_t setting, const std::string& line);
/// All of them in one, a line each, in their order.
Error as_error(std::vector<Placed> errors);

/// A text that a user wrote.
class TextFile {
 public:
  /// `origin` names the text in errors.
  explicit TextFile(std::string origin) : origin_(std::move(origin)) {}

  /// Reads the text into `message`, which is empty. The error lists everything that the parser did not like, each as
  /// `file:line:column: what`.
  Expected<Done> parse_into(google::protobuf::Message& message, const std::string& text);
  /// "file:line:column" of a field, or of the nearest message around it that stands in the file.
  [[nodiscard]] std::string where(const FieldPath& path) const;
  /// The finding with its place: that of the last setting that has to do with it, or in the file.
  [[nodiscard]] Placed placed(const Finding& finding, const std::vector<Setting>& settings = {}) const;

 private:
  std::string origin_;
  google::protobuf::TextFormat::ParseInfoTree places_;
};

}  // namespace lukou::scenario
