// SPDX-License-Identifier: Apache-2.0
#include "image_sharing.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <string_view>

#include "panvo/interfaces/message_type.hpp"
#include "participant_qos.hpp"
#include "sensor_msgs/msg/Image.h"

namespace panvo::runtime::dds {

namespace fdds = eprosima::fastdds::dds;

namespace {

constexpr std::uint32_t kRoomBesidePixels = 1024;  // for the frame's name, the encoding and the numbers

std::uint64_t fnv1a(std::string_view text) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char letter : text) hash = (hash ^ static_cast<unsigned char>(letter)) * 1099511628211ULL;
  return hash;
}

/// Different after every start of a kernel, the same in all its containers.
std::string boot_id() {
  std::string id;
  std::getline(std::ifstream("/proc/sys/kernel/random/boot_id"), id);
  return id;
}

template <class EndpointQos>
void share_in_neighbourhood(EndpointQos& qos) {
  qos.data_sharing().automatic();
  qos.data_sharing().add_domain_id(sharing_neighbourhood());
}

// A type of bounded size may be shared, and makes Fast DDS reserve no more than the bound for a message. With this policy it reserves what
// each message needs.
constexpr auto kAnySize = eprosima::fastrtps::rtps::DYNAMIC_REUSABLE_MEMORY_MODE;

}  // namespace

std::uint32_t shared_size(const DdsSettings& settings, const std::string& wire_type_name) {
  const bool is_wanted = settings.shared_image_bytes > 0 && has_shared_memory() &&
                         wire_type_name == interfaces::message_type<sensor_msgs::msg::Image>().dds_name;
  return is_wanted ? settings.shared_image_bytes + kRoomBesidePixels : 0;
}

std::uint64_t sharing_neighbourhood() {
  struct stat shared_memory {};
  stat(kSharedMemoryFolder, &shared_memory);
  return fnv1a(boot_id() + ' ' + std::to_string(shared_memory.st_dev) + ' ' + std::to_string(geteuid()));
}

void share(fdds::DataWriterQos& qos) { share_in_neighbourhood(qos); }

void share(fdds::DataReaderQos& qos) {
  share_in_neighbourhood(qos);
  qos.endpoint().history_memory_policy = kAnySize;
}

void send_any_size(fdds::DataWriterQos& qos) { qos.endpoint().history_memory_policy = kAnySize; }

}  // namespace panvo::runtime::dds
