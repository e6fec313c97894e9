// SPDX-License-Identifier: Apache-2.0
#include "image_sharing.hpp"

#include <dlfcn.h>
#include <spdlog/fmt/fmt.h>
#include <sys/stat.h>
#include <unistd.h>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>

#include <algorithm>
#include <fstream>
#include <string_view>

#include "fast_dds.hpp"
#include "fnv1a.hpp"
#include "panvo/interfaces/message_type.hpp"
#include "participant_qos.hpp"
#include "security_qos.hpp"
#include "sensor_msgs/msg/Image.h"
#include "shared_memory.hpp"

namespace panvo::runtime::dds {

namespace {

constexpr std::uint32_t kRoomBesidePixels = 1024;  // for frame name, encoding and numbers

/// Changes at each boot of the kernel; the same in all its containers.
std::string boot_id() {
  std::string id;
  std::getline(std::ifstream("/proc/sys/kernel/random/boot_id"), id);
  return id;
}

/// Identifies the Fast DDS build by size and time of its library file.
std::string build_of_fast_dds() {
  Dl_info library{};
  struct stat file {};
  if (dladdr(reinterpret_cast<const void*>(&fdds::DomainParticipantFactory::get_instance), &library) == 0) return "";
  if (stat(library.dli_fname, &file) != 0) return "";
  return std::to_string(file.st_size) + ' ' + std::to_string(file.st_mtime);
}

template <class EndpointQos>
void share_in_neighbourhood(EndpointQos& qos) {
  qos.data_sharing().automatic();
  qos.data_sharing().add_domain_id(sharing_neighbourhood());
}

// Data sharing needs a type of bounded size, for which Fast DDS reserves at most the bound per message. With this
// policy it allocates what each message needs.
constexpr auto kAnySize = rtps::DYNAMIC_REUSABLE_MEMORY_MODE;

}  // namespace

std::uint32_t max_shared(const DdsSettings& settings, const std::string& wire_type_name) {
  const bool is_wanted = settings.shared_image_bytes > 0 &&
                         wire_type_name == interfaces::message_type<sensor_msgs::msg::Image>().dds_name &&
                         has_shared_memory() && !security_settings_from_environment().is_enabled;
  return is_wanted ? settings.shared_image_bytes + kRoomBesidePixels : 0;
}

std::optional<std::string> sharing_warning(const DdsSettings& settings) {
  const bool is_wanted = settings.shared_image_bytes > 0 && !security_settings_from_environment().is_enabled;
  if (!is_wanted || SharingTurn().has_room(kRoomForReader)) return std::nullopt;
  return fmt::format(
      "{} is full, missing or not writable: images are exchanged with other processes on this machine by UDP, which "
      "takes several times as long. Remedy: enlarge it (Docker: --shm-size=256m), or set shared_images_mb: 0 in the "
      "node_container of the system file.",
      kSharedMemoryFolder);
}

std::uint64_t sharing_neighbourhood() {
  struct stat shared_memory {};
  stat(kSharedMemoryFolder, &shared_memory);
  return fnv1a(boot_id() + ' ' + std::to_string(shared_memory.st_dev) + ' ' + std::to_string(shared_memory.st_ino) +
               ' ' + std::to_string(geteuid()) + ' ' + build_of_fast_dds());
}

bool is_in_neighbourhood(const fdds::DataSharingQosPolicy& sharing) {
  const auto& ids = sharing.domain_ids();
  return sharing.kind() != fdds::DataSharingKind::OFF && std::ranges::find(ids, sharing_neighbourhood()) != ids.end();
}

void share(fdds::DataWriterQos& qos) { share_in_neighbourhood(qos); }

void share(fdds::DataReaderQos& qos) {
  share_in_neighbourhood(qos);
  qos.endpoint().history_memory_policy = kAnySize;
}

std::uint64_t room_for_writer(std::size_t depth, std::uint32_t max_size) {
  constexpr std::uint64_t kHeadOfMessage = 512, kHeadOfSegment = 65536;
  return (depth + 2) * (std::uint64_t{max_size} + kHeadOfMessage) + kHeadOfSegment;  // one being written, one spare
}

}  // namespace panvo::runtime::dds
