#pragma once

#include <dds/dds.h>

#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>

#include "common/bus/participant.hpp"

namespace lukou::bus {

/// What a participant owns in Cyclone, and what its readers tell it.
struct Participant::Entities {
  Incarnation self = 0;
  std::shared_ptr<void> domain;
  dds_entity_t participant = 0;
  bool hosts = false;  ///< the run is spread over several
  std::function<bool()> keep_writing = [] { return true; };
  std::map<std::string, Foreign> foreign;  ///< by topic

  // Cyclone's threads say that a reader has news, the application's waits for it.
  std::mutex news_mutex;
  std::condition_variable news_came;
  bool news = false;

  Entities() = default;
  Entities(const Entities&) = delete;
  Entities& operator=(const Entities&) = delete;
  ~Entities() {
    if (participant > 0) dds_delete(participant);
  }

  void tell_news() {
    const std::lock_guard lock(news_mutex);
    news = true;
    news_came.notify_one();
  }
};

}  // namespace lukou::bus
