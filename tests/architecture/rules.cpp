#include "tests/architecture/rules.hpp"

#include <algorithm>
#include <map>
#include <regex>
#include <set>

namespace lukou::architecture {
namespace {

/// Which rooms of common/ may include which others; itself goes without saying.
const std::map<std::string, std::set<std::string>> kRooms = {
    {"core", {}},
    {"intersection", {"core"}},
    {"messages", {"core", "intersection"}},
    {"radio", {"core", "intersection", "messages"}},
    {"scenario", {"core", "intersection", "radio"}},
    {"lockstep", {"core"}},
    {"bus", {"core", "lockstep", "messages", "radio"}},
    {"measures", {"core", "intersection", "radio", "bus"}},  // of the bus the plain batches alone, see kOnlyHeader
    {"run_log", {"core", "radio", "bus"}},                   // of the bus the plain batches alone, see kOnlyHeader
    {"results", {"core", "intersection", "measures", "run_log"}},  // of the measures the plain rows alone
    {"process", {"core", "lockstep", "bus"}},
};

/// A room of which another may include one header alone.
struct OnlyHeader {
  std::string from;
  std::string room;
  std::string header;
};
const std::vector<OnlyHeader> kOnlyHeader = {
    {"common/measures", "common/bus", "common/bus/batches.hpp"},
    {"common/run_log", "common/bus", "common/bus/batches.hpp"},
    {"common/results", "common/measures", "common/measures/rows.hpp"},
    {"services/rsu/sdk", "common/messages", "common/messages/binding.hpp"},
};

/// Folders without bus, file, clock and log, and what they may include beside the standard library, common/core,
/// common/intersection and themselves.
const std::map<std::string, std::set<std::string>> kPure = {
    {"services/rsu/model", {"services/rsu/sdk"}},  // plain structs: what the model fills for the algorithm
    {"services/rsu/sdk", {"common/messages"}},
    {"services/rsu/algorithms", {"services/rsu/sdk"}},
};

/// Headers of the standard library that reach out of a pure room.
const std::set<std::string> kImpureStandard = {"chrono", "thread", "mutex",      "future",   "fstream",
                                               "cstdio", "random", "filesystem", "iostream", "ctime"};

/// Headers with Protobuf in them: inside their room only.
const std::set<std::string> kProtobufHeaders = {"common/scenario/schema.hpp"};

/// Why a place may use a word that others may not.
struct Exception {
  std::string path;  ///< a file, or a folder with '/' at its end
  std::string word;
  std::string reason;
};
const std::vector<Exception> kExceptions = {
    {"common/process/", "clock", "the room of the wall clock"},
    {"common/process/", "sleep", "the room of the wall clock"},
    {"common/process/", "random device", "a process start needs a name that no other start has"},
    {"common/bus/participant.cpp", "environment", "CYCLONEDDS_URI, as every Cyclone program"},
    {"common/scenario/file.cpp", "environment", "LUKOU_SCENARIOS, where shipped scenarios are looked for"},
    {"services/rsu/process/run_rsu.cpp", "environment", "LUKOU_RSU, which RSU a hand-started process is"},
    {"services/lukou/launch/rsu_child.cpp", "environment", "PYTHONPATH, which the RSU's keeps"},
    {"services/lukou/verb_doctor.cpp", "environment", "says what CYCLONEDDS_URI is set to"},
    {"services/lukou/report/progress.cpp", "environment", "NO_COLOR"},
    {"services/lukou/verb_verify.cpp", "thread", "runs beside each other, to show that they do not disturb"},
};

struct Word {
  std::string name;
  std::regex pattern;
  std::vector<std::string> where;  ///< folders in which the word is watched
  std::string instead;
};

const std::vector<std::string> kEverywhere = {"common", "services"};
/// What decides results: the same bytes on every processor.
const std::vector<std::string> kDeciding = {
    "common/core",        "common/intersection",     "common/messages",
    "common/radio",       "common/measures",         "services/traffic_engine/model",
    "services/rsu/model", "services/rsu/algorithms", "services/signal_controller/model"};

const std::vector<Word>& words() {
  static const std::vector<Word> kWords = {
      {"clock",
       std::regex(R"((system|steady|high_resolution)_clock|\btime\s*\(\s*(nullptr|NULL|0)\s*\)|clock_gettime|)"
                  R"(gettimeofday|\bclock\s*\(\s*\))"),
       kEverywhere, "take the time as an argument; process::wall_s() in a main"},
      {"sleep", std::regex(R"(sleep_for|sleep_until|\b(u|nano)?sleep\s*\()"), kEverywhere, "process::sleep_s()"},
      {"thread", std::regex(R"(std::j?thread\b|std::async\b|pthread_create)"), kEverywhere, "one thread per process"},
      {"environment", std::regex(R"(\bgetenv\b)"), kEverywhere, "an option or a scenario field"},
      {"random device", std::regex(R"(\brandom_device\b|\bs?rand\s*\()"), kEverywhere, "common/core/keyed_random"},
      {"random engine", std::regex(R"(\bstd::(mt19937|minstd_rand|ranlux|default_random_engine))"), kEverywhere,
       "common/core/keyed_random"},
      {"distribution", std::regex(R"(std::\w+_distribution\b)"), kEverywhere,
       "common/core/keyed_random: those of the standard library differ between implementations"},
      {"C library function",
       std::regex(
           R"(\bstd::(log|log2|log10|log1p|exp|exp2|expm1|sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|pow|cbrt|)"
           R"(hypot|erf|erfc|tgamma|lgamma|fma)\s*\()"),
       kDeciding, "common/core/math: the C library's differ in the last bit between processors"},
      {"unordered container", std::regex(R"(std::unordered_)"), kDeciding, "order by id, never by hash"},
  };
  return kWords;
}

std::string at(const SourceFile& file, std::size_t line, const std::string& what) {
  return file.path + ":" + std::to_string(line) + ": " + what;
}

/// The first `count` parts of a path: "services/rsu" of "services/rsu/model/x.hpp".
std::string head(const std::string& path, int count) {
  std::size_t end = 0;
  for (int i = 0; i < count && end != std::string::npos; ++i) end = path.find('/', end + (i > 0 ? 1 : 0));
  return path.substr(0, end);
}

std::string folder_of(const std::string& path) { return path.substr(0, path.rfind('/')); }

const OnlyHeader* only_header(const std::string& from, const std::string& include) {
  for (const OnlyHeader& only : kOnlyHeader) {
    if (from.starts_with(only.from + "/") && include.starts_with(only.room + "/")) return &only;
  }
  return nullptr;
}

bool is_pure(const SourceFile& file) {
  const std::string folder = folder_of(file.path);
  return kPure.contains(folder) || (file.in("services") && folder.ends_with("/model"));
}

std::string wrong_in_pure(const SourceFile& file, const Include& include) {
  if (!include.quoted) {
    const bool standard = std::regex_match(include.name, std::regex("[a-z_]+"));
    if (standard && !kImpureStandard.contains(include.name)) return "";
    return "a pure folder includes <" + include.name + ">; it knows no file, clock, thread and library";
  }
  const std::string own = folder_of(file.path);
  std::set<std::string> allowed = {"common/core", "common/intersection", own};
  if (const auto more = kPure.find(own); more != kPure.end()) allowed.insert(more->second.begin(), more->second.end());
  const auto fits = [&](const std::string& folder) { return include.name.starts_with(folder + "/"); };
  if (std::ranges::any_of(allowed, fits)) return "";
  return "a pure folder includes " + include.name + "; allowed are common/core, common/intersection and its own";
}

std::string wrong_among_rooms(const SourceFile& file, const Include& include) {
  const std::string from = head(file.path, 2);
  const std::string to = head(include.name, 2);
  if (file.in("common")) {
    const std::string room = from.substr(from.find('/') + 1);
    if (!kRooms.contains(room)) return "the room " + from + " is not in the table of this test";
    if (include.name.starts_with("services/")) return "common/ includes a service, " + include.name;
    if (!include.name.starts_with("common/") || to == from) return "";
    const auto& allowed = kRooms.at(room);
    const std::string other = to.substr(to.find('/') + 1);
    return allowed.contains(other) ? "" : from + " includes " + include.name + ", a room that it may not know";
  }
  if (file.in("services") && include.name.starts_with("services/") && to != from && from != "services/lukou") {
    return from + " includes " + include.name + "; no service includes another";
  }
  return "";
}

std::string wrong_outside(const SourceFile& file, const Include& include) {
  const bool dds =
      include.name.starts_with("dds/") || include.name == "bus.h" || include.name == "common/bus/samples.hpp";
  // Its own test, and the example of a foreign client.
  const bool may = file.in("common/bus") || file.in("tests/unit/common/bus") || file.in("tests/bus_client");
  if (dds && !may) return "includes " + include.name + "; only common/bus names Cyclone";
  const bool protobuf = include.name.ends_with(".pb.h") || include.name.starts_with("google/protobuf/");
  if (protobuf && file.path.ends_with(".hpp") && !kProtobufHeaders.contains(file.path) && !file.in("common/scenario")) {
    return "a header includes " + include.name + "; declare the class, include it in the .cpp";
  }
  const bool service = file.in("services") && !file.in("services/lukou");
  // The main of every RSU, those of users too, is a library.
  const bool is_main = file.path.ends_with("/main.cpp") || file.path == "services/rsu/process/run_rsu.cpp";
  if (service && include.name.starts_with("common/process/") && !is_main) {
    return "includes " + include.name + "; of a service only its main runs, waits and logs";
  }
  if (const OnlyHeader* only = only_header(file.path, include.name); only != nullptr && include.name != only->header) {
    return "includes " + include.name + "; of " + only->room + " only " + only->header;
  }
  return "";
}

const Exception* exception_for(const std::string& path, const std::string& word) {
  for (const Exception& exception : kExceptions) {
    const bool here = exception.path.ends_with('/') ? path.starts_with(exception.path) : path == exception.path;
    if (here && exception.word == word) return &exception;
  }
  return nullptr;
}

}  // namespace

Violations include_violations(const SourceFile& file) {
  Violations found;
  if (!file.is_code()) return found;
  for (const Include& include : file.includes()) {
    for (const std::string& wrong :
         {wrong_among_rooms(file, include), is_pure(file) ? wrong_in_pure(file, include) : std::string(),
          wrong_outside(file, include)}) {
      if (!wrong.empty()) found.push_back(at(file, include.line, wrong));
    }
  }
  return found;
}

Violations order_violations(const SourceFile& common_cmake) {
  Violations found;
  std::vector<std::string> above;
  static const std::regex kRoom(R"(^\s*add_subdirectory\((\w+)\))");
  for (const Line& line : common_cmake.lines) {
    std::smatch parts;
    if (!std::regex_search(line.raw, parts, kRoom)) continue;
    const std::string room = parts[1];
    if (!kRooms.contains(room)) {
      found.push_back(at(common_cmake, line.number, "the room " + room + " is not in the table of this test"));
      continue;
    }
    for (const std::string& allowed : kRooms.at(room)) {
      if (std::ranges::find(above, allowed) != above.end()) continue;
      found.push_back(at(common_cmake, line.number, room + " may include " + allowed + ", which must stand above it"));
    }
    above.push_back(room);
  }
  for (const auto& [room, allowed] : kRooms) {
    if (std::ranges::find(above, room) != above.end()) continue;
    found.push_back(at(common_cmake, 1, "the room " + room + " is missing"));
  }
  return found;
}

Violations word_violations(const SourceFile& file, std::vector<std::string>& used) {
  Violations found;
  if (!file.is_code()) return found;
  for (const Word& word : words()) {
    if (std::ranges::none_of(word.where, [&](const std::string& folder) { return file.in(folder); })) continue;
    for (const Line& line : file.lines) {
      if (!std::regex_search(line.code, word.pattern)) continue;
      if (const Exception* exception = exception_for(file.path, word.name)) {
        used.push_back(exception->path + " " + exception->word);
      } else {
        found.push_back(at(file, line.number, word.name + " in `" + line.raw + "`; use " + word.instead));
      }
    }
  }
  return found;
}

Violations idle_exceptions(const std::vector<std::string>& used) {
  Violations found;
  for (const Exception& exception : kExceptions) {
    if (std::ranges::find(used, exception.path + " " + exception.word) != used.end()) continue;
    found.push_back(exception.path + ": the exception for " + exception.word + " (" + exception.reason +
                    ") is not needed any more");
  }
  return found;
}

Violations form_violations(const SourceFile& file) {
  Violations found;
  static const std::regex kUndone(
      "\\b(TO"
      "DO|FIX"
      "ME)\\b");
  for (const Line& line : file.lines) {
    if (std::regex_search(line.raw, kUndone)) found.push_back(at(file, line.number, "work left undone: " + line.raw));
  }
  constexpr std::size_t kLinesMax = 400;
  const bool counted = file.in("common") || file.in("services") || file.in("idl");
  if (counted && file.lines.size() > kLinesMax) {
    found.push_back(at(file, file.lines.size(), "more than " + std::to_string(kLinesMax) + " lines; part it"));
  }
  return found;
}

}  // namespace lukou::architecture
