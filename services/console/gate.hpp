#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lukou::console {

/// What a request for a file or a socket says of itself.
struct Visit {
  std::string_view host;    ///< header Host
  std::string_view origin;  ///< header Origin; empty: absent
  std::string_view target;  ///< path and query
  std::string_view cookie;  ///< header Cookie
  bool socket = false;      ///< wants to become a WebSocket
};

/// Who may come in. A page of another site, open in the same browser, must not reach the console: it could steer a run.
class Gate {
 public:
  /// `token`: without it nobody comes in; empty: none is needed, and only names of this host are answered to.
  explicit Gate(std::string token) : token_(std::move(token)) {}

  struct Verdict {
    unsigned status = 200;    ///< of HTTP: 200, 400, 401 or 403
    std::string_view why;     ///< in words; empty if the visit is allowed
    bool new_cookie = false;  ///< the token came in the query: the page's other files need it as a cookie
  };
  [[nodiscard]] Verdict check(const Visit& visit) const;
  [[nodiscard]] const std::string& token() const { return token_; }

 private:
  std::string token_;
};

/// Whether a text can be a token: 16 to 200 letters, digits, `-` or `_`, which an address and a cookie carry as they
/// are.
bool fit_for_token(std::string_view text);
/// Compares in a time that depends on the lengths alone.
bool equal_in_constant_time(std::string_view a, std::string_view b);
/// The value of a name in the query of a target, as it stands there; the first if there are several.
std::optional<std::string_view> query_value(std::string_view target, std::string_view name);
/// The value of a cookie.
std::optional<std::string_view> cookie_value(std::string_view cookies, std::string_view name);

/// Name of the cookie that holds the token.
inline constexpr std::string_view kTokenCookie = "lukou_token";

}  // namespace lukou::console
