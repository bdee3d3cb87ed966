#include "common/bus/cyclone_config.hpp"

namespace lukou::bus {

std::string cyclone_config(const std::string& run, const char* users_uri) {
  // Given by the user: his interfaces and peers replace ours.
  const bool users = users_uri != nullptr && *users_uri != '\0';
  const std::string network =
      "<General><Interfaces><NetworkInterface name=\"lo\" multicast=\"false\"/></Interfaces>"
      "<AllowMulticast>false</AllowMulticast></General>"
      "<Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>60</MaxAutoParticipantIndex>"
      "<Peers><Peer Address=\"127.0.0.1\"/></Peers></Discovery>";
  const std::string ours =
      "<General><MaxMessageSize>65500B</MaxMessageSize><FragmentSize>64000B</FragmentSize></General>"
      // An announcement that is lost on a busy machine comes again after a second, not after 30.
      "<Discovery><LeaseDuration>60s</LeaseDuration><SPDPInterval>1s</SPDPInterval></Discovery>"
      // Nothing of ours is as large as 64 MB, so nobody has to take such a thing from a stranger.
      "<Internal><WriterLingerDuration>0s</WriterLingerDuration><MaxSampleSize>64MB</MaxSampleSize>"
      // Writers keep a bounded history; no number of bytes that somebody has not taken may make them wait.
      "<Watermarks><WhcLow>1MB</WhcLow><WhcHigh>1GB</WhcHigh><WhcHighInit>1GB</WhcHighInit>"
      "<WhcAdaptive>false</WhcAdaptive></Watermarks></Internal>";
  const std::string tag = "<Discovery><Tag>lukou-" + run + "</Tag></Discovery>";
  const auto fragment = [](const std::string& body) { return "<Domain id=\"any\">" + body + "</Domain>"; };
  std::string config = fragment((users ? "" : network) + ours);
  if (users) config += "," + std::string(users_uri);
  return config + "," + fragment(tag);
}

}  // namespace lukou::bus
