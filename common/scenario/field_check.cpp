#include "common/scenario/field_check.hpp"

#include <cmath>

#include "common/scenario/radio_preset.hpp"
#include "common/scenario/wording.hpp"

namespace lukou::scenario {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

class FieldChecker {
 public:
  void fields_of(const Message& message, const FieldPath& path) {
    const Descriptor* type = message.GetDescriptor();
    for (int i = 0; i < type->field_count(); ++i) {
      const FieldDescriptor* field = type->field(i);
      if (field->message_type() != nullptr) {
        for (int n = 0; n < count(message, field); ++n) {
          const int index = field->is_repeated() ? n : -1;
          fields_of(element(message, field, index), extended(path, field, index));
        }
      } else if (!field->is_repeated() && has(message, field)) {
        value_of(message, field, extended(path, field));
      } else if (!field->is_repeated() && !has_fallback(field) && !is_demand_arm(field) && !is_latency_arm(field) &&
                 !may_be_absent(field)) {
        findings_.push_back({path,
                             {},
                             text(extended(path, field)) + " is missing; it takes " +
                                 (range(field).empty() ? expectation(field) : "a number" + range(field)),
                             ""});
      }
    }
  }

  void value_of(const Message& message, const FieldDescriptor* field, const FieldPath& path) {
    const auto* reflection = message.GetReflection();
    switch (field->cpp_type()) {
      case FieldDescriptor::CPPTYPE_DOUBLE:
        number(reflection->GetDouble(message, field), field, path);
        break;
      case FieldDescriptor::CPPTYPE_UINT32:
        number(reflection->GetUInt32(message, field), field, path);
        break;
      case FieldDescriptor::CPPTYPE_ENUM: {
        const int value = reflection->GetEnumValue(message, field);
        if (value != 0 && field->enum_type()->FindValueByNumber(value) != nullptr) break;
        add(path, "is " + (value == 0 ? field->enum_type()->value(0)->name() : std::to_string(value)) + ", must be " +
                      expectation(field));
        break;
      }
      default:
        break;
    }
  }

  static std::string range(const FieldDescriptor* field) {
    const FieldRule& said = rule_of(field);
    if (said.has_min() && said.has_max()) {
      return " within [" + number_text(said.min()) + ", " + number_text(said.max()) + "]" + unit_text(field);
    }
    return "";
  }

  void number(double value, const FieldDescriptor* field, const FieldPath& path) {
    const FieldRule& said = rule_of(field);
    const std::string given = "is " + number_text(value) + unit_text(field) + ", must be";
    if (!std::isfinite(value) || (said.has_min() && value < said.min()) || (said.has_max() && value > said.max())) {
      add(path, given + (range(field).empty() ? " a finite number" : range(field)));
    } else if (on_step_grid(field) && std::fabs(value * 10.0 - std::round(value * 10.0)) > 1e-6) {
      add(path, given + " a multiple of 0.1 s, the length of a step");
    }
  }

  std::vector<Finding> findings() && { return std::move(findings_); }

 private:
  void add(const FieldPath& path, const std::string& what) {
    findings_.push_back({path, {}, text(path) + " " + what, ""});
  }

  std::vector<Finding> findings_;
};

}  // namespace

std::vector<Finding> field_findings(const Message& message) {
  FieldChecker checker;
  checker.fields_of(message, {});
  return std::move(checker).findings();
}

}  // namespace lukou::scenario
