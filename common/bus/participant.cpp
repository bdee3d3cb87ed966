#include "common/bus/participant.hpp"

#include <dds/dds.h>
#include <dds/version.h>

#include <chrono>
#include <cstdlib>
#include <map>
#include <mutex>
#include <optional>

#include "common/bus/cyclone_config.hpp"
#include "common/bus/entities.hpp"
#include "common/bus/identity.hpp"
#include "common/bus/surroundings.hpp"

namespace lukou::bus {
namespace {

std::string reason(dds_return_t code) { return dds_strretcode(-code); }

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
  entities->hosts = !address.peers.empty();
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
  return std::unique_ptr<Participant>(new Participant(std::move(entities)));
}

Participant::Participant(std::unique_ptr<Entities> entities) : entities_(std::move(entities)) {}

Participant::~Participant() = default;

Incarnation Participant::self() const { return entities_->self; }

void Participant::wait(double timeout_s) {
  // Not at a waitset of Cyclone's: that counts its timeout on the host's wall clock, and whoever sets that back would
  // make everybody sleep until it has caught up.
  std::unique_lock lock(entities_->news_mutex);
  entities_->news_came.wait_for(lock, std::chrono::duration<double>(timeout_s), [this] { return entities_->news; });
  entities_->news = false;
}

const std::map<std::string, Foreign>& Participant::foreign() const { return entities_->foreign; }

std::uint64_t Participant::foreign_samples() const {
  std::uint64_t samples = 0;
  for (const auto& [topic, foreign] : entities_->foreign) samples += foreign.samples;
  return samples;
}

void Participant::keep_writing_while(std::function<bool()> question) { entities_->keep_writing = std::move(question); }

}  // namespace lukou::bus
