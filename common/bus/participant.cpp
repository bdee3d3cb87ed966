#include "common/bus/participant.hpp"

#include <dds/dds.h>
#include <dds/version.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <optional>

#include "common/bus/cyclone_config.hpp"
#include "common/bus/identity.hpp"
#include "common/bus/samples.hpp"
#include "common/bus/surroundings.hpp"
#include "common/core/contract.hpp"

namespace lukou::bus {
namespace {

constexpr std::int32_t kHistorySteps = 512;
/// Silence that means that a process is gone. Cyclone gives a sign of life when 80 % of it are over; between hosts that
/// may be lost, and said again.
constexpr dds_duration_t kSilence = DDS_SECS(2);
constexpr dds_duration_t kSilenceOfHosts = DDS_SECS(10);

std::string reason(dds_return_t code) { return dds_strretcode(-code); }

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

Qos qos_of(Service service, bool writer, Incarnation self, dds_duration_t silence) {
  Qos qos(dds_create_qos());
  const bool reliable = service != Service::kPicture;
  dds_qset_reliability(qos.get(), reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, DDS_MSECS(100));
  const bool keep_all = service == Service::kStream || (service == Service::kLockstep && !writer);
  const std::int32_t depth = service == Service::kLockstep ? kHistorySteps : 1;
  dds_qset_history(qos.get(), keep_all ? DDS_HISTORY_KEEP_ALL : DDS_HISTORY_KEEP_LAST, depth);
  if (service == Service::kState) {
    dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
    dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, 1, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED,
                                DDS_LENGTH_UNLIMITED);
  }
  if (writer) {
    // A process that dies must not look like one that says good-bye.
    dds_qset_writer_data_lifecycle(qos.get(), false);
    if (service == Service::kStream) dds_qset_liveliness(qos.get(), DDS_LIVELINESS_AUTOMATIC, silence);
  }
  dds_qset_userdata(qos.get(), &self, sizeof self);
  return qos;
}

Incarnation incarnation_in(const dds_builtintopic_endpoint_t& endpoint) {
  void* data = nullptr;
  std::size_t size = 0;
  Incarnation incarnation = 0;
  if (dds_qget_userdata(endpoint.qos, &data, &size) && size == sizeof incarnation) {
    std::memcpy(&incarnation, data, size);
  }
  dds_free(data);
  return incarnation;
}

/// Incarnations at the other end of an endpoint.
template <class List, class Describe>
std::set<Incarnation> matched_with(dds_entity_t entity, List list, Describe describe) {
  std::array<dds_instance_handle_t, 256> handles{};
  const dds_return_t count = list(entity, handles.data(), handles.size());
  std::set<Incarnation> found;
  for (dds_return_t i = 0; i < count; ++i) {
    if (dds_builtintopic_endpoint_t* endpoint = describe(entity, handles[static_cast<std::size_t>(i)])) {
      found.insert(incarnation_in(*endpoint));
      dds_builtintopic_free_endpoint(endpoint);
    }
  }
  return found;
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

}  // namespace

std::string Address::tag() const { return discovery_tag(run, !identity.empty()); }

std::string library_version() { return std::string("Cyclone DDS ") + DDS_VERSION; }

namespace {

/// A process has one DDS domain per id, whoever in it asks first: participants of the same run share it.
class Domain {
 public:
  static Expected<std::shared_ptr<Domain>> of(const Address& address, const Identity* identity) {
    static std::mutex mutex;
    static std::map<int, std::weak_ptr<Domain>> open;
    const std::string where = "DDS domain " + std::to_string(address.domain);
    const std::lock_guard lock(mutex);
    if (auto domain = open[address.domain].lock()) {
      if (domain->run_ == address.run) return domain;
      return Error{where, "is in use for the run " + domain->run_ + " in this process"};
    }
    const char* users = std::getenv("CYCLONEDDS_URI");
    CycloneSettings settings{.run = address.run, .peers = address.peers, .identity = identity};
    if (users != nullptr) settings.users_uri = users;
    if (!address.peers.empty()) {
      auto own = own_address_towards(address.peers.front());
      if (!own) return own.error();
      settings.own_address = std::move(own).value();
    }
    if (identity != nullptr) {
      auto plugins = security_plugins();
      if (!plugins) return plugins.error();
      settings.plugins = std::move(plugins).value();
    }
    const std::string config = cyclone_config(settings);
    const dds_entity_t entity = dds_create_domain(static_cast<dds_domainid_t>(address.domain), config.c_str());
    if (entity < 0) {
      return Error{where, "cannot be configured (" + reason(entity) +
                              "); check CYCLONEDDS_URI if it is set, and that the loopback interface is up"};
    }
    auto domain = std::make_shared<Domain>(entity, address.run);
    open[address.domain] = domain;
    return domain;
  }

  Domain(dds_entity_t entity, std::string run) : entity_(entity), run_(std::move(run)) {}
  Domain(const Domain&) = delete;
  Domain& operator=(const Domain&) = delete;
  ~Domain() { dds_delete(entity_); }

 private:
  dds_entity_t entity_;
  std::string run_;
};

}  // namespace

struct Participant::Entities {
  Incarnation self = 0;
  std::shared_ptr<Domain> domain;
  dds_entity_t participant = 0;
  dds_entity_t waitset = 0;
  dds_duration_t silence = kSilence;
  std::function<bool()> keep_writing = [] { return true; };

  Entities() = default;
  Entities(const Entities&) = delete;
  Entities& operator=(const Entities&) = delete;
  ~Entities() {
    if (participant > 0) dds_delete(participant);
  }
};

Expected<std::unique_ptr<Participant>> Participant::join(const Address& address, std::string_view role,
                                                         Incarnation self) {
  std::optional<Identity> identity;
  if (!address.identity.empty()) {
    auto opened = open_identity(address.identity);
    if (!opened) return opened.error();
    identity = std::move(opened).value();
    if (identity->role != role) {
      return Error{address.identity.string(),
                   "is the identity of " + identity->role + ", this process is " + std::string(role)};
    }
  }
  auto entities = std::make_unique<Entities>();
  entities->self = self;
  if (!address.peers.empty()) entities->silence = kSilenceOfHosts;
  auto domain = Domain::of(address, identity ? &*identity : nullptr);
  if (!domain) return domain.error();
  entities->domain = std::move(domain).value();
  entities->participant = dds_create_participant(static_cast<dds_domainid_t>(address.domain), nullptr, nullptr);
  if (entities->participant < 0 && identity) {
    return Error{address.identity.string(), "lets nobody into DDS domain " + std::to_string(address.domain) + " (" +
                                                reason(entities->participant) +
                                                "); `lukou keys show DIR` checks the files"};
  }
  if (entities->participant < 0) {
    return Error{"DDS domain " + std::to_string(address.domain),
                 "cannot be joined (" + reason(entities->participant) + "); is loopback up, are UDP ports " +
                     std::to_string(7400 + 250 * address.domain) + " and above free? `lukou doctor` checks both"};
  }
  entities->waitset = made(dds_create_waitset(entities->participant), "a waitset");
  return std::unique_ptr<Participant>(new Participant(std::move(entities)));
}

Participant::Participant(std::unique_ptr<Entities> entities) : entities_(std::move(entities)) {}

Participant::~Participant() = default;

Incarnation Participant::self() const { return entities_->self; }

void Participant::wait(double timeout_s) {
  std::array<dds_attach_t, 1> woken{};
  dds_waitset_wait(entities_->waitset, woken.data(), woken.size(), static_cast<dds_duration_t>(timeout_s * 1e9));
}

void Participant::keep_writing_while(std::function<bool()> question) { entities_->keep_writing = std::move(question); }

namespace {

template <class Batch>
dds_entity_t topic_of(Participant::Entities& entities) {
  using Topic = TopicOf<Batch>;
  return made(dds_create_topic(entities.participant, Topic::descriptor(), Topic::kName, nullptr, nullptr),
              Topic::kName);
}

}  // namespace

template <class Batch>
Writer<Batch>::Writer(Participant& participant) : participant_(participant) {
  auto& entities = participant_.entities();
  const Qos qos = qos_of(TopicOf<Batch>::kService, true, entities.self, entities.silence);
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
  return matched_with(entity_, dds_get_matched_subscriptions, dds_get_matched_subscription_data);
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
  const Qos qos = qos_of(TopicOf<Batch>::kService, false, entities.self, entities.silence);
  entity_ = made(dds_create_reader(entities.participant, topic_of<Batch>(entities), qos.get(), nullptr),
                 TopicOf<Batch>::kName);
  const dds_entity_t news = made(dds_create_readcondition(entity_, DDS_ANY_STATE), "a read condition");
  dds_waitset_attach(entities.waitset, news, news);
}

template <class Batch>
void Reader<Batch>::take(const std::function<void(Batch&, const SampleInfo&)>& receive) {
  constexpr std::size_t kMost = Landing::kMost;
  std::array<dds_sample_info_t, kMost> infos{};
  // A producer's death is told after all that it said: its last samples may still be here when it is gone already.
  std::set<Incarnation> dead;
  for (bool more = true; more;) {
    const dds_return_t count = dds_take(entity_, landing_->places.data(), infos.data(), kMost, kMost);
    if (count <= 0) break;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      const auto& sample = landing_->samples[i];
      const SampleInfo info = info_of(sample);
      if (infos[i].valid_data) {
        copy(sample, scratch_);
        receive(scratch_, info);
      }
      if (infos[i].instance_state != DDS_IST_ALIVE) dead.insert(info.producer);
    }
    more = static_cast<std::size_t>(count) == kMost;
  }
  for (const Incarnation producer : dead) {
    scratch_ = Batch{};
    receive(scratch_, {.producer = producer, .alive = false});
  }
}

template <class Batch>
std::set<Incarnation> Reader<Batch>::matched() const {
  return matched_with(entity_, dds_get_matched_publications, dds_get_matched_publication_data);
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
