#include "common/process/environment.hpp"

#include <unistd.h>

#include <chrono>
#include <csignal>
#include <ctime>
#include <random>
#include <thread>

namespace lukou::process {
namespace {

volatile std::sig_atomic_t g_stop_signal = 0;
volatile std::sig_atomic_t g_stop_sender = 0;
pid_t g_launcher = 0;

constexpr unsigned kGiveUp_s = 10;

void remember(int signal) { g_stop_signal = signal; }

/// Nobody is left to end a process that cannot end itself, such as an algorithm that never comes back.
void remember_and_give_up(int signal) {
  remember(signal);
  alarm(kGiveUp_s);
}

void remember_sender(int signal, siginfo_t* info, void* /*context*/) {
  g_stop_sender = info->si_pid;
  g_stop_signal = signal;
}

void on_signal(int signal, void (*handler)(int)) {
  struct sigaction action{};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, nullptr);
}

}  // namespace

double wall_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

std::string wall_stamp() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char text[32];
  std::strftime(text, sizeof text, "%Y%m%d-%H%M%S", &local);
  return text;
}

void sleep_s(double duration_s) { std::this_thread::sleep_for(std::chrono::duration<double>(duration_s)); }

Incarnation new_incarnation() {
  std::random_device device;
  const Incarnation high = device();
  const Incarnation value = (high << 32U) | device();
  return value == 0 ? 1 : value;
}

void catch_stop_signals() {
  on_signal(SIGINT, remember);
  on_signal(SIGTERM, remember);
  on_signal(SIGHUP, remember);
  on_signal(launcher_died_signal(), remember);
  on_signal(SIGPIPE, SIG_IGN);
}

void catch_terminate_signal() {
  on_signal(SIGINT, SIG_IGN);
  on_signal(SIGHUP, SIG_IGN);
  g_launcher = getppid();
  struct sigaction terminate{};
  terminate.sa_sigaction = remember_sender;
  terminate.sa_flags = SA_SIGINFO;
  sigemptyset(&terminate.sa_mask);
  sigaction(SIGTERM, &terminate, nullptr);
  on_signal(clock_died_signal(), remember);
  on_signal(launcher_died_signal(), remember_and_give_up);
  on_signal(SIGPIPE, SIG_IGN);
}

int clock_died_signal() { return SIGUSR1; }

int launcher_died_signal() { return SIGUSR2; }

int stop_signal() { return g_stop_signal; }

bool terminated_by_launcher() { return g_stop_signal == SIGTERM && g_stop_sender == g_launcher; }

}  // namespace lukou::process
