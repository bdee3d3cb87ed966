#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lukou::report {

/// What the texts of figures and reports are written in.
enum class Language : std::uint8_t { kEnglish = 0, kChinese = 1 };

/// One text in each language.
struct Words {
  std::string en;
  std::string zh;

  [[nodiscard]] const std::string& in(Language language) const { return language == Language::kChinese ? zh : en; }
};

/// A number with so many decimals: "17.23".
std::string fixed(double value, int decimals);
/// Thousands apart by a thin space: "3 321 422".
std::string grouped(std::int64_t count);

}  // namespace lukou::report
