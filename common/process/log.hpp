#pragma once

#include <string>

namespace lukou::process {

/// Messages for people, on standard error: "[traffic-engine] warning: ...". The program's name is set once.
void set_log_name(const std::string& program);
void log_info(const std::string& message);
void log_warning(const std::string& message);
void log_error(const std::string& message);

}  // namespace lukou::process
