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

void remember(int signal) { g_stop_signal = signal; }

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
  on_signal(SIGPIPE, SIG_IGN);
}

void catch_terminate_signal() {
  on_signal(SIGINT, SIG_IGN);
  on_signal(SIGHUP, SIG_IGN);
  on_signal(SIGTERM, remember);
  on_signal(clock_died_signal(), remember);
  on_signal(SIGPIPE, SIG_IGN);
}

int clock_died_signal() { return SIGUSR1; }

int stop_signal() { return g_stop_signal; }

}  // namespace lukou::process
