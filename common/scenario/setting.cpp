#include "common/scenario/setting.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

#include "common/scenario/parse.hpp"
#include "common/scenario/radio_preset.hpp"
#include "common/scenario/wording.hpp"

namespace lukou::scenario {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

/// "name" or "name[3]".
struct Token {
  std::string name;
  std::optional<int> index;
};

std::optional<Token> token_of(std::string_view text) {
  const std::size_t bracket = text.find('[');
  Token token{std::string(text.substr(0, bracket)), std::nullopt};
  if (token.name.empty()) return std::nullopt;
  if (bracket == std::string_view::npos) return token;
  if (text.back() != ']') return std::nullopt;
  const std::string_view digits = text.substr(bracket + 1, text.size() - bracket - 2);
  int index = 0;
  const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), index);
  if (result.ec != std::errc{} || result.ptr != digits.data() + digits.size() || index < 0) return std::nullopt;
  token.index = index;
  return token;
}

Expected<std::vector<Token>> tokens_of(std::string_view path) {
  std::vector<Token> tokens;
  std::size_t from = 0;
  while (from <= path.size()) {
    const std::size_t to = std::min(path.find('.', from), path.size());
    const auto token = token_of(path.substr(from, to - from));
    if (!token) return Error{"", "`" + std::string(path) + "` is no path; write it as in a.b[0].c"};
    tokens.push_back(*token);
    from = to + 1;
  }
  return tokens;
}

/// Checks a token against the message that it is looked up in. Returns its segment.
Expected<PathSegment> segment_of(const Token& token, const Message& message, const FieldPath& so_far) {
  const Descriptor* type = message.GetDescriptor();
  const FieldDescriptor* field = type->FindFieldByName(token.name);
  if (field == nullptr) {
    const std::string owner = so_far.empty() ? "a scenario" : text(so_far);
    return Error{"", owner + " has no field `" + token.name + "`" + suggestion(token.name, field_names(type))};
  }
  const std::string path = text(extended(so_far, field));
  if (!field->is_repeated()) {
    if (token.index) return Error{"", path + " is no list; leave the index out"};
    return PathSegment{field, -1};
  }
  const int size = count(message, field);
  if (!token.index) return Error{"", path + " is a list; name one of its entries, " + path + "[0]"};
  if (*token.index > size) {
    return Error{"", path + " has " + std::to_string(size) + (size == 1 ? " entry" : " entries") +
                         "; the next one is " + path + "[" + std::to_string(size) + "]"};
  }
  return PathSegment{field, *token.index};
}

/// The sub-message that a segment names; created if it is absent or one past the end.
Message& entered(Message& message, const PathSegment& segment) {
  const auto* reflection = message.GetReflection();
  if (segment.index < 0) return *reflection->MutableMessage(&message, segment.field);
  if (segment.index < reflection->FieldSize(message, segment.field)) {
    return *reflection->MutableRepeatedMessage(&message, segment.field, segment.index);
  }
  return *reflection->AddMessage(&message, segment.field);
}

/// A demand and a latency have one of three arms; which other one stands in the way, if any.
std::optional<Error> arm_in_the_way(const Message& message, const PathSegment& segment, const FieldPath& so_far) {
  const bool of_demand = is_demand_arm(segment.field);
  if (!of_demand && !is_latency_arm(segment.field)) return std::nullopt;
  const Descriptor* type = message.GetDescriptor();
  for (int i = 0; i < type->field_count(); ++i) {
    const FieldDescriptor* other = type->field(i);
    if (other == segment.field || (of_demand ? !is_demand_arm(other) : !is_latency_arm(other)) ||
        !has(message, other)) {
      continue;
    }
    return Error{"",
                 text(so_far) + " already has " + other->name() +
                     (of_demand ? "; a demand is one of flow_veh_per_h, flow_series and arrivals_csv (to replace it: "
                                : "; a latency is one of constant_ms, uniform and gamma (to replace it: ") +
                     text(so_far) + "={...})"};
  }
  return std::nullopt;
}

/// A plan stands in the place of a preset and the other way round: the one set last holds.
void drop_replaced(Message& message, const PathSegment& segment) {
  if (segment.field->containing_type() != Signals::descriptor()) return;
  const char* replaced = segment.field->name() == "preset" ? "plan" : segment.field->name() == "plan" ? "preset" : "";
  const FieldDescriptor* field = Signals::descriptor()->FindFieldByName(replaced);
  if (field != nullptr) message.GetReflection()->ClearField(&message, field);
}

bool is_quoted(std::string_view value) {
  return value.size() >= 2 && (value.front() == '"' || value.front() == '\'') && value.back() == value.front();
}

/// Sets a singular field, or appends to a repeated one. Returns what is wrong with the value, if anything.
std::vector<ParseIssue> append_value(std::string value, const FieldDescriptor* field, Message& message) {
  const auto* reflection = message.GetReflection();
  if (field->cpp_type() == FieldDescriptor::CPPTYPE_STRING && !is_quoted(value)) {
    if (field->is_repeated()) {
      reflection->AddString(&message, field, value);
    } else {
      reflection->SetString(&message, field, value);
    }
    return {};
  }
  if (field->enum_type() != nullptr && is_quoted(value)) value = value.substr(1, value.size() - 2);
  return parse_value(value, field, message);
}

std::optional<Error> assign(Message& message, const FieldPath& path, const std::string& value) {
  const PathSegment& segment = path.back();
  const FieldDescriptor* field = segment.field;
  const auto* reflection = message.GetReflection();
  if (!field->is_repeated()) reflection->ClearField(&message, field);
  const auto issues = append_value(value, field, message);
  if (!issues.empty()) {
    const std::string detail = field->message_type() == nullptr ? "" : ": " + issues.front().what;
    return Error{"", "`" + value + "` is no value of " + text(path) + detail + "; expected " + expectation(field)};
  }
  if (field->is_repeated()) {
    const int last = reflection->FieldSize(message, field) - 1;
    if (segment.index < last) {
      reflection->SwapElements(&message, field, segment.index, last);
      reflection->RemoveLast(&message, field);
    }
  }
  return std::nullopt;
}

}  // namespace

Expected<FieldPath> set_field(Scenario& scenario, const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos) return Error{"", "has no `=`; write path=value"};
  const auto tokens = tokens_of(std::string_view(assignment).substr(0, equals));
  if (!tokens) return tokens.error();

  Scenario changed = scenario;
  Message* message = &changed;
  // A scenario without RSUs means one default RSU: it is there to be set, and a second one comes after it.
  if (tokens.value().front().name == "rsus" && changed.rsus_size() == 0) changed.add_rsus();
  FieldPath path;
  for (std::size_t i = 0; i < tokens.value().size(); ++i) {
    const auto segment = segment_of(tokens.value()[i], *message, path);
    if (!segment) return segment.error();
    if (auto refused = arm_in_the_way(*message, segment.value(), path)) return *refused;
    drop_replaced(*message, segment.value());
    path.push_back(segment.value());
    if (i + 1 == tokens.value().size()) break;
    if (segment.value().field->message_type() == nullptr) {
      return Error{"", text(path) + " is a value; it has no field `" + tokens.value()[i + 1].name + "`"};
    }
    message = &entered(*message, segment.value());
  }
  if (auto refused = assign(*message, path, assignment.substr(equals + 1))) return *refused;
  scenario = std::move(changed);
  return path;
}

}  // namespace lukou::scenario
