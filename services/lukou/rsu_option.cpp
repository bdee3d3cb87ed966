#include "services/lukou/rsu_option.hpp"

#include <charconv>

namespace lukou {

RsuOption rsu_option(const std::string& text) {
  std::uint32_t index = 0;
  const char* end = text.data() + text.size();
  const auto [after, error] = std::from_chars(text.data(), end, index);
  if (error != std::errc{} || after == end || *after != '=') return {{}, text};
  return {index, std::string(after + 1, end)};
}

Expected<RsuOptions> rsu_options(const std::string& name, const std::vector<std::string>& texts) {
  RsuOptions options;
  for (const std::string& text : texts) {
    std::string where = name;
    where.append(" ").append(text);
    const RsuOption option = rsu_option(text);
    if (option.value.empty()) return Error{where, "is empty"};
    const bool fresh = option.rsu ? options.of.emplace(*option.rsu, option.value).second : options.all.empty();
    if (!fresh) {
      return Error{where,
                   option.rsu ? "is the second for RSU " + std::to_string(*option.rsu) : "is the second for all RSUs"};
    }
    if (!option.rsu) options.all = option.value;
  }
  return options;
}

Expected<std::string> computing_value(const std::string& text) {
  if (text == "free") return std::string("{mode: FREE}");
  if (text == "real") return std::string("{mode: REAL}");
  const Error wrong{"--rsu-time " + text, "must be free, declared:20ms (a whole number of milliseconds) or real"};
  const std::string head = "declared:";
  if (!text.starts_with(head) || !text.ends_with("ms")) return wrong;
  const std::string digits = text.substr(head.size(), text.size() - head.size() - 2);
  if (digits.empty() || digits.size() > 9 || digits.find_first_not_of("0123456789") != std::string::npos) return wrong;
  return "{mode: DECLARED declared_ms: " + digits + "}";
}

}  // namespace lukou
