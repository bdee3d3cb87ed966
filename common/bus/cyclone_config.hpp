#pragma once

#include <string>

namespace lukou::bus {

/// Cyclone's configuration of a run: loopback only, closed to other runs by a discovery tag, large fragments and
/// watermarks (no writer may block inside the loop). What the user's CYCLONEDDS_URI says is appended and
/// wins, the tag excepted.
std::string cyclone_config(const std::string& run, const char* users_uri);

}  // namespace lukou::bus
