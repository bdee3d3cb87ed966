#pragma once

#include <string>
#include <utility>
#include <variant>

#include "common/core/contract.hpp"

namespace lukou {

/// What was wrong with an input: where it stands (`file:line:column`, a topic, a field) and what would be right.
struct Error {
  std::string where;  ///< may be empty
  std::string what;

  [[nodiscard]] std::string text() const { return where.empty() ? what : where + ": " + what; }
};

/// A value, or the error that stands in its place. For bad input from a file, the wire or the operator.
template <class T>
class [[nodiscard]] Expected {
 public:
  Expected(T value) : content_(std::in_place_index<0>, std::move(value)) {}
  Expected(Error error) : content_(std::in_place_index<1>, std::move(error)) {}

  [[nodiscard]] bool ok() const { return content_.index() == 0; }
  explicit operator bool() const { return ok(); }

  /// Requires ok().
  [[nodiscard]] T& value() & {
    LUKOU_EXPECT(ok());
    return *std::get_if<0>(&content_);
  }
  [[nodiscard]] const T& value() const& {
    LUKOU_EXPECT(ok());
    return *std::get_if<0>(&content_);
  }
  [[nodiscard]] T&& value() && {
    LUKOU_EXPECT(ok());
    return std::move(*std::get_if<0>(&content_));
  }
  /// Requires !ok().
  [[nodiscard]] const Error& error() const {
    LUKOU_EXPECT(!ok());
    return *std::get_if<1>(&content_);
  }

 private:
  std::variant<T, Error> content_;
};

/// For an operation that has nothing to give but its success.
struct Done {};

}  // namespace lukou
