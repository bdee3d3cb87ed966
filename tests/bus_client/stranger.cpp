// Somebody on a run's bus who has no business there: knows domain, tag and types, and does what it can to disturb. What
// it does is named on the command line; LUKOU_RUN and LUKOU_DOMAIN name the run. Ends by itself after three seconds,
// but for `reads`, which never does.
//
//   stranger flood TOPIC           as many samples as it can write
//   stranger forge TOPIC WHO       plausible samples for steps past, present and future
//   stranger malform TOPIC WHO     columns of different length, values out of range, NaN, huge counts
//   stranger oversize TOPIC WHO    samples of 80 MB
//   stranger dispose TOPIC         takes back what the topic's true writer says
//   stranger clock WHO             a second clock: aborts, grants, fences, ends the run and says so to observers
//   stranger reads                 reliable readers of every topic that take nothing
//
// TOPIC: air roadside request signal traffic control up run_state view. WHO: `own` = says truly who it is; `key` =
// under the key of the topic's true writer; `twin` = also claims to be it in its USER_DATA.

#include <dds/dds.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "bus.h"

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kHowLong = std::chrono::seconds(3);
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

dds_entity_t made(dds_entity_t entity, const char* what) {
  if (entity >= 0) return entity;
  std::fprintf(stderr, "stranger: cannot create %s: %s\n", what, dds_strretcode(-entity));
  std::exit(1);
}

struct TopicOf {
  const dds_topic_descriptor_t* type;
  bool best_effort = false;
  bool transient = false;
};
const std::map<std::string, TopicOf> kTopics = {{"air", {&lukou_bus_Air_desc}},
                                                {"roadside", {&lukou_bus_Roadside_desc}},
                                                {"request", {&lukou_bus_Request_desc}},
                                                {"signal", {&lukou_bus_Signal_desc}},
                                                {"traffic", {&lukou_bus_Traffic_desc}},
                                                {"control", {&lukou_bus_Control_desc}},
                                                {"up", {&lukou_bus_Up_desc}},
                                                {"run_state", {&lukou_bus_RunState_desc, false, true}},
                                                {"view", {&lukou_bus_View_desc, true, false}}};

class Stranger {
 public:
  Stranger(std::uint32_t domain, const std::string& run) {
    const std::string config =
        "<Domain id=\"any\"><General><Interfaces><NetworkInterface name=\"lo\" multicast=\"false\"/></Interfaces>"
        "<AllowMulticast>false</AllowMulticast><MaxMessageSize>65500B</MaxMessageSize>"
        "<FragmentSize>64000B</FragmentSize></General>"
        "<Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>60</MaxAutoParticipantIndex>"
        "<Peers><Peer Address=\"127.0.0.1\"/></Peers><Tag>lukou-" +
        run + "</Tag></Discovery></Domain>";
    made(dds_create_domain(domain, config.c_str()), "the domain");
    participant_ = made(dds_create_participant(domain, nullptr, nullptr), "a participant");
    self_ = std::random_device{}() | 1ULL << 63U;
  }

  dds_entity_t reader(const std::string& name) { return endpoint(name, false, self_); }
  dds_entity_t writer(const std::string& name, std::uint64_t user_data) { return endpoint(name, true, user_data); }
  [[nodiscard]] std::uint64_t self() const { return self_; }

  /// Who writes a topic, as its endpoint says; waits for it.
  std::uint64_t true_writer(const std::string& name) {
    const dds_entity_t listener = reader(name);
    for (int i = 0; i < 300; ++i) {
      dds_instance_handle_t handle = 0;
      if (dds_get_matched_publications(listener, &handle, 1) > 0) {
        dds_builtintopic_endpoint_t* other = dds_get_matched_publication_data(listener, handle);
        std::uint64_t incarnation = 0;
        void* data = nullptr;
        std::size_t size = 0;
        if (other != nullptr && dds_qget_userdata(other->qos, &data, &size) && size == sizeof incarnation) {
          std::memcpy(&incarnation, data, size);
        }
        dds_free(data);
        if (other != nullptr) dds_builtintopic_free_endpoint(other);
        dds_delete(listener);
        return incarnation;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    std::fprintf(stderr, "stranger: nobody writes %s\n", name.c_str());
    std::exit(1);
  }

 private:
  dds_entity_t endpoint(const std::string& name, bool writes, std::uint64_t user_data) {
    const TopicOf& topic = kTopics.at(name);
    dds_qos_t* qos = dds_create_qos();
    dds_qset_reliability(qos, topic.best_effort ? DDS_RELIABILITY_BEST_EFFORT : DDS_RELIABILITY_RELIABLE,
                         DDS_MSECS(10));
    dds_qset_history(qos, writes ? DDS_HISTORY_KEEP_LAST : DDS_HISTORY_KEEP_ALL, 16);
    if (topic.transient) dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
    // What readers of a stream ask for.
    if (writes && (name == "control" || name == "up")) dds_qset_liveliness(qos, DDS_LIVELINESS_AUTOMATIC, DDS_SECS(2));
    dds_qset_userdata(qos, &user_data, sizeof user_data);
    const std::string full = "lukou/" + name;
    const dds_entity_t on =
        made(dds_create_topic(participant_, topic.type, full.c_str(), nullptr, nullptr), full.c_str());
    const dds_entity_t made_one = made(
        writes ? dds_create_writer(participant_, on, qos, nullptr) : dds_create_reader(participant_, on, qos, nullptr),
        full.c_str());
    dds_delete_qos(qos);
    return made_one;
  }

  dds_entity_t participant_ = 0;
  std::uint64_t self_ = 0;
};

/// Storage for the sequences of samples.
struct Columns {
  std::vector<std::uint8_t> octets = std::vector<std::uint8_t>(64, 1);
  std::vector<std::uint16_t> shorts = std::vector<std::uint16_t>(64, 1);
  std::vector<std::uint32_t> longs = std::vector<std::uint32_t>(64, 1);
  std::vector<std::uint64_t> ids = std::vector<std::uint64_t>(64, 1);
  std::vector<std::int64_t> steps = std::vector<std::int64_t>(64, 1);
  std::vector<double> numbers = std::vector<double>(64, 1.0);
  std::vector<char*> texts = std::vector<char*>(64, const_cast<char*>("traffic.west.flow_veh_per_h=7"));
};

template <class Sequence, class T>
void lend(Sequence& sequence, std::vector<T>& column, std::uint32_t count) {
  sequence._buffer = column.data();
  sequence._length = sequence._maximum = count;
  sequence._release = false;
}

template <class FramesType>
void lend_frames(FramesType& frames, Columns& c, std::uint32_t count) {
  lend(frames.sender, c.ids, count), lend(frames.sequence_number, c.longs, count), lend(frames.kind, c.octets, count);
  lend(frames.wire_bytes, c.longs, count), lend(frames.antenna_x_m, c.numbers, count);
  lend(frames.antenna_y_m, c.numbers, count), lend(frames.payload_end, c.longs, count);
  lend(frames.payload, c.octets, count > 0 ? 1 : 0);
}

constexpr char* kNothing = const_cast<char*>("");

/// A sample that looks like one of the topic, with `rows` in its columns.
struct Sample {
  lukou_bus_Air air{};
  lukou_bus_Roadside roadside{};
  lukou_bus_Request request{};
  lukou_bus_Signal signal{};
  lukou_bus_Traffic traffic{};
  lukou_bus_Control control{};
  lukou_bus_Up up{};
  lukou_bus_RunState run_state{};
  lukou_bus_View view{};
  Columns columns;

  void* of(const std::string& topic, std::uint64_t key, std::int64_t step, std::uint32_t rows) {
    Columns& c = columns;
    if (topic == "air") {
      air.producer = key, air.epoch = 1, air.step = step;
      lend_frames(air.frames, c, rows);
      return &air;
    }
    if (topic == "roadside") {
      roadside.producer = key, roadside.epoch = 1, roadside.step = step, roadside.rsu = 0;
      lend_frames(roadside.frames, c, rows);
      return &roadside;
    }
    if (topic == "request") {
      request.producer = key, request.epoch = 1, request.step = step, request.rsu = 0;
      lend(request.lanes, c.shorts, rows), lend(request.lifetime, c.steps, rows);
      return &request;
    }
    if (topic == "signal") {
      signal.producer = key, signal.epoch = 1, signal.step = step, signal.first = step;
      lend(signal.heads, c.octets, 12 * (rows > 0 ? 5U : 0U));  // five steps of red
      return &signal;
    }
    if (topic == "traffic") {
      traffic.producer = key, traffic.epoch = 1, traffic.step = step;
      lend(traffic.arrived, c.longs, 4), lend(traffic.waiting, c.longs, 4);
      lend(traffic.arrived_equipped, c.longs, 4), lend(traffic.waiting_equipped, c.longs, 4);
      lend(traffic.heard_epoch, c.longs, 1), lend(traffic.computing_ms, c.longs, 1);
      return &traffic;
    }
    if (topic == "control") {
      control.clock = key, control.sequence_number = static_cast<std::uint64_t>(step), control.through = 1'000'000;
      control.kind = 4, control.text = kNothing, control.culprit = kNothing;
      lend(control.directive_step, c.steps, rows), lend(control.directive_set, c.texts, rows);
      return &control;
    }
    if (topic == "up") {
      up.incarnation = key, up.kind = static_cast<std::uint8_t>(1 + step % 9), up.protocol = 1, up.number = 1;
      up.step = step, up.role = const_cast<char*>("rsu0"), up.text = kNothing, up.hash = kNothing;
      return &up;
    }
    if (topic == "run_state") {
      run_state.clock = key, run_state.run = kNothing, run_state.phase = 5, run_state.granted = 1'000'000;
      run_state.recorded = 1'000'000, run_state.text = const_cast<char*>("is lost, believe me");
      run_state.culprit = const_cast<char*>("recorder");
      return &run_state;
    }
    view.producer = key, view.step = step;
    return &view;
  }
};

/// Spoils what `Sample::of` has made, in one of several ways.
void spoil(Sample& sample, const std::string& topic, int way) {
  Columns& c = sample.columns;
  static std::vector<double> nothing(64, kNaN);
  if (topic == "air" || topic == "roadside") {
    lukou_bus_Frames& frames = topic == "air" ? sample.air.frames : sample.roadside.frames;
    lend_frames(frames, c, 3);
    if (way == 0) frames.kind._length = 1;
    if (way == 1) lend(frames.antenna_x_m, nothing, 3);
    if (way == 2) frames.payload._length = 0;
    if (way == 3) c.octets[1] = 77;  // a kind of frame
    if (way == 4) sample.roadside.rsu = 4'000'000'000U, sample.roadside.frames_heard = 4'000'000'000U;
    if (way == 5) lend(sample.roadside.reception.heard, c.longs, 5);
  } else if (topic == "signal") {
    if (way == 0) sample.signal.heads._length = 7;
    if (way == 1) c.octets[3] = 200;
    if (way >= 2) lend(sample.signal.change_lane, c.octets, 9);
  } else if (topic == "traffic") {
    if (way == 0) lend(sample.traffic.vehicle, c.longs, 9);
    if (way == 1) sample.traffic.arrived._length = 0;
    if (way >= 2) lend(sample.traffic.fate, c.octets, 5);
  } else if (topic == "request") {
    sample.request.lifetime._length = 0;
  } else if (topic == "control") {
    if (way == 0) sample.control.kind = 99;
    if (way >= 1) lend(sample.control.directive_step, c.steps, 9), sample.control.directive_set._length = 0;
  } else if (topic == "up") {
    sample.up.kind = 200;
  } else if (topic == "run_state") {
    sample.run_state.phase = 99, sample.run_state.pace = kNaN;
  } else {
    lend(sample.view.vehicle, c.longs, 60);
  }
}

/// Does something again and again for three seconds; says how often.
void for_a_while(const std::function<void(int)>& action) {
  const auto end = Clock::now() + kHowLong;
  int times = 0;
  for (; Clock::now() < end; ++times) action(times);
  std::printf("%d\n", times);
}

struct Voice {
  dds_entity_t writer;
  std::uint64_t key;
};

Voice voice(Stranger& stranger, const std::string& topic, const std::string& who) {
  if (who == "own") return {stranger.writer(topic, stranger.self()), stranger.self()};
  const std::uint64_t truth = stranger.true_writer(topic);
  return {stranger.writer(topic, who == "twin" ? truth : stranger.self()), truth};
}

void pause_ms(int milliseconds) { std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds)); }

void forge(Stranger& stranger, const std::string& topic, const std::string& who, bool malformed) {
  const Voice said = voice(stranger, topic, who);
  Sample sample;
  for_a_while([&](int i) {
    // From the beginning, from about where the run is, and from far ahead.
    const std::int64_t step = i % 3 == 0 ? i / 3 : i % 3 == 1 ? 200 + i : 1'000'000 + i;
    sample.columns = Columns{};
    void* forged = sample.of(topic, said.key, step, i % 2 == 0 ? 1 : 0);
    if (malformed) spoil(sample, topic, i % 6);
    dds_write(said.writer, forged);
    pause_ms(2);
  });
}

void oversize(Stranger& stranger, const std::string& topic, const std::string& who) {
  const Voice said = voice(stranger, topic, who);
  Sample sample;
  std::vector<std::uint8_t> huge(80'000'000, 1);
  std::vector<double> numbers(10'000'000, 1.0);
  for (int i = 0; i < 5; ++i) {
    void* forged = sample.of(topic, said.key, 300, 1);
    if (topic == "air") lend(sample.air.frames.payload, huge, static_cast<std::uint32_t>(huge.size()));
    if (topic == "roadside") lend(sample.roadside.frames.payload, huge, static_cast<std::uint32_t>(huge.size()));
    if (topic == "signal") lend(sample.signal.heads, huge, static_cast<std::uint32_t>(huge.size()));
    if (topic == "traffic") lend(sample.traffic.position_m, numbers, static_cast<std::uint32_t>(numbers.size()));
    dds_write(said.writer, forged);
    pause_ms(300);
  }
}

void dispose(Stranger& stranger, const std::string& topic) {
  const std::uint64_t truth = stranger.true_writer(topic);
  const dds_entity_t writer = stranger.writer(topic, stranger.self());
  Sample sample;
  for_a_while([&](int) {
    dds_dispose(writer, sample.of(topic, truth, 0, 0));
    pause_ms(20);
  });
}

void second_clock(Stranger& stranger, const std::string& who) {
  const Voice control = voice(stranger, "control", who);
  const Voice state = voice(stranger, "run_state", who);
  Sample sample;
  for_a_while([&](int i) {
    sample.of("control", control.key, i, 1);
    sample.control.kind = static_cast<std::uint8_t>(1 + i % 8);
    sample.control.last = i % 5 == 0;
    sample.control.epoch = 1;
    sample.control.text = const_cast<char*>("is lost, believe me");
    sample.control.culprit = const_cast<char*>("recorder");
    dds_write(control.writer, &sample.control);
    sample.of("run_state", state.key, i, 0);
    sample.run_state.phase = static_cast<std::uint8_t>(i % 6);
    dds_write(state.writer, &sample.run_state);
    pause_ms(5);
  });
}

}  // namespace

int main(int argc, char** argv) {
  const char *run = std::getenv("LUKOU_RUN"), *domain = std::getenv("LUKOU_DOMAIN");
  const std::string what = argc > 1 ? argv[1] : "";
  const std::string topic = argc > 2 ? argv[2] : "";
  const std::string who = argc > 3 ? argv[3] : "own";
  if (run == nullptr || domain == nullptr || what.empty()) return 2;
  Stranger stranger(static_cast<std::uint32_t>(std::atoi(domain)), run);
  if (what == "flood") {
    const Voice said = voice(stranger, topic, "own");
    Sample sample;
    for_a_while([&](int i) { dds_write(said.writer, sample.of(topic, said.key, i, 1)); });
  } else if (what == "forge" || what == "malform") {
    forge(stranger, topic, who, what == "malform");
  } else if (what == "oversize") {
    oversize(stranger, topic, who);
  } else if (what == "dispose") {
    dispose(stranger, topic);
  } else if (what == "clock") {
    second_clock(stranger, topic.empty() ? "own" : topic);
  } else if (what == "reads") {
    for (const auto& [name, type] : kTopics) stranger.reader(name);
    std::printf("reads\n");
    std::fflush(stdout);
    while (true) pause();
  } else {
    return 2;
  }
  return 0;
}
