#include "common/process/options.hpp"

#include <CLI/CLI.hpp>

#include "common/process/address_options.hpp"
#include "common/process/environment.hpp"

namespace lukou::process {

void add_address_options(CLI::App& app, bus::Address& address) {
  app.add_option("--identity", address.identity, "folder of this process's identity in a secured run")
      ->envname("LUKOU_IDENTITY");
  app.add_option("--peers", address.peers, "addresses of the run's hosts, separated by commas [loopback only]")
      ->envname("LUKOU_PEERS")
      ->delimiter(',')
      ->allow_extra_args(false);
}

Expected<MemberOptions> member_options(int argc, char** argv, const std::string& about,
                                       const std::vector<OptionRule>& rules) {
  CLI::App app(about);
  MemberOptions options;
  app.add_option("--run", options.address.run, "id of the run to join")->envname("LUKOU_RUN")->required();
  app.add_option("--domain", options.address.domain, "DDS domain id of the run")
      ->envname("LUKOU_DOMAIN")
      ->required()
      ->check(CLI::Range(0, 230));
  add_address_options(app, options.address);
  std::map<std::string, std::string> values;
  std::map<std::string, bool> flags;
  for (const OptionRule& rule : rules) {
    if (rule.flag) {
      app.add_flag(rule.name, flags[rule.name], rule.help);
    } else {
      app.add_option(rule.name, values[rule.name], rule.help);
    }
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool help = app.exit(error, std::cerr, std::cerr) == 0;
    return Error{"", std::to_string(help ? kExitDone : kExitUsage)};
  }
  for (const OptionRule& rule : rules) {
    if (app.count(rule.name) > 0) options.values[rule.name] = rule.flag ? "true" : values[rule.name];
  }
  return options;
}

}  // namespace lukou::process
