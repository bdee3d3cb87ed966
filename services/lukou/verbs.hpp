#pragma once

#include <CLI/CLI.hpp>

#include <functional>

namespace lukou {

/// A verb of the command line: adds itself to the program and leaves behind what to do if it was given.
/// Each returns the exit code.
using Action = std::function<int()>;

Action add_run(CLI::App& app);
Action add_verify(CLI::App& app);
Action add_validate(CLI::App& app);
Action add_inspect(CLI::App& app);
Action add_ctl(CLI::App& app);
Action add_doctor(CLI::App& app);
Action add_algorithms(CLI::App& app);
Action add_new(CLI::App& app);
Action add_why(CLI::App& app);
Action add_plot(CLI::App& app);
Action add_sweep(CLI::App& app);
Action add_report(CLI::App& app);
Action add_export(CLI::App& app);
Action add_replay(CLI::App& app);
Action add_redrive(CLI::App& app);
Action add_keys(CLI::App& app);
Action add_leash(CLI::App& app);

}  // namespace lukou
