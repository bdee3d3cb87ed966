#include <google/protobuf/stubs/logging.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>

#include "common/process/address_options.hpp"
#include "common/process/line_link.hpp"
#include "common/process/run_client.hpp"
#include "common/process/run_list.hpp"
#include "common/process/stepping.hpp"
#include "services/console/beast_transport.hpp"
#include "services/console/hub.hpp"

using namespace lukou;

namespace {

constexpr double kServe_s = 0.005;     ///< between two looks at the bus, with viewers
constexpr double kIdleServe_s = 0.05;  ///< without
constexpr double kLeftAlone_s = 10.0;  ///< after the end of a run, until a console that nobody looks at ends
constexpr double kGoodbye_s = 0.5;

struct Options {
  std::string attach;
  bus::Address given{.domain = -1};
  console::Listening listening;
  std::string token;
  std::filesystem::path page;
  int launcher = -1;
};

/// The built page, beside this program's build folder or installed under its prefix.
std::filesystem::path page_folder() {
  const auto above = std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path();
  const auto installed = above / "share/lukou/console";
  return std::filesystem::is_directory(installed) ? installed : above / "console";
}

/// One run on the bus and the hub that shows it.
class Followed {
 public:
  static Expected<std::unique_ptr<Followed>> attach(const bus::Address& address, console::Hub& hub) {
    auto client = process::RunClient::attach(address, true);
    if (!client) return client.error();
    return std::unique_ptr<Followed>(new Followed(std::move(client).value(), address.run, hub));
  }

  void follow() {
    client_->poll(0.0);
    if (!begun_) return;
    const double now_s = process::wall_s();
    if (client_->views() != views_) {
      views_ = client_->views();
      hub_.show(*client_->view(), now_s);
    }
    if (client_->state()) hub_.tell(*client_->state(), client_->clock_silent_s(), now_s);
    if (client_->asking()) return;
    if (const auto request = hub_.take_request()) client_->ask(*request);
  }

  /// Whether nothing more will come.
  [[nodiscard]] bool over() const {
    const bool said = client_->state() && client_->state()->phase >= RunPhase::kEnded;
    return said || client_->clock_silent_s() > kLeftAlone_s;
  }

 private:
  Followed(std::unique_ptr<process::RunClient> client, std::string run, console::Hub& hub)
      : client_(std::move(client)), run_(std::move(run)), hub_(hub) {
    client_->on_control([this](const Control& control) { hear(control); });
    client_->ask("recording");
  }

  void hear(const Control& control) {
    if (begun_ && control.kind == Control::Kind::kReply) return hub_.answered(control.ok, control.text);
    if (begun_) return hub_.hear(control);
    if (control.kind != Control::Kind::kReply) return;  // what the answer will tell
    if (!asked_) {
      // A clock knows no such request; what replays a recording answers with its last step.
      if (control.ok) recorded_to_ = std::atoll(control.text.c_str());
      asked_ = true;
      return client_->ask("scenario");
    }
    auto story = console::RunStory::of(run_, control.text, recorded_to_);
    if (!story) return process::log_error(story.error().text());
    std::vector<Directive> so_far;
    for (std::size_t i = 0; i < control.directive_step.size(); ++i) {
      so_far.push_back({control.directive_step[i], control.directive_set[i]});
    }
    hub_.begin(std::move(story).value(), so_far);
    begun_ = true;
  }

  std::unique_ptr<process::RunClient> client_;
  std::string run_;
  console::Hub& hub_;
  bool asked_ = false;  ///< whether this is a recording
  std::optional<Step> recorded_to_;
  bool begun_ = false;
  std::uint64_t views_ = 0;
};

class Console {
 public:
  explicit Console(const Options& options)
      : options_(options), link_(options.launcher), launched_(link_.open()), hub_(launched_) {}

  int run() {
    auto transport =
        console::listen(options_.listening, console::Gate(options_.token), console::PageFolder(options_.page), hub_);
    if (!transport) return process::report_start(transport.error(), process::kExitUsage);
    transport_ = std::move(transport).value();
    if (!launched_) {
      const auto found = process::find_run(options_.attach, options_.given);
      if (!found) return process::report_start(found.error(), process::kExitUsage);
      if (const auto attached = attach(found.value()); !attached) {
        return process::report_start(attached.error(), process::kExitAborted);
      }
    }
    announce();
    while (process::stop_signal() == 0 && !done()) {
      transport_->serve(hub_.viewers() > 0 ? kServe_s : kIdleServe_s);
      if (followed_) followed_->follow();
      if (launched_) talk_to_launcher();
    }
    say_goodbye();
    return process::kExitDone;
  }

 private:
  Expected<Done> attach(const bus::Address& address) {
    followed_.reset();  // two runs of one DDS domain cannot be in one process
    auto followed = Followed::attach(address, hub_);
    if (!followed) return followed.error();
    followed_ = std::move(followed).value();
    return Done{};
  }

  void announce() {
    const std::string& address = options_.listening.address;
    const std::string host = address.find(':') == std::string::npos ? address : "[" + address + "]";
    const std::string url = "http://" + host + ":" + std::to_string(transport_->port()) + "/";
    if (launched_) return link_.say("listening " + url);
    std::printf("%s%s\n", url.c_str(), options_.token.empty() ? "" : "?token=...");
    std::fflush(stdout);
  }

  void talk_to_launcher() {
    for (const std::string& line : link_.take()) {
      // "run ID DOMAIN"
      const std::size_t space = line.rfind(' ');
      if (!line.starts_with("run ") || space <= 4) continue;
      bus::Address address = options_.given;
      address.domain = std::stoi(line.substr(space + 1));
      address.run = line.substr(4, space - 4);
      if (const auto attached = attach(address); !attached) process::log_error(attached.error().text());
    }
    if (hub_.viewers() != viewers_) {
      viewers_ = hub_.viewers();
      link_.say("viewers " + std::to_string(viewers_));
    }
    if (const auto seed = hub_.take_restart()) link_.say("restart " + std::to_string(*seed));
  }

  /// A console that `lukou` started ends with it; one for itself when the run is over and nobody looks any more.
  bool done() {
    if (launched_) return !link_.open();
    const double now_s = process::wall_s();
    if (!followed_->over() || hub_.viewers() > 0) alone_s_ = now_s;
    return now_s - alone_s_ > kLeftAlone_s;
  }

  void say_goodbye() {
    transport_->close();
    const double begin_s = process::wall_s();
    while (process::wall_s() - begin_s < kGoodbye_s && hub_.viewers() > 0) transport_->serve(kServe_s);
  }

  const Options& options_;
  process::LineLink link_;
  bool launched_;
  console::Hub hub_;
  std::unique_ptr<console::Transport> transport_;
  std::unique_ptr<Followed> followed_;
  std::size_t viewers_ = 0;
  double alone_s_ = process::wall_s();
};

int run(int argc, char** argv) {
  CLI::App app("The browser's view of a run, and the operator's hands");
  Options options{.page = page_folder()};
  app.add_option("--attach", options.attach, "id of a running simulation, or its beginning");
  app.add_option("--domain", options.given.domain, "DDS domain id, of a run that another host has started")
      ->envname("LUKOU_DOMAIN")
      ->check(CLI::Range(0, 230));
  process::add_address_options(app, options.given);
  app.add_option("--address", options.listening.address, "IP address to listen at; any but 127.0.0.1 needs --token")
      ->capture_default_str();
  app.add_option("--port", options.listening.port, "port to listen at; 0: any")->capture_default_str();
  app.add_option("--ports", options.listening.ports_to_try, "how many ports from there on may be tried")
      ->check(CLI::Range(1, 1000));
  app.add_option("--token", options.token, "a secret of at least 16 letters or digits that every viewer has to know")
      ->envname("LUKOU_CONSOLE_TOKEN");
  app.add_option("--page", options.page, "folder of the built page")->envname("LUKOU_CONSOLE_PAGE");
  app.add_option("--launcher", options.launcher, "descriptor of the line to the `lukou` that starts this")->group("");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? process::kExitDone : process::kExitUsage;
  }
  if (options.attach.empty() && options.launcher < 0) {
    return process::report_start({"--attach", "names the run to show; `lukou ctl list` names those there are"},
                                 process::kExitUsage);
  }
  const std::string& address = options.listening.address;
  if (options.token.empty() && address != "127.0.0.1" && address != "::1") {
    return process::report_start({"--address " + address, "others could steer this run: it needs --token"},
                                 process::kExitUsage);
  }
  if (!options.token.empty() && !console::fit_for_token(options.token)) {
    return process::report_start({"--token", "must be 16 to 200 letters, digits, `-` or `_`"}, process::kExitUsage);
  }
  process::catch_stop_signals();
  // Whoever talks nonsense is let go; that needs no line for each.
  google::protobuf::SetLogHandler(nullptr);
  return Console(options).run();
}

}  // namespace

int main(int argc, char** argv) {
  return process::guarded("console", [&] { return run(argc, argv); });
}
