#include "common/bus/cyclone_config.hpp"

#include "common/core/hash.hpp"
#include "common/core/markup.hpp"

namespace lukou::bus {
namespace {

std::string fragment(const std::string& body) { return "<Domain id=\"any\">" + body + "</Domain>"; }

std::string network(const CycloneSettings& settings) {
  const bool hosts = !settings.peers.empty();
  const std::string interface = hosts ? "address=\"" + markup_text(settings.own_address) + "\"" : "name=\"lo\"";
  std::string peers;
  for (const std::string& peer : settings.peers) peers += "<Peer Address=\"" + markup_text(peer) + "\"/>";
  if (!hosts) peers = "<Peer Address=\"127.0.0.1\"/>";
  return "<General><Interfaces><NetworkInterface " + interface + " multicast=\"false\"/></Interfaces>" +
         "<AllowMulticast>false</AllowMulticast></General>"
         "<Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>60</MaxAutoParticipantIndex>"
         "<Peers>" +
         peers + "</Peers></Discovery>";
}

std::string security(const Identity& identity, const std::string& plugins) {
  const auto library = [&](const std::string& file, const std::string& what) {
    return "<Library path=\"" + markup_text(plugins + "/libdds_security_" + file + ".so") + "\" initFunction=\"init_" +
           what + "\" finalizeFunction=\"finalize_" + what + "\"/>";
  };
  const auto file = [&](const std::string& element, std::string_view name) {
    return "<" + element + ">file:" + markup_text((identity.folder / name).string()) + "</" + element + ">";
  };
  return "<Security><Authentication>" + library("auth", "authentication") + file("IdentityCA", kAuthorityFile) +
         file("IdentityCertificate", kCertificateFile) + file("PrivateKey", kKeyFile) +
         "</Authentication><AccessControl>" + library("ac", "access_control") + file("PermissionsCA", kAuthorityFile) +
         file("Governance", kGovernanceFile) + file("Permissions", kPermissionsFile) +
         "</AccessControl><Cryptographic>" + library("crypto", "crypto") + "</Cryptographic></Security>";
}

}  // namespace

std::string discovery_tag(const std::string& run, bool secured) {
  return "lukou-" + (secured ? sha256_hex(run).substr(0, 16) : run);
}

std::string cyclone_config(const CycloneSettings& settings) {
  // Given by the user: his interfaces and peers replace ours.
  const bool users = !settings.users_uri.empty();
  // One datagram a batch where nothing is lost; between hosts packets of an Ethernet, since what is lost of a larger
  // one is lost with all of it.
  const std::string sizes = settings.peers.empty()
                                ? "<MaxMessageSize>65500B</MaxMessageSize><FragmentSize>64000B</FragmentSize>"
                                : "<MaxMessageSize>1452B</MaxMessageSize><FragmentSize>1344B</FragmentSize>";
  const std::string ours =
      "<General>" + sizes +
      "</General>"
      // An announcement that is lost on a busy machine comes again after a second, not after 30.
      "<Discovery><LeaseDuration>60s</LeaseDuration><SPDPInterval>1s</SPDPInterval></Discovery>"
      // Nothing of ours is as large as 64 MB, so nobody has to take such a thing from a stranger.
      "<Internal><WriterLingerDuration>0s</WriterLingerDuration><MaxSampleSize>64MB</MaxSampleSize>"
      // Writers keep a bounded history; no number of bytes that somebody has not taken may make
      // them wait.
      "<Watermarks><WhcLow>1MB</WhcLow><WhcHigh>1GB</WhcHigh><WhcHighInit>1GB</WhcHighInit>"
      "<WhcAdaptive>false</WhcAdaptive></Watermarks></Internal>";
  std::string config = fragment((users ? "" : network(settings)) + ours);
  if (users) config += "," + settings.users_uri;
  const std::string secured = settings.identity == nullptr ? "" : security(*settings.identity, settings.plugins);
  const std::string tag = discovery_tag(settings.run, settings.identity != nullptr);
  return config + "," + fragment(secured + "<Discovery><Tag>" + tag + "</Tag></Discovery>");
}

}  // namespace lukou::bus
