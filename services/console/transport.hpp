#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

// The seam between the console and the net: who comes, what they say, what they get.

namespace lukou::console {

/// A connection of the page; counts from 1, never used again.
using ViewerId = std::uint32_t;

/// A message on its way; shared by all who get it.
using Bytes = std::shared_ptr<const std::string>;

/// Whom the transport serves: the hub.
class Visitors {
 public:
  virtual ~Visitors() = default;
  virtual ViewerId came() = 0;
  /// Returns false if the words make no sense: the connection is closed.
  virtual bool said(ViewerId viewer, std::string_view words) = 0;
  virtual void gone(ViewerId viewer) = 0;
  /// The next message for a viewer to whom nothing is under way; null: nothing new.
  virtual Bytes next(ViewerId viewer) = 0;
  /// Whether a viewer is so far behind that it is let go.
  [[nodiscard]] virtual bool too_slow(ViewerId viewer) const = 0;
};

/// Carries messages between viewers and their visitors' book. All in the caller's thread.
class Transport {
 public:
  virtual ~Transport() = default;
  [[nodiscard]] virtual std::uint16_t port() const = 0;
  /// Carries what there is; returns after something happened, or after `limit_s` of wall time.
  virtual void serve(double limit_s) = 0;
  /// Says good-bye to all viewers.
  virtual void close() = 0;
};

}  // namespace lukou::console
