#include "tests/system/study_files.hpp"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <algorithm>
#include <sstream>

namespace lukou::test {

namespace fs = std::filesystem;

std::string small_study(double duration_s, const std::string& more) {
  return "scenario: \"paper\"\nset: \"run.duration_s=" + std::to_string(duration_s) +
         "\"\nset: \"run.warmup_s=60\"\nset: \"rsus[0].arrive_on_green.lifetime_s=0.5\"\n"
         "arms { name: \"guided\" }\narms { name: \"none\" set: \"vehicles.equipped_ratio=0\" ignores: \"latency\" }\n"
         "baseline: \"none\"\n"
         "grids { factors { name: \"latency\" paths: \"radio.downlink.latency.constant_ms\" values: [0, 600] } }\n"
         "seeds { count: 3 }\n" +
         more;
}

std::string dump(const fs::path& file) {
  sqlite3* database = nullptr;
  EXPECT_EQ(sqlite3_open_v2(file.c_str(), &database, SQLITE_OPEN_READONLY, nullptr), SQLITE_OK) << file;
  std::string text;
  const auto row = [](void* into, int columns, char** values, char**) {
    for (int i = 0; i < columns; ++i)
      *static_cast<std::string*>(into) += std::string(values[i] ? values[i] : "NULL") + "|";
    *static_cast<std::string*>(into) += "\n";
    return 0;
  };
  std::string tables;
  const char* listing = "SELECT name, sql FROM sqlite_master ORDER BY name";
  EXPECT_EQ(sqlite3_exec(database, listing, row, &text, nullptr), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(database, "SELECT name FROM sqlite_master WHERE type = 'table' ORDER BY name", row, &tables,
                         nullptr),
            SQLITE_OK);
  std::istringstream names(tables);
  for (std::string name; std::getline(names, name, '|');) {
    name.erase(0, name.find_first_not_of('\n'));
    if (name.empty()) continue;
    text += "== " + name + "\n";
    EXPECT_EQ(sqlite3_exec(database, ("SELECT * FROM " + name + " ORDER BY rowid").c_str(), row, &text, nullptr),
              SQLITE_OK);
  }
  sqlite3_close(database);
  return text;
}

std::size_t markers_in(const fs::path& study, const std::string& name) {
  std::error_code code;
  const fs::directory_iterator runs(study / "runs", code);
  return static_cast<std::size_t>(
      std::count_if(begin(runs), end(runs), [&](const auto& run) { return fs::exists(run.path() / name); }));
}

}  // namespace lukou::test
