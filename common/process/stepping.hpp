#pragma once

#include <exception>
#include <string>

#include "common/process/environment.hpp"
#include "common/process/log.hpp"
#include "common/process/member.hpp"

namespace lukou::process {

/// The loop of a stepped participant: every step once, in order, as soon as a grant covers it and its inputs are in
/// hand. `receive()` takes what came in from the process's readers into its edges; `waiting_for(k)` names whose batch
/// step k lacks ("" = none); `execute(k)` computes the step and publishes its batches.
template <class Receive, class WaitingFor, class Execute>
void run_steps(Member& member, Receive receive, WaitingFor waiting_for, Execute execute) {
  std::optional<Step> next;
  while (member.running()) {
    member.poll();
    receive();
    if (!next) next = member.first_step();
    if (!next || !member.granted(*next)) {
      member.wait(std::string(kClockRole));
      continue;
    }
    if (const std::string whom = waiting_for(*next); !whom.empty()) {
      member.wait(whom);
      continue;
    }
    execute(*next);
    member.executed(*next);
    ++*next;
  }
  member.leave();
}

/// Takes what has come in. `accept(batch, info)` puts it where it belongs; a sender whose batch has no place there,
/// such as one after a gap in the steps, is of no use to the run any more.
template <class Batch, class Accept>
void hear(Member& member, bus::Reader<Batch>& reader, Accept accept) {
  reader.take([&](Batch& batch, const bus::SampleInfo& info) {
    if (!info.alive) return;
    if (Expected<Done> done = accept(batch, info); !done) {
      member.distrust(info.producer, std::string("topic ") + reader.topic() + ": " + done.error().what);
    }
  });
}

/// Ends a member's part because it cannot go on itself.
inline void give_up(Member& member, const std::string& role, const Error& error) {
  log_error(error.text());
  member.finish({MemberEnd::Kind::kAborted, role, error.text()});
}

/// Runs a program's body; what it throws becomes one line and exit code 1.
template <class Body>
int guarded(const std::string& program, Body body) {
  try {
    set_log_name(program);
    return body();
  } catch (const std::exception& error) {
    log_error(std::string("internal error: ") + error.what());
    return kExitInternal;
  }
}

/// Says why this process takes no part.
inline int report_start(const Error& error, int exit_code) {
  log_error(error.text());
  return exit_code;
}

/// Says how the run ended if it did not end well.
inline int report_end(const MemberEnd& end) {
  if (end.kind == MemberEnd::Kind::kClockLost || end.kind == MemberEnd::Kind::kFenced) {
    log_error(end.text);
  } else if (end.kind == MemberEnd::Kind::kAborted) {
    log_error("the run was aborted: " + end.culprit + " " + end.text);
  }
  return end.exit_code();
}

}  // namespace lukou::process
