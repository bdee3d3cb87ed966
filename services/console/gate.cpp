#include "services/console/gate.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace lukou::console {
namespace {

/// "127.0.0.1" of "127.0.0.1:8080", "[::1]" of "[::1]:8080".
std::string_view name_of(std::string_view host) {
  const std::size_t bracket = host.find(']');
  const std::size_t colon = host.find(':', bracket == std::string_view::npos ? 0 : bracket);
  return host.substr(0, colon);
}

bool names_this_host(std::string_view host) {
  constexpr std::array<std::string_view, 3> kNames = {"127.0.0.1", "localhost", "[::1]"};
  return std::ranges::find(kNames, name_of(host)) != kNames.end();
}

bool same_origin(std::string_view origin, std::string_view host) {
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (origin.starts_with(scheme) && origin.substr(scheme.size()) == host) return true;
  }
  return false;
}

}  // namespace

bool fit_for_token(std::string_view text) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  return text.size() >= 16 && text.size() <= 200 && std::ranges::all_of(text, plain);
}

bool equal_in_constant_time(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  std::uint8_t different = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    different =
        static_cast<std::uint8_t>(different | (static_cast<std::uint8_t>(a[i]) ^ static_cast<std::uint8_t>(b[i])));
  }
  return different == 0;
}

std::optional<std::string_view> query_value(std::string_view target, std::string_view name) {
  const std::size_t question = target.find('?');
  if (question == std::string_view::npos) return std::nullopt;
  std::string_view rest = target.substr(question + 1);
  while (!rest.empty()) {
    const std::string_view pair = rest.substr(0, rest.find('&'));
    if (pair.starts_with(name) && pair.substr(name.size()).starts_with('=')) return pair.substr(name.size() + 1);
    rest.remove_prefix(std::min(rest.size(), pair.size() + 1));
  }
  return std::nullopt;
}

std::optional<std::string_view> cookie_value(std::string_view cookies, std::string_view name) {
  while (!cookies.empty()) {
    std::string_view pair = cookies.substr(0, cookies.find(';'));
    cookies.remove_prefix(std::min(cookies.size(), pair.size() + 1));
    while (pair.starts_with(' ')) pair.remove_prefix(1);
    if (pair.starts_with(name) && pair.substr(name.size()).starts_with('=')) return pair.substr(name.size() + 1);
  }
  return std::nullopt;
}

Gate::Verdict Gate::check(const Visit& visit) const {
  if (visit.host.empty()) return {400, "the request names no host"};
  // A foreign site can let its own name point here; then its pages would pass for ours.
  if (token_.empty() && !names_this_host(visit.host)) {
    return {403, "without a token this console answers to 127.0.0.1 and localhost alone"};
  }
  if (visit.socket && visit.origin.empty()) return {403, "a socket is for pages: there is no Origin"};
  if (!visit.origin.empty() && !same_origin(visit.origin, visit.host)) {
    return {403, "a page of another site may not come in"};
  }
  if (token_.empty()) return {};
  if (const auto given = query_value(visit.target, "token"); given && equal_in_constant_time(*given, token_)) {
    return {.new_cookie = true};
  }
  if (const auto kept = cookie_value(visit.cookie, kTokenCookie); kept && equal_in_constant_time(*kept, token_)) {
    return {};
  }
  return {401, "this console needs its token: open the address that ends with ?token=..."};
}

}  // namespace lukou::console
