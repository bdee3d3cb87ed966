#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

// What the tests of studies share.

namespace lukou::test {

/// Two arms and two latencies, three seeds: nine runs, p000-s1 to p002-s3. `more` stands at the end.
std::string small_study(double duration_s, const std::string& more = "");

/// Everything that a database holds, row by row.
std::string dump(const std::filesystem::path& file);

/// Runs of a study that have a marker of this name.
std::size_t markers_in(const std::filesystem::path& study, const std::string& name = "done.json");

/// Looks every 10 ms until `is_so`; false after a minute.
template <class IsSo>
bool wait_until(const IsSo& is_so) {
  for (int i = 0; i < 6000; ++i) {
    if (is_so()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

}  // namespace lukou::test
