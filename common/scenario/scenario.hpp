#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/expected.hpp"
#include "common/intersection/lane.hpp"
#include "common/intersection/signal_plan.hpp"

namespace google::protobuf {
class Descriptor;
}

namespace lukou::scenario {

class Scenario;  // idl/scenario.proto

/// A scenario that has been checked and in which every absent field has its default. Include scenario.pb.h to read it.
/// Exceptions to "every": a demand has one of its three arms, and signals have a preset or a plan.
class Resolved {
 public:
  Resolved(const Resolved& other);
  Resolved(Resolved&& other) noexcept;
  Resolved& operator=(const Resolved& other);
  Resolved& operator=(Resolved&& other) noexcept;
  ~Resolved();

  [[nodiscard]] const Scenario& message() const { return *message_; }

 private:
  friend class Loader;
  explicit Resolved(std::unique_ptr<Scenario> message);
  std::unique_ptr<Scenario> message_;
};

/// Reads a scenario: the file, then `sets` ("path=value", as after --set) in order, then the defaults of absent fields.
/// `path_or_name` is a file or the bare name of a shipped scenario. The error lists everything that is wrong, one a
/// line, in the order of the file, each as `file:line:column: what, and what would be right`.
Expected<Resolved> load(const std::string& path_or_name, const std::vector<std::string>& sets = {});

/// As load(), from text in hand. `origin` names it in errors; relative paths of traces in it start at `directory`,
/// those in `sets` where the program runs. Empty `directory`: there too.
Expected<Resolved> load_text(const std::string& text, const std::string& origin, const std::filesystem::path& directory,
                             const std::vector<std::string>& sets = {});

/// A setting as after --set, and what errors call it.
struct LabelledSet {
  std::string set;    ///< "path=value"
  std::string label;  ///< "study.textproto:12:5: run.seed=x"
};
Expected<Resolved> load_text(const std::string& text, const std::string& origin, const std::filesystem::path& directory,
                             const std::vector<LabelledSet>& sets);

/// What ships with the program and is known by its bare name.
enum class Shipped : std::uint8_t { kScenario, kStudy };
/// Where scenarios are looked for, in order: LUKOU_SCENARIOS, the source tree of the running program, the prefix it is
/// installed under; studies in the folder `studies` beside each of these.
std::vector<std::filesystem::path> shipped_directories(Shipped kind = Shipped::kScenario);
/// The bare names, sorted.
std::vector<std::string> shipped_names(Shipped kind = Shipped::kScenario);
/// The file that a user means: a path, or a bare name.
Expected<std::filesystem::path> find_file(const std::string& path_or_name, Shipped kind);
/// The whole of a regular file. The error has no `where`.
Expected<std::string> read_file(const std::filesystem::path& file);

/// An operator's change while a run goes on, "path=value". Only fields marked live may change; the error lists them.
/// A preset replaces a plan and a plan a preset. On error the scenario stays as it was.
Expected<Done> change(Resolved& scenario, const std::string& assignment);
/// Paths of the fields that may change while a run goes on, in the order of the schema.
std::vector<std::string> live_fields();

/// A field that may change while a run goes on, as it is now.
struct LiveValue {
  std::string path;  ///< as change() takes it: "rsus[0].sensors[0].miss_rate"
  std::string unit;
  std::string value;  ///< as change() takes it; empty: the field is absent
  std::optional<double> min;
  std::optional<double> max;
  std::string source;
  std::vector<std::string> words;  ///< of an enum, and of true or false
};
/// Every number, word and text that change() may set, in the order of the schema, and signals.plan as a whole; of lists
/// what stands in them.
std::vector<LiveValue> live_values(const Resolved& scenario);

/// The signal plans that `signals.preset` names.
struct NamedPlan {
  std::string name;  ///< "PAPER"
  lukou::SignalPlan plan;
};
std::vector<NamedPlan> signal_presets();

/// The canonical text: loading it gives the same scenario and the same text.
std::string text(const Resolved& scenario);
/// SHA-256 of text().
std::string hash(const Resolved& scenario);

/// The signal plan of the preset or of the user. load() has refused crossing streams that are green together unless
/// the scenario allows them.
Expected<lukou::SignalPlan> signal_plan(const Resolved& scenario);

/// Arrivals of an approach from the trace that it names [s], in order; empty if it names none.
Expected<std::vector<double>> arrivals(const Resolved& scenario, Approach approach);

/// What a user should know before the run starts, though nothing is wrong: demand above capacity, conflicts, ...
std::vector<std::string> warnings(const Resolved& scenario);

/// What each roadside sensor watches and how well, one a line; begins with its path.
std::vector<std::string> sensor_lines(const Resolved& scenario);

/// Cars that a lane lets go in an hour of green (study of the model, 10: headway 1.997 s).
inline constexpr double kSaturationFlow_veh_per_h = 1803.0;
/// Capacity of an approach under a plan [veh/h]: the flow at which its first lane is saturated.
/// `shares` are the relative weights of the left, centre and right lane, not all 0.
double capacity_veh_per_h(const lukou::SignalPlan& plan, Approach approach,
                          const std::array<double, kLanesPerApproach>& shares);

/// One row of the fields' documentation, from the options in the schema.
struct FieldDoc {
  std::string path;  ///< "traffic.west.flow_veh_per_h"; a list is written "rsus[]"
  std::string type;  ///< "number", "whole number", "true or false", "text" or the names of an enum: "STOP | CONTINUE"
  std::string unit;  ///< may be empty
  std::optional<double> min;
  std::optional<double> max;
  std::string fallback;  ///< value of an absent field; empty if it has none
  std::string source;
  bool live = false;          ///< may change while a run goes on
  bool on_step_grid = false;  ///< a multiple of 0.1 s
};
std::vector<FieldDoc> field_docs();
/// The same of another message type whose fields have rules.
std::vector<FieldDoc> field_docs(const google::protobuf::Descriptor& type);

}  // namespace lukou::scenario
