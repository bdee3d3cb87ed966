#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "common/bus/entities.hpp"
#include "common/bus/flaws.hpp"
#include "common/bus/samples.hpp"

namespace lukou::bus {
namespace {

constexpr std::int32_t kLockstepHistory = 512;
/// The clock says a few hundred things a second at most, and nobody lags behind by more than it grants.
constexpr std::int32_t kStreamHistory = 4096;
/// Silence that means that a process is gone. Cyclone gives a sign of life when 80 % of it are over; between hosts that
/// may be lost, and said again.
constexpr dds_duration_t kSilence = DDS_SECS(2);
constexpr dds_duration_t kSilenceOfHosts = DDS_SECS(10);

/// An entity that must exist: failing here means a bug of ours or a machine out of resources, never bad input.
dds_entity_t made(dds_entity_t entity, const char* what) {
  if (entity < 0) {
    std::fprintf(stderr, "lukou: the bus cannot create %s: %s\n", what, dds_strretcode(-entity));
    std::abort();
  }
  return entity;
}

struct QosDeleter {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, QosDeleter>;

Qos qos_of(Service service, bool writer, const Participant::Entities& entities) {
  Qos qos(dds_create_qos());
  const bool reliable = service != Service::kPicture;
  dds_qset_reliability(qos.get(), reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, DDS_MSECS(100));
  // A writer that kept all would wait for whoever does not read, a stranger too.
  const bool keep_all = !writer && (service == Service::kStream || service == Service::kLockstep);
  const std::int32_t depth = service == Service::kLockstep ? kLockstepHistory
                             : service == Service::kStream ? kStreamHistory
                                                           : 1;
  dds_qset_history(qos.get(), keep_all ? DDS_HISTORY_KEEP_ALL : DDS_HISTORY_KEEP_LAST, depth);
  if (service == Service::kState) {
    dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
    dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, 1, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED,
                                DDS_LENGTH_UNLIMITED);
  }
  if (writer) {
    // A process that dies must not look like one that says good-bye.
    dds_qset_writer_data_lifecycle(qos.get(), false);
    if (service == Service::kStream)
      dds_qset_liveliness(qos.get(), DDS_LIVELINESS_AUTOMATIC, entities.hosts ? kSilenceOfHosts : kSilence);
  }
  dds_qset_userdata(qos.get(), &entities.self, sizeof entities.self);
  return qos;
}

struct EndpointDeleter {
  void operator()(dds_builtintopic_endpoint_t* endpoint) const { dds_builtintopic_free_endpoint(endpoint); }
};
using Endpoint = std::unique_ptr<dds_builtintopic_endpoint_t, EndpointDeleter>;

/// What an endpoint says in its USER_DATA; 0 if it says nothing, or something else.
Incarnation incarnation_in(const Endpoint& endpoint) {
  void* data = nullptr;
  std::size_t size = 0;
  Incarnation incarnation = 0;
  if (endpoint == nullptr || !dds_qget_userdata(endpoint->qos, &data, &size)) return 0;
  if (size == sizeof incarnation) std::memcpy(&incarnation, data, size);
  dds_free(data);
  return incarnation;
}

/// All that are matched with an endpoint. `list`: dds_get_matched_publications or ..._subscriptions.
template <class List>
std::vector<dds_instance_handle_t> handles_of(dds_entity_t entity, List list) {
  std::vector<dds_instance_handle_t> handles(64);
  while (true) {
    const dds_return_t count = list(entity, handles.data(), handles.size());
    if (count <= 0) return {};
    const bool all = static_cast<std::size_t>(count) <= handles.size();
    handles.resize(static_cast<std::size_t>(count));
    if (all) return handles;
  }
}

// Producer and epoch stand in the key field of each sample under different names.
template <class Sample>
SampleInfo info_of(const Sample& sample) {
  if constexpr (requires {
                  sample.producer;
                  sample.epoch;
                }) {
    return {sample.producer, sample.epoch, true};
  } else if constexpr (requires { sample.producer; }) {
    return {sample.producer, 1, true};
  } else if constexpr (requires { sample.clock; }) {
    return {sample.clock, 1, true};
  } else {
    return {sample.incarnation, 1, true};
  }
}

template <class Sample>
void sign(Sample& sample, Incarnation self, std::uint32_t epoch) {
  if constexpr (requires {
                  sample.producer;
                  sample.epoch;
                }) {
    sample.producer = self;
    sample.epoch = epoch;
  } else if constexpr (requires { sample.producer; }) {
    sample.producer = self;
  } else if constexpr (requires { sample.clock; }) {
    sample.clock = self;
  } else {
    sample.incarnation = self;
  }
}

template <class Sample>
std::string step_text(const Sample& sample) {
  if constexpr (requires { sample.step; }) {
    return " of step " + std::to_string(sample.step);
  } else {
    return "";
  }
}

template <class Batch>
dds_entity_t topic_of(Participant::Entities& entities) {
  using Topic = TopicOf<Batch>;
  return made(dds_create_topic(entities.participant, Topic::descriptor(), Topic::kName, nullptr, nullptr),
              Topic::kName);
}

void on_news(dds_entity_t /*reader*/, void* entities) { static_cast<Participant::Entities*>(entities)->tell_news(); }

void note(Participant::Entities& entities, const char* topic, const std::string& what) {
  Foreign& foreign = entities.foreign[topic];
  if (++foreign.samples == 1) foreign.first = what;
}

/// A foreign sender for people.
std::string who(Incarnation writer, Incarnation producer) {
  if (writer == producer) return text_of(producer) + ", which is no member of this run";
  if (writer != 0) return text_of(writer) + ", which says it is " + text_of(producer);
  return "a second writer that says it is " + text_of(producer) + ", or does not say who it is";
}

}  // namespace

std::string text_of(Incarnation incarnation) {
  std::array<char, 17> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(incarnation));
  return text.data();
}

template <class Batch>
Writer<Batch>::Writer(Participant& participant) : participant_(participant) {
  auto& entities = participant_.entities();
  const Qos qos = qos_of(TopicOf<Batch>::kService, true, entities);
  entity_ = made(dds_create_writer(entities.participant, topic_of<Batch>(entities), qos.get(), nullptr),
                 TopicOf<Batch>::kName);
}

template <class Batch>
bool Writer<Batch>::write(const Batch& batch, std::uint32_t epoch) {
  typename TopicOf<Batch>::Sample sample{};
  Scratch scratch;
  lend(batch, sample, scratch);
  sign(sample, participant_.self(), epoch);
  while (true) {
    const dds_return_t code = dds_write(entity_, &sample);
    if (code == DDS_RETCODE_OK) return true;
    // Timed out means not written: somebody does not read. Try again as long as the run goes on.
    if (code != DDS_RETCODE_TIMEOUT || !participant_.entities().keep_writing()) return false;
  }
}

template <class Batch>
void Writer<Batch>::finish(double limit_s) const {
  dds_wait_for_acks(entity_, static_cast<dds_duration_t>(limit_s * 1e9));
}

template <class Batch>
std::set<Incarnation> Writer<Batch>::matched() const {
  std::set<Incarnation> found;
  for (const dds_instance_handle_t handle : handles_of(entity_, dds_get_matched_subscriptions)) {
    found.insert(incarnation_in(Endpoint(dds_get_matched_subscription_data(entity_, handle))));
  }
  found.erase(0);
  return found;
}

/// Where Cyclone puts what a reader takes. Kept from take to take, so that sequences keep their storage; what Cyclone
/// lends it allocates and frees anew for each sample.
template <class Batch>
struct Reader<Batch>::Landing {
  static constexpr std::size_t kMost = 16;
  std::array<typename TopicOf<Batch>::Sample, kMost> samples{};
  std::array<void*, kMost> places{};

  Landing() {
    for (std::size_t i = 0; i < kMost; ++i) places[i] = &samples[i];
  }
  Landing(const Landing&) = delete;
  Landing& operator=(const Landing&) = delete;
  ~Landing() {
    for (auto& sample : samples) dds_sample_free(&sample, TopicOf<Batch>::descriptor(), DDS_FREE_CONTENTS);
  }
};

template <class Batch>
Reader<Batch>::~Reader() = default;

template <class Batch>
Reader<Batch>::Reader(Participant& participant) : participant_(participant), landing_(std::make_unique<Landing>()) {
  auto& entities = participant_.entities();
  const Qos qos = qos_of(TopicOf<Batch>::kService, false, entities);
  dds_listener_t* listener = dds_create_listener(&entities);
  dds_lset_data_available(listener, on_news);
  entity_ = made(dds_create_reader(entities.participant, topic_of<Batch>(entities), qos.get(), listener),
                 TopicOf<Batch>::kName);
  dds_delete_listener(listener);
}

template <class Batch>
const char* Reader<Batch>::topic() {
  return TopicOf<Batch>::kName;
}

template <class Batch>
void Reader<Batch>::take(const std::function<void(Batch&, const SampleInfo&)>& receive) {
  constexpr std::size_t kMost = Landing::kMost;
  constexpr std::size_t kMostAtOnce = 4096;
  std::array<dds_sample_info_t, kMost> infos{};
  // A producer's death is told after all that it said: its last samples may still be here when it is gone already.
  std::set<Incarnation> dead;
  std::size_t taken = 0;
  for (bool more = true; more;) {
    const dds_return_t count = dds_take(entity_, landing_->places.data(), infos.data(), kMost, kMost);
    if (count <= 0) break;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      const auto& sample = landing_->samples[i];
      const SampleInfo info = info_of(sample);
      const Incarnation writer = sender_of(infos[i].publication_handle);
      const Belief belief = infos[i].valid_data ? belief_in(writer, info.producer) : Belief::kIgnored;
      if (belief == Belief::kForeign) {
        note(participant_.entities(), TopicOf<Batch>::kName,
             "a sample" + step_text(sample) + " from " + who(writer, info.producer));
      } else if (belief == Belief::kYes) {
        copy(sample, scratch_);
        const std::string flaw = flaw_of(scratch_);
        if (flaw.empty()) {
          receive(scratch_, info);
        } else if (flawed_) {
          flawed_(writer, std::string("topic ") + TopicOf<Batch>::kName + ":" + step_text(sample) + " " + flaw);
        }
      }
      // Nobody of ours takes a sample back; so whoever does it in another's name tells nothing about that one.
      const bool own_good_bye = !infos[i].valid_data && writer == info.producer;
      if (infos[i].instance_state == DDS_IST_NOT_ALIVE_NO_WRITERS ||
          (infos[i].instance_state == DDS_IST_NOT_ALIVE_DISPOSED && own_good_bye)) {
        dead.insert(info.producer);
      }
    }
    taken += static_cast<std::size_t>(count);
    more = static_cast<std::size_t>(count) == kMost;
    if (more && taken >= kMostAtOnce) {
      participant_.entities().tell_news();
      break;
    }
  }
  for (const Incarnation producer : dead) {
    scratch_ = Batch{};
    receive(scratch_, {.producer = producer, .alive = false});
  }
}

template <class Batch>
Incarnation Reader<Batch>::sender_of(WriterHandle writer) {
  if (!senders_.knows(writer)) {
    senders_.add(writer, incarnation_in(Endpoint(dds_get_matched_publication_data(entity_, writer))));
  }
  return senders_.of(writer);
}

template <class Batch>
Belief Reader<Batch>::belief_in(Incarnation writer, Incarnation producer) const {
  if (writer == 0 || writer != producer) return Belief::kForeign;
  return believes_ ? believes_(producer) : Belief::kYes;
}

template <class Batch>
std::set<Incarnation> Reader<Batch>::matched() {
  std::set<Incarnation> found;
  for (const dds_instance_handle_t handle : handles_of(entity_, dds_get_matched_publications)) {
    found.insert(sender_of(handle));
  }
  found.erase(0);
  return found;
}

template class Writer<AirBatch>;
template class Writer<RoadsideBatch>;
template class Writer<RequestBatch>;
template class Writer<SignalBatch>;
template class Writer<TrafficBatch>;
template class Writer<Control>;
template class Writer<Up>;
template class Writer<RunState>;
template class Writer<View>;
template class Reader<AirBatch>;
template class Reader<RoadsideBatch>;
template class Reader<RequestBatch>;
template class Reader<SignalBatch>;
template class Reader<TrafficBatch>;
template class Reader<Control>;
template class Reader<Up>;
template class Reader<RunState>;
template class Reader<View>;

}  // namespace lukou::bus
