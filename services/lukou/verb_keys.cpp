#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "common/process/environment.hpp"
#include "common/results/json.hpp"
#include "services/lukou/keys/key_folder.hpp"
#include "services/lukou/scenario_arguments.hpp"
#include "services/lukou/verbs.hpp"

namespace lukou {
namespace {

struct KeysArguments {
  std::string folder;
  std::string role;
  std::uint32_t rsus = 2;
  double days = 365.0;
  bool json = false;
};

int failed(const Error& error) {
  std::fprintf(stderr, "%s\n", error.text().c_str());
  return process::kExitIo;
}

int init(const KeysArguments& arguments) {
  if (auto free = keys::may_make(arguments.folder); !free) return report_errors(free.error());
  const keys::Validity validity{.until = arguments.days};
  if (auto done = keys::make_keys(arguments.folder, arguments.rsus, validity); !done) return failed(done.error());
  std::printf("%s: an authority and the identities of %zu roles, good for %g days\n", arguments.folder.c_str(),
              keys::roles(arguments.rsus).size(), arguments.days);
  std::printf("a secured run: lukou run paper --secure %s\n", arguments.folder.c_str());
  return process::kExitDone;
}

int issue(const KeysArguments& arguments) {
  if (auto known = keys::may_issue(arguments.folder, arguments.role); !known) return report_errors(known.error());
  const keys::Validity validity{.until = arguments.days};
  if (auto done = keys::issue(arguments.folder, arguments.role, validity); !done) return failed(done.error());
  std::printf("%s/%s: a new identity, good for %g days\n", arguments.folder.c_str(), arguments.role.c_str(),
              arguments.days);
  return process::kExitDone;
}

/// Exit code 0 if every identity is fit.
int show(const KeysArguments& arguments) {
  const auto found = keys::show(arguments.folder);
  if (!found) return report_errors(found.error());
  bool fit = true;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& [role, identity] : found.value()) {
    fit = fit && identity.ok();
    nlohmann::ordered_json one = {{"role", role}, {"fit", identity.ok()}};
    if (identity) {
      one["authority"] = identity.value().authority;
      one["days_left"] = identity.value().days_left;
    } else {
      one["error"] = identity.error().text();
    }
    list.push_back(one);
    if (arguments.json) continue;
    if (identity) {
      std::printf("ok   %-18s %7.1f days left, signed by %s\n", role.c_str(), identity.value().days_left,
                  identity.value().authority.c_str());
    } else {
      std::printf("BAD  %-18s %s\n", role.c_str(), identity.error().text().c_str());
    }
  }
  if (arguments.json) {
    const nlohmann::ordered_json all = {{"folder", arguments.folder}, {"fit", fit}, {"identities", list}};
    std::fputs(results::json_text(all).c_str(), stdout);
  }
  return fit ? process::kExitDone : process::kExitInternal;
}

}  // namespace

Action add_keys(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("keys", "identities for secured runs");
  verb->require_subcommand(1);
  auto arguments = std::make_shared<KeysArguments>();
  const auto add = [&](const char* name, const char* what) {
    CLI::App* one = verb->add_subcommand(name, what);
    one->add_option("folder", arguments->folder, "folder of the keys")->required();
    return one;
  };
  const auto takes_days = [&](CLI::App* one) {
    one->add_option("--days", arguments->days, "how long the identities are good")
        ->check(CLI::Range(1.0, 3650.0))
        ->capture_default_str();
  };
  CLI::App* making = add("init", "make an authority and an identity for each role, in a new folder");
  making->add_option("--rsus", arguments->rsus, "identities for so many RSUs")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  takes_days(making);
  CLI::App* issuing = add("issue", "make the identity of one role anew, or of a further RSU");
  issuing->add_option("role", arguments->role, "clock, traffic-engine, rsu0, ...")->required();
  takes_days(issuing);
  CLI::App* showing = add("show", "whose identities there are, are they fit, when do they expire");
  showing->add_flag("--json", arguments->json, "one JSON object on standard output");
  return [arguments, making, issuing] {
    if (making->parsed()) return init(*arguments);
    return issuing->parsed() ? issue(*arguments) : show(*arguments);
  };
}

}  // namespace lukou
