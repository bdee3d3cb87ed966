#include "common/scenario/parse.hpp"

#include <google/protobuf/io/tokenizer.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "common/core/contract.hpp"
#include "common/scenario/wording.hpp"

namespace lukou::scenario {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::DescriptorPool;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::TextFormat;

constexpr int kNestingMax = 50;

/// The texts between double quotes in one of the parser's messages.
std::vector<std::string> quoted(std::string_view message) {
  std::vector<std::string> words;
  std::size_t from = message.find('"');
  while (from != std::string_view::npos) {
    const std::size_t to = message.find('"', from + 1);
    if (to == std::string_view::npos) break;
    words.emplace_back(message.substr(from + 1, to - from - 1));
    from = message.find('"', to + 1);
  }
  return words;
}

/// "signals.preset takes A, B; radio.preset takes C": the parser names a field, not its message.
std::string enums_of_field(const Descriptor* root, const std::string& field_name) {
  std::vector<std::string> takes;
  std::string last_type;
  for_each_field(root, "", [&](const std::string& path, const FieldDescriptor* field) {
    if (field->name() != field_name || field->enum_type() == nullptr) return;
    if (field->containing_type()->full_name() == last_type) return;
    last_type = field->containing_type()->full_name();
    takes.push_back(path + " takes " + joined(value_names(field->enum_type()), ", "));
  });
  return joined(takes, "; ");
}

/// The parser stands behind a word when it objects to it, at the next one, which may be lines further on: moves the
/// issue to where the word begins.
void move_to_word(ParseIssue& issue, std::string_view text, const std::string& word) {
  std::size_t begin = 0;
  for (int i = 1; i < issue.line && begin != std::string_view::npos; ++i) begin = text.find('\n', begin) + 1;
  const std::size_t here = std::min(begin + static_cast<std::size_t>(issue.column) - 1, text.size());
  std::size_t at = here;
  if (text.substr(here, word.size()) != word) at = text.substr(0, here).rfind(word);
  if (at == std::string_view::npos) return;
  const std::string_view before = text.substr(0, at);
  issue.line = static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1;
  const std::size_t line_begin = before.rfind('\n');
  issue.column = static_cast<int>(line_begin == std::string_view::npos ? at + 1 : at - line_begin);
}

/// Puts a message of the parser, about a text that is a `root`, into our words; one that is not known stays as it is.
std::string reworded(const std::string& message, const Descriptor* root) {
  const std::vector<std::string> words = quoted(message);
  if (message.find("has no field named") != std::string::npos && words.size() == 2) {
    const Descriptor* type = DescriptorPool::generated_pool()->FindMessageTypeByName(words[0]);
    if (type != nullptr) {
      return type->name() + " has no field `" + words[1] + "`" + suggestion(words[1], field_names(type));
    }
  }
  if (message.rfind("Unknown enumeration value of", 0) == 0 && words.size() == 2) {
    return "`" + words[0] + "` is no value of " + words[1] + ": " + enums_of_field(root, words[1]);
  }
  if (message.rfind("Non-repeated field", 0) == 0 && words.size() == 1) {
    return "`" + words[0] + "` stands here a second time; it may be given once";
  }
  if (message == "Expected identifier, got: ") return "the text ends here, but a `}` is missing";
  std::string text = message;
  if (message.rfind("Expected double, got", 0) == 0) text.replace(0, 15, "expected a number");
  if (message.rfind("Expected integer, got", 0) == 0) text.replace(0, 16, "expected a whole number");
  if (text.size() >= 2 && std::isupper(static_cast<unsigned char>(text[1])) == 0) {
    text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  }
  while (!text.empty() && text.back() == '.') text.pop_back();
  return text;
}

/// Whether the parser's message quotes the word that stands in front of the place that it reports.
bool is_about_a_word(const std::string& message) {
  return message.find("has no field named") != std::string::npos || message.rfind("Unknown enumeration", 0) == 0 ||
         message.rfind("Non-repeated field", 0) == 0;
}

class Collector final : public google::protobuf::io::ErrorCollector {
 public:
  Collector(std::string_view text, const Descriptor* root) : text_(text), root_(root) {}

  void AddError(int line, int column, const std::string& message) override {
    ParseIssue issue{line + 1, column + 1, reworded(message, root_)};
    const std::vector<std::string> words = quoted(message);
    if (line >= 0 && is_about_a_word(message) && !words.empty()) {
      const bool enumeration = message.rfind("Unknown enumeration", 0) == 0;
      move_to_word(issue, text_, enumeration ? words.front() : words.back());
    }
    issues.push_back(issue);
  }
  // Unknown fields come as warnings, so that one of them does not hide the others.
  void AddWarning(int line, int column, const std::string& message) override { AddError(line, column, message); }

  std::vector<ParseIssue> issues;

 private:
  std::string_view text_;
  const Descriptor* root_;
};

TextFormat::Parser strict_parser(Collector& collector) {
  TextFormat::Parser parser;
  parser.RecordErrorsTo(&collector);
  parser.AllowUnknownField(true);
  parser.SetRecursionLimit(kNestingMax);
  return parser;
}

}  // namespace

std::vector<ParseIssue> parse(const std::string& text, Message& message, TextFormat::ParseInfoTree& places) {
  Collector collector(text, message.GetDescriptor());
  TextFormat::Parser parser = strict_parser(collector);
  parser.WriteLocationsTo(&places);
  const bool parsed = parser.ParseFromString(text, &message);
  if (!parsed && collector.issues.empty()) collector.issues.push_back({0, 0, "is not Protobuf text format"});
  return collector.issues;
}

std::vector<ParseIssue> parse_value(const std::string& value, const FieldDescriptor* field, Message& message) {
  Collector collector(value, Scenario::descriptor());
  TextFormat::Parser parser = strict_parser(collector);
  const bool parsed = parser.ParseFieldValueFromString(value, field, &message);
  if (!parsed && collector.issues.empty()) collector.issues.push_back({0, 0, "there is more than one value"});
  return collector.issues;
}

}  // namespace lukou::scenario
