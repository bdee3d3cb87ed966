#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lukou::test {

/// The Cyclone configuration of a stranger who knows the run's id and its tag; `identity`: folder of his identity, "" =
/// he has none; `access_control`: file of his plugin, "" = the real one.
std::string strangers_config(const std::string& run, bool secured, const std::filesystem::path& identity = "",
                             const std::string& access_control = "");
/// File of the real plugin.
std::string real_access_control();

/// What `intruder` says of one topic.
struct Foothold {
  bool created = false;
  int matched = 0;
  long count = 0;
};
/// "read traffic" or "write signal" in its output; nothing created if it is not there.
Foothold foothold(const std::string& output, const std::string& what);

}  // namespace lukou::test
