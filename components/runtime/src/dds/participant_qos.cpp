// SPDX-License-Identifier: Apache-2.0
#include "participant_qos.hpp"

#include <spdlog/fmt/fmt.h>
#include <unistd.h>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>
#include <string_view>
#include <vector>

#include "environment_variable.hpp"
#include "fast_dds_transports.hpp"
#include "panvo/runtime/errors.hpp"
#include "security_qos.hpp"
#include "udp_transport.hpp"

namespace panvo::runtime::dds {

namespace {

constexpr std::uint32_t kSocketBufferSize = 4 * 1024 * 1024;

// A fragment per millisecond: half a gigabit per second. A receiver with the kernel's default buffer (208 KB, doubled by
// the kernel) that is not scheduled at the moment keeps it. Of images of 307 kB and panoramas of 1.75 MB, 95 % and 94 %
// reached a best-effort reader of ROS 2 on the same machine, of two fragments at once 84 % and 76 %, of 256 KB 38 % and
// 11 %, without pacing 29 % and 4 %.
constexpr std::int32_t kBytesPerPeriod = 64 * 1024;

// A new participant answers another's first announcement only once; if the answer is lost, it is found at the next
// periodic announcement. The default of 3 s was reached in one start of ten.
constexpr std::int32_t kAnnouncementPeriodNs = 500'000'000;

// As rmw_fastrtps: number of participants that are looked for on a host without multicast.
constexpr std::uint32_t kParticipantsPerPeer = 32;

constexpr const char* kServersVariable = "ROS_DISCOVERY_SERVER";

/// Address of a host; its port is left open. Throws ConfigError that names the environment variable with the host.
rtps::Locator_t locator_of(const std::string& host, const char* variable = "ROS_STATIC_PEERS") {
  const auto addresses = rtps::IPLocator::resolveNameDNS(host).first;
  if (addresses.empty()) {
    throw ConfigError(
        fmt::format("{}: the host {} is unknown; correct its name, or write its IPv4 address", variable, host));
  }
  rtps::Locator_t locator;
  rtps::IPLocator::setIPv4(locator, *addresses.begin());
  return locator;
}

// Called with factory_mutex() locked, as Fast DDS's own reading of the variable.
#ifdef PANVO_FAST_DDS_3
/// Of "HOST:PORT;HOST:PORT"; an entry may be empty.
auto servers() {
  constexpr std::uint32_t kDefaultPort = 11811;
  const std::regex form(R"((?:UDPv4:)?\[?([^\]:\s]+)\]?(?::(\d{1,5}))?)");
  decltype(rtps::DiscoverySettings::m_DiscoveryServers) servers;
  std::istringstream entries(environment_variable(kServersVariable));
  for (std::string entry; std::getline(entries, entry, ';');) {
    if (entry.empty()) continue;
    std::smatch parts;
    if (!std::regex_match(entry, parts, form))
      throw ConfigError(fmt::format("{}: '{}' is not an address; write HOST:PORT", kServersVariable, entry));
    auto server = locator_of(parts[1], kServersVariable);
    server.port = parts[2].matched ? static_cast<std::uint32_t>(std::stoul(parts[2])) : kDefaultPort;
    servers.push_back(server);
  }
  return servers;
}
#else
auto servers() {
  rtps::RemoteServerList_t servers;
  rtps::load_environment_server_info(servers);
  return servers;
}
#endif

// With ROS_DISCOVERY_SERVER, Fast DDS makes a participant a client, which learns only of matching endpoints.
void hear_of_all_topics(rtps::DiscoverySettings& discovery) {
  if (discovery.discoveryProtocol != DiscoveryProtocol::SIMPLE) return;  // set by a profile
  discovery.discoveryProtocol = DiscoveryProtocol::SUPER_CLIENT;
  discovery.m_DiscoveryServers = servers();
}

void listen_to_no_multicast(fdds::DomainParticipantQos& qos) {
  auto& builtin = qos.wire_protocol().builtin;
  builtin.metatrafficMulticastLocatorList.clear();
  // Without a unicast locator, Fast DDS adds its default ones, multicast included.
  if (builtin.metatrafficUnicastLocatorList.empty()) builtin.metatrafficUnicastLocatorList.push_back(rtps::Locator_t());
}

/// Discovery as in rmw_fastrtps, except that named peers do not switch multicast off.
void apply_range(const DdsSettings& settings, fdds::DomainParticipantQos& qos) {
  auto& builtin = qos.wire_protocol().builtin;
  const bool is_local = settings.range == DiscoveryRange::kLocalhost || settings.range == DiscoveryRange::kLoopback;
  if (settings.range == DiscoveryRange::kOff) {
    builtin.discovery_config.discoveryProtocol = DiscoveryProtocol::NONE;
    return;
  }
  if (settings.range == DiscoveryRange::kSystemDefault) return;
  if (is_local) {
    listen_to_no_multicast(qos);
  } else if (!settings.peers.empty() && builtin.initialPeersList.empty()) {
    rtps::Locator_t multicast;
    rtps::IPLocator::setIPv4(multicast, "239.255.0.1");
    multicast.port = qos.wire_protocol().port.getMulticastPort(static_cast<std::uint32_t>(settings.domain));
    builtin.initialPeersList.push_back(multicast);
  }
  for (const auto& peer : settings.peers) builtin.initialPeersList.push_back(locator_of(peer));
  if (is_local) builtin.initialPeersList.push_back(locator_of("127.0.0.1"));
}

using Transports = decltype(fdds::TransportConfigQos::user_transports);

bool is_shared_memory(const Transports::value_type& transport) {
  return std::dynamic_pointer_cast<rtps::SharedMemTransportDescriptor>(transport) != nullptr;
}

bool is_udp(const Transports::value_type& transport) {
  return std::dynamic_pointer_cast<rtps::UDPv4TransportDescriptor>(transport) != nullptr;
}

Transports::value_type our_udp(const DdsSettings& settings) {
  auto udp = std::make_shared<rtps::UDPv4TransportDescriptor>();
  udp->sendBufferSize = kSocketBufferSize;
  udp->receiveBufferSize = kSocketBufferSize;
  if (settings.range == DiscoveryRange::kLoopback) udp->interfaceWhiteList.emplace_back("127.0.0.1");
  udp->maxInitialPeersRange = kParticipantsPerPeer;
  return udp;
}

/// Largest receive buffer of a socket; 0: unknown.
std::uint32_t max_socket_buffer() {
  std::uint32_t bytes = 0;
  std::ifstream("/proc/sys/net/core/rmem_max") >> bytes;
  return bytes;
}

std::shared_ptr<rtps::FlowControllerDescriptor> pace() {
  auto pace = std::make_shared<rtps::FlowControllerDescriptor>();
  pace->name = kPace;
  pace->max_bytes_per_period = kBytesPerPeriod;
  pace->period_ms = 1;
  return pace;
}

// Fast DDS's shared-memory transport maps whatever segment of a port exists in /dev/shm. Other builds (ROS 2's) use
// another memory layout, and Boost then aborts the process. Therefore it is never used, even if a profile names it.
// Fast DDS's builtin transports are this one and UDP.
void use_udp(fdds::DomainParticipantQos& qos, const DdsSettings& settings) {
  auto& transports = qos.transport().user_transports;
  std::erase_if(transports, is_shared_memory);
  if (transports.empty() || (qos.transport().use_builtin_transports && std::ranges::none_of(transports, is_udp)))
    transports.push_back(our_udp(settings));
  qos.transport().use_builtin_transports = false;
  for (auto& transport : transports) {
    if (is_udp(transport)) transport = mended_udp(transport);
  }
}

}  // namespace

std::mutex& factory_mutex() {
  static std::mutex mutex;
  return mutex;
}

void load_profiles(const DdsSettings& settings) {
  if (settings.domain < 0 || settings.domain > DdsSettings::kMaxDomain) {
    throw ConfigError(
        fmt::format("DDS domain {}: must be 0 to {}; correct ROS_DOMAIN_ID", settings.domain, DdsSettings::kMaxDomain));
  }
  // Reports missing keys once instead of per topic.
  fdds::DomainParticipantQos tried;
  apply_security(security_settings_from_environment(), tried);
  const std::lock_guard lock(factory_mutex());
  auto* factory = fdds::DomainParticipantFactory::get_instance();
  factory->load_profiles();
  if (settings.profiles.empty()) return;
  if (!std::ifstream(settings.profiles)) {
    throw ConfigError(
        fmt::format("{}: the DDS profile file cannot be read; correct or omit its path", settings.profiles));
  }
  if (factory->load_XML_profiles_file(settings.profiles) != kOk) {
    throw ConfigError(
        fmt::format("{}: is not a valid Fast DDS profile file (see the messages above); see config/dds for an example",
                    settings.profiles));
  }
  // Makes the factory reload its defaults from the profiles.
  factory->set_default_participant_qos(fdds::PARTICIPANT_QOS_DEFAULT);
}

bool has_discovery_server() {
  const std::lock_guard lock(factory_mutex());
  return !servers().empty();
}

std::string silent_server_warning() {
  return fmt::format(
      "no discovery server has answered at {} for {} s: other processes are not found. Start one there "
      "(fast-discovery-server -i 0), or correct or unset {}",
      environment_variable(kServersVariable), kServerPatience.count(), kServersVariable);
}

bool has_small_socket_buffers() { return max_socket_buffer() < kSocketBufferSize; }

bool has_shared_memory() { return access(kSharedMemoryFolder, R_OK | W_OK | X_OK) == 0; }

std::optional<std::string> profile_warning() {
  fdds::DomainParticipantQos qos;
  {
    const std::lock_guard lock(factory_mutex());
    fdds::DomainParticipantFactory::get_instance()->get_default_participant_qos(qos);
  }
  if (std::ranges::none_of(qos.transport().user_transports, is_shared_memory)) return std::nullopt;
  return "the DDS profile has the transport SHM, which is ignored: with another build of Fast DDS (ROS 2's) on this "
         "machine it aborts the process. Images are shared without it, see shared_images_mb; other messages use UDP. "
         "Remedy: use UDPv4 only.";
}

fdds::DomainParticipantQos participant_qos(const DdsSettings& settings, Hears hears) {
  fdds::DomainParticipantQos qos;
  fdds::DomainParticipantFactory::get_instance()->get_default_participant_qos(qos);
  use_udp(qos, settings);
  apply_range(settings, qos);
  if (kHasFlowControl) qos.flow_controllers().push_back(pace());
  qos.name(settings.name);

  // rmw also sends the terminating zero.
  constexpr std::string_view kEnclave("enclave=/;\0", 11);
  qos.user_data().setValue(std::vector<rtps::octet>(kEnclave.begin(), kEnclave.end()));

  const bool has_keys = apply_security(security_settings_from_environment(), qos);

  auto& discovery = qos.wire_protocol().builtin.discovery_config;
  const auto default_period =
      fdds::PARTICIPANT_QOS_DEFAULT.wire_protocol().builtin.discovery_config.leaseDuration_announcementperiod;
  if (discovery.leaseDuration_announcementperiod == default_period) {
    discovery.leaseDuration_announcementperiod = Duration(0, kAnnouncementPeriodNs);
  }
  if (hears == Hears::kAll && !servers().empty()) hear_of_all_topics(discovery);
  // With security, a GUID does not identify the process and may match another one by chance.
  if (has_keys) return qos;
  auto& flags = discovery.ignoreParticipantFlags;
  flags = static_cast<ParticipantFilteringFlags>(flags | ParticipantFilteringFlags::FILTER_SAME_PROCESS);
  return qos;
}

}  // namespace panvo::runtime::dds
