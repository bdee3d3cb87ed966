// An RSU that is a member of its run, works as it should until step 50, and then sends what the contract does not
// allow.
//   spoiling_rsu WAY        columns nan kinds payload flood gap again other_rsu; request: the same with a request's
//   columns

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <optional>

#include "common/process/stepping.hpp"

using namespace lukou;

namespace {

constexpr Step kFrom = 50;

/// Spoils an answer; `previous`: the batch before it.
void spoil(const std::string& way, RoadsideBatch& batch) {
  Frames& frames = batch.frames;
  frames.sender = {1, 2}, frames.sequence = {1, 2}, frames.kind = {5, 5}, frames.wire_bytes = {40, 40};
  frames.antenna_x_m = {0.0, 0.0}, frames.antenna_y_m = {0.0, 0.0}, frames.payload_end = {1, 2},
  frames.payload = {1, 2};
  if (way == "columns") frames.kind.pop_back();
  if (way == "nan") frames.antenna_x_m[1] = std::numeric_limits<double>::quiet_NaN();
  if (way == "kinds") frames.kind[0] = 200;
  if (way == "payload") frames.payload_end[1] = 4'000'000'000U;
  if (way == "flood") {
    frames.sender.assign(100'000, 1), frames.sequence.assign(100'000, 1), frames.kind.assign(100'000, 5);
    frames.wire_bytes.assign(100'000, 40), frames.antenna_x_m.assign(100'000, 0.0);
    frames.antenna_y_m.assign(100'000, 0.0), frames.payload_end.assign(100'000, 2);
  }
  if (way == "gap") batch.step += 3;
  if (way == "again") batch.step -= 1;
  if (way == "other_rsu") batch.rsu = 7;
}

int run(const std::string& way) {
  const char *run = std::getenv("LUKOU_RUN"), *domain = std::getenv("LUKOU_DOMAIN");
  if (run == nullptr || domain == nullptr) return process::kExitUsage;
  process::catch_terminate_signal();
  auto created = process::Member::create({.role = "rsu0", .address = {std::atoi(domain), run}});
  if (!created) return process::report_start(created.error(), process::kExitAborted);
  process::Member& member = *created.value();
  bus::Writer<RoadsideBatch> roadside(member.participant());
  bus::Reader<AirBatch> air_in(member.participant());
  bus::Reader<SignalBatch> signal_in(member.participant());
  member.faces(Topic::kRoadside, roadside);
  member.faces(Topic::kAir, air_in);
  member.faces(Topic::kSignal, signal_in);
  const auto welcome = member.join();
  if (!welcome) return process::report_start(welcome.error(), process::kExitUsage);
  std::optional<bus::Writer<RequestBatch>> requests;
  if (welcome.value().find("actuation {") != std::string::npos) {
    requests.emplace(member.participant());
    member.faces(Topic::kRequest, *requests);
  }
  Edge<AirBatch> air(kSameStep, member.epoch() == 1);
  bool begun = member.epoch() == 1;
  process::run_steps(
      member,
      [&] {
        if (!begun && member.first_step()) {
          begun = true;
          static_cast<void>(air.begin(*member.first_step()));
        }
        process::hear(member, air_in,
                      [&](AirBatch& batch, const bus::SampleInfo& info) { return air.accept(info.epoch, batch); });
        process::hear(member, signal_in, [](SignalBatch&, const bus::SampleInfo&) { return Expected<Done>(Done{}); });
      },
      [&](Step k) { return air.ready(k) ? std::string() : std::string(kEngineRole); },
      [&](Step k) {
        static_cast<void>(air.take(k));
        RoadsideBatch answer{.epoch = member.epoch(), .step = k};
        RequestBatch request{.epoch = member.epoch(), .step = k};
        if (k >= kFrom && requests) {
          request.lanes = {1, 2};
          request.lifetime = {100};
        } else if (k >= kFrom) {
          spoil(way, answer);
        }
        roadside.write(answer, member.epoch());
        if (requests) requests->write(request, member.epoch());
      });
  return process::report_end(member.end());
}

}  // namespace

int main(int argc, char** argv) {
  return process::guarded("spoiling-rsu", [&] { return run(argc > 1 ? argv[1] : ""); });
}
