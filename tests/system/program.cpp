#include "tests/system/program.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <thread>

namespace lukou::test {
namespace {

namespace fs = std::filesystem;

double now_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

void pause_s(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

}  // namespace

std::string content(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (fs::temp_directory_path() / "lukou-test-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) std::abort();
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

Program::Program(const std::vector<std::string>& arguments, const std::vector<std::string>& environment,
                 const std::string& program) {
  const std::string out = (streams_ / "out").string();
  const std::string err = (streams_ / "err").string();
  pid_ = fork();
  if (pid_ != 0) return;
  dup2(open(out.c_str(), O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
  dup2(open(err.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
  for (const std::string& variable : environment) putenv(const_cast<char*>(variable.c_str()));
  std::vector<char*> words = {const_cast<char*>(program.c_str())};
  for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  execv(words[0], words.data());
  _exit(127);
}

Program::~Program() {
  if (!running()) return;
  kill(pid_, SIGTERM);
  if (wait(8.0) == -1) kill(pid_, SIGKILL);
}

bool Program::running() {
  if (ended_) return false;
  int status = 0;
  if (waitpid(pid_, &status, WNOHANG) != pid_) return true;
  ended_ = true;
  code_ = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  return false;
}

int Program::wait(double limit_s) {
  const double begin_s = now_s();
  while (running()) {
    if (now_s() - begin_s > limit_s) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
      ended_ = true;
      return -1;
    }
    pause_s(0.01);
  }
  return code_;
}

void Program::signal(int signal) const { kill(pid_, signal); }

std::string Program::out() const { return content(streams_ / "out"); }
std::string Program::err() const { return content(streams_ / "err"); }

Finished lukou(const std::vector<std::string>& arguments) {
  Program program(arguments);
  const int code = program.wait();
  return {code, program.out(), program.err()};
}

std::vector<RunningProcess> processes_with(const std::string& variable) {
  // As the kernel gives them: texts that end with a zero.
  const auto texts = [](const fs::path& file) {
    std::vector<std::string> list;
    std::stringstream stream(content(file));
    for (std::string text; std::getline(stream, text, '\0');) list.push_back(text);
    return list;
  };
  std::vector<RunningProcess> found;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    const auto environment = texts(entry.path() / "environ");
    if (std::ranges::find(environment, variable) == environment.end()) continue;
    found.push_back({std::stoi(name), texts(entry.path() / "cmdline")});
  }
  return found;
}

std::map<std::string, pid_t> processes_of(const std::string& run) {
  // The children carry the run's id in their environment.
  std::map<std::string, pid_t> found;
  for (const RunningProcess& process : processes_with("LUKOU_RUN=" + run)) {
    if (!process.command.empty()) found[fs::path(process.command.front()).filename()] = process.pid;
  }
  return found;
}

bool wait_for_step(const std::string& run, long long step) {
  for (const double begin_s = now_s(); now_s() - begin_s < 30.0; pause_s(0.02)) {
    const Finished status = lukou({"ctl", run, "status"});
    const auto at = status.out.find(": running, ");
    if (status.code != 0 || at == std::string::npos) continue;
    if (std::atof(status.out.c_str() + at + 11) * 10.0 >= static_cast<double>(step)) return true;
  }
  return false;
}

double seconds_until_gone(const std::string& run, double limit_s) {
  const double begin_s = now_s();
  while (!processes_of(run).empty() && now_s() - begin_s < limit_s) pause_s(0.02);
  return now_s() - begin_s;
}

std::string fresh_run_id() {
  static int count = 0;
  return "test-" + std::to_string(getpid()) + "-" + std::to_string(count++);
}

std::vector<std::string> differing_files(const fs::path& a, const fs::path& b) {
  std::set<std::string> names;
  for (const fs::path& folder : {a, b})
    for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename());
  names.erase("timing.json");
  names.erase("operator.log");
  std::vector<std::string> differing;
  for (const std::string& name : names)
    if (!fs::exists(a / name) || !fs::exists(b / name) || content(a / name) != content(b / name))
      differing.push_back(name);
  return differing;
}

}  // namespace lukou::test
