// SPDX-License-Identifier: Apache-2.0
#include "participant_qos.hpp"

#include <fastdds/rtps/attributes/ServerAttributes.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>
#include <spdlog/fmt/fmt.h>
#include <unistd.h>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>

#include <fstream>
#include <string_view>
#include <vector>

#include "panvo/runtime/errors.hpp"
#include "security_qos.hpp"

namespace panvo::runtime::dds {

namespace fdds = eprosima::fastdds::dds;
using eprosima::fastrtps::types::ReturnCode_t;
namespace rtps = eprosima::fastdds::rtps;

namespace {

// 32 MB hold 18 panoramas of 1.75 MB on their way; with Fast DDS's own 512 KB they come late, or not at all.
// All of it is resident from the start, so who only reads, and sends no more than acknowledgements, has a
// small one. Messages go in fragments of what the smallest transport takes, UDP's 64 KB; larger ones in
// shared memory were measured to be no faster and take 60 MB more.
constexpr std::uint32_t kWriterSegmentSize = 32 * 1024 * 1024;
constexpr std::uint32_t kReaderSegmentSize = 1024 * 1024;
constexpr std::uint32_t kSocketBufferSize = 4 * 1024 * 1024;

// A participant that comes answers the first announcement it hears of another only once; if that answer is
// lost, it is found at the next periodic announcement. The default is 3 s, and is reached in one start of
// ten.
constexpr std::int32_t kAnnouncementPeriodNs = 500'000'000;

constexpr int kMaxDomain = 232;  // the ports of a higher one would be past 65535

bool names_transports(const fdds::DomainParticipantQos& qos) {
  return !(qos.transport() == fdds::PARTICIPANT_QOS_DEFAULT.transport());
}

// Fast DDS makes a client of a participant itself where ROS_DISCOVERY_SERVER is set. A client is told of what
// it matches only; one of ours has to hear of all, for recorders and for those who look at the graph.
void hear_of_all_topics(eprosima::fastrtps::rtps::DiscoverySettings& discovery) {
  eprosima::fastdds::rtps::RemoteServerList_t servers;
  if (discovery.discoveryProtocol != eprosima::fastrtps::rtps::DiscoveryProtocol_t::SIMPLE) return;  // a profile says
  if (!rtps::load_environment_server_info(servers) || servers.empty()) return;
  discovery.discoveryProtocol = eprosima::fastrtps::rtps::DiscoveryProtocol_t::SUPER_CLIENT;
  discovery.m_DiscoveryServers = servers;
}

void use_our_transports(fdds::DomainParticipantQos& qos, const DdsSettings& settings, Role role) {
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.clear();
  if (has_shared_memory()) {
    const auto shared_memory = std::make_shared<rtps::SharedMemTransportDescriptor>();
    shared_memory->segment_size(role == Role::kWriters ? kWriterSegmentSize : kReaderSegmentSize);
    qos.transport().user_transports.push_back(shared_memory);
  }
  const auto udp = std::make_shared<rtps::UDPv4TransportDescriptor>();
  udp->sendBufferSize = kSocketBufferSize;
  udp->receiveBufferSize = kSocketBufferSize;
  if (settings.localhost_only) udp->interfaceWhiteList.emplace_back("127.0.0.1");
  qos.transport().user_transports.push_back(udp);
}

}  // namespace

void load_profiles(const DdsSettings& settings) {
  if (settings.domain < 0 || settings.domain > kMaxDomain) {
    throw ConfigError(
        fmt::format("DDS domain {}: must be 0 to {}; correct ROS_DOMAIN_ID", settings.domain, kMaxDomain));
  }
  // Keys that are missing are told once, and not for each topic.
  fdds::DomainParticipantQos tried;
  apply_security(security_settings_from_environment(), tried);
  auto* factory = fdds::DomainParticipantFactory::get_instance();
  factory->load_profiles();
  if (settings.profiles.empty()) return;
  if (!std::ifstream(settings.profiles)) {
    throw ConfigError(
        fmt::format("{}: the DDS profile file cannot be read; correct its path or leave it out", settings.profiles));
  }
  if (factory->load_XML_profiles_file(settings.profiles) != ReturnCode_t::RETCODE_OK) {
    throw ConfigError(
        fmt::format("{}: is no valid Fast DDS profile file (the lines above say where); see config/dds for an example",
                    settings.profiles));
  }
  // This makes the factory take its defaults from the profiles again.
  factory->set_default_participant_qos(fdds::PARTICIPANT_QOS_DEFAULT);
}

bool has_shared_memory() { return access(kSharedMemoryFolder, R_OK | W_OK | X_OK) == 0; }

std::optional<std::string> shared_memory_warning() {
  if (has_shared_memory()) return std::nullopt;
  return fmt::format(
      "{} is not there or cannot be written, so processes of this machine exchange images by UDP, which takes several "
      "times as long. Remedy: mount it (for Docker: --ipc=host, or --shm-size=256m).",
      kSharedMemoryFolder);
}

fdds::DomainParticipantQos participant_qos(const DdsSettings& settings, Role role) {
  fdds::DomainParticipantQos qos;
  fdds::DomainParticipantFactory::get_instance()->get_default_participant_qos(qos);
  if (!names_transports(qos)) use_our_transports(qos, settings, role);
  qos.name(settings.name + (role == Role::kWriters ? "_writers" : "_readers"));

  // rmw puts the terminating zero on the wire too.
  constexpr std::string_view kEnclave("enclave=/;\0", 11);
  qos.user_data().setValue(std::vector<eprosima::fastrtps::rtps::octet>(kEnclave.begin(), kEnclave.end()));

  apply_security(security_settings_from_environment(), qos);

  auto& discovery = qos.wire_protocol().builtin.discovery_config;
  const auto default_period =
      fdds::PARTICIPANT_QOS_DEFAULT.wire_protocol().builtin.discovery_config.leaseDuration_announcementperiod;
  if (discovery.leaseDuration_announcementperiod == default_period) {
    discovery.leaseDuration_announcementperiod = eprosima::fastrtps::Duration_t(0, kAnnouncementPeriodNs);
  }
  if (role == Role::kReaders) hear_of_all_topics(discovery);
  auto& flags = discovery.ignoreParticipantFlags;
  flags = static_cast<eprosima::fastrtps::rtps::ParticipantFilteringFlags_t>(
      flags | eprosima::fastrtps::rtps::ParticipantFilteringFlags_t::FILTER_SAME_PROCESS);
  return qos;
}

}  // namespace panvo::runtime::dds
