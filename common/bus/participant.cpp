#include "common/bus/participant.hpp"

#include <dds/dds.h>
#include <dds/version.h>

#include <chrono>
#include <cstdlib>
#include <map>
#include <mutex>

#include "common/bus/cyclone_config.hpp"
#include "common/bus/entities.hpp"

namespace lukou::bus {
namespace {

std::string reason(dds_return_t code) { return dds_strretcode(-code); }

}  // namespace

std::string library_version() { return std::string("Cyclone DDS ") + DDS_VERSION; }

namespace {

/// A process has one DDS domain per id, whoever in it asks first: participants of the same run share it.
class Domain {
 public:
  static Expected<std::shared_ptr<Domain>> of(const Address& address) {
    static std::mutex mutex;
    static std::map<int, std::weak_ptr<Domain>> open;
    const std::string where = "DDS domain " + std::to_string(address.domain);
    const std::lock_guard lock(mutex);
    if (auto domain = open[address.domain].lock()) {
      if (domain->run_ == address.run) return domain;
      return Error{where, "is in use for the run " + domain->run_ + " in this process"};
    }
    const std::string config = cyclone_config(address.run, std::getenv("CYCLONEDDS_URI"));
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

Expected<std::unique_ptr<Participant>> Participant::join(const Address& address, Incarnation self) {
  auto entities = std::make_unique<Entities>();
  entities->self = self;
  auto domain = Domain::of(address);
  if (!domain) return domain.error();
  entities->domain = std::move(domain).value();
  entities->participant = dds_create_participant(static_cast<dds_domainid_t>(address.domain), nullptr, nullptr);
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
