// SPDX-License-Identifier: Apache-2.0
#include "host_checks.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <spdlog/fmt/fmt.h>
#include <sys/statvfs.h>
#include <sys/timex.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <thread>

#include "dds/library_version.hpp"
#include "panvo/runtime/version.hpp"

namespace panvo::runtime::doctor {
namespace {

namespace fs = std::filesystem;

// What panvo asks for; a panorama of 1.75 MB arrives as a burst of fragments.
constexpr std::uint64_t kSocketBuffer = 4 * 1024 * 1024;
// Room for the images that a few topics hold; Docker's default of 64 MB is below it.
constexpr double kSharedMemory_mb = 100.0;

std::optional<std::uint64_t> number_in(const fs::path& file) {
  std::uint64_t value = 0;
  if (std::ifstream(file) >> value) return value;
  return std::nullopt;
}

/// A value of /proc/meminfo, MB.
std::optional<double> meminfo_mb(const fs::path& root, const std::string& key) {
  std::ifstream file(root / "proc/meminfo");
  std::string name, unit;
  for (double kb = 0; file >> name >> kb;) {
    std::getline(file, unit);
    if (name == key + ":") return kb / 1024.0;
  }
  return std::nullopt;
}

}  // namespace

std::vector<NetworkInterface> network_interfaces() {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return {};
  const std::unique_ptr<ifaddrs, void (*)(ifaddrs*)> all(first, freeifaddrs);
  std::vector<NetworkInterface> interfaces;
  for (const auto* each = first; each; each = each->ifa_next) {
    if (!each->ifa_addr || each->ifa_addr->sa_family != AF_INET || (each->ifa_flags & IFF_UP) == 0) continue;
    char address[INET_ADDRSTRLEN] = "";
    inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(each->ifa_addr)->sin_addr, address, sizeof(address));
    interfaces.push_back(
        {each->ifa_name, address, (each->ifa_flags & IFF_LOOPBACK) != 0, (each->ifa_flags & IFF_MULTICAST) != 0});
  }
  return interfaces;
}

Environment process_environment() {
  return [](const char* name) -> std::optional<std::string> {
    const char* value = std::getenv(name);
    return value && *value ? std::optional<std::string>(value) : std::nullopt;
  };
}

std::optional<bool> is_clock_synchronised() {
  timex state{};
  if (adjtimex(&state) < 0) return std::nullopt;
  return (state.status & STA_UNSYNC) == 0;
}

Finding check_versions() {
  return {Severity::kOk, "versions",
          fmt::format("panvo {}, Fast DDS {}", PANVO_RUNTIME_VERSION, dds::library_version())};
}

Finding check_machine(const fs::path& root) {
  utsname system{};
  uname(&system);
  std::string text = fmt::format("{} {}, {}, {} cores", system.sysname, system.release, system.machine,
                                 std::thread::hardware_concurrency());
  const auto available_mb = meminfo_mb(root, "MemAvailable"), total_mb = meminfo_mb(root, "MemTotal");
  if (available_mb && total_mb)
    text += fmt::format(", {:.1f} of {:.1f} GB memory available", *available_mb / 1024.0, *total_mb / 1024.0);
  return {Severity::kOk, "machine", text};
}

Finding check_shared_memory(const fs::path& root) {
  const auto folder = root / "dev/shm";
  struct statvfs state {};
  if (access(folder.c_str(), R_OK | W_OK | X_OK) != 0 || statvfs(folder.c_str(), &state) != 0) {
    return {Severity::kWarning, "shared memory",
            "/dev/shm is missing or not writable: images go between processes by UDP, which takes longer",
            "mount a tmpfs at /dev/shm with mode 1777"};
  }
  const double free_mb = static_cast<double>(state.f_bavail) * static_cast<double>(state.f_frsize) * 1e-6;
  const std::string text = fmt::format("/dev/shm has {:.0f} MB free", free_mb);
  if (free_mb >= kSharedMemory_mb) return {Severity::kOk, "shared memory", text};
  return {Severity::kWarning, "shared memory",
          fmt::format("{}; with less than {:.0f} MB, images may go between processes by UDP, which takes longer", text,
                      kSharedMemory_mb),
          "delete what is not needed there, or enlarge it (Docker: --shm-size=256m)"};
}

Finding check_socket_buffers(const fs::path& root) {
  const auto receive = number_in(root / "proc/sys/net/core/rmem_max");
  const auto send = number_in(root / "proc/sys/net/core/wmem_max");
  if (!receive || !send) return {Severity::kOk, "socket buffers", "the kernel does not tell their limit"};
  const std::string text = fmt::format("up to {} kB for receiving, {} kB for sending", *receive / 1024, *send / 1024);
  if (std::min(*receive, *send) >= kSocketBuffer) return {Severity::kOk, "socket buffers", text};
  return {Severity::kWarning, "socket buffers",
          text + "; images over a network, and to ROS 2 nodes on this machine, may be lost",
          fmt::format("sysctl -w net.core.rmem_max={0} net.core.wmem_max={0}, and the same lines in /etc/sysctl.d",
                      kSocketBuffer)};
}

Finding check_network(const std::vector<NetworkInterface>& interfaces) {
  std::vector<std::string> reachable, without_multicast;
  bool has_loopback = false;
  for (const auto& each : interfaces) {
    has_loopback |= each.is_loopback;
    if (each.is_loopback) continue;
    (each.has_multicast ? reachable : without_multicast).push_back(each.name + " " + each.address);
  }
  if (!has_loopback) {
    return {Severity::kProblem, "network", "the loopback interface is down: processes of this machine do not meet",
            "ip link set lo up"};
  }
  if (!reachable.empty())
    return {Severity::kOk, "network", "multicast on " + fmt::format("{}", fmt::join(reachable, ", "))};
  if (!without_multicast.empty()) {
    return {
        Severity::kWarning, "network",
        "no multicast on " + fmt::format("{}", fmt::join(without_multicast, ", ")) + ": other machines are not found",
        "ip link set NAME multicast on, or name the other machines in ROS_STATIC_PEERS"};
  }
  return {Severity::kWarning, "network", "only the loopback interface is up: other machines cannot be reached",
          "connect a network, if other machines take part"};
}

Finding check_clock(std::optional<bool> is_synchronised) {
  if (!is_synchronised) return {Severity::kOk, "clock", "the system does not tell whether it is synchronised"};
  if (*is_synchronised) return {Severity::kOk, "clock", "synchronised"};
  return {Severity::kWarning, "clock", "not synchronised: stamps of several machines do not agree",
          "enable systemd-timesyncd or chrony, if several machines take part"};
}

Findings check_environment(const Environment& environment) {
  Findings findings;
  for (const char* name :
       {"ROS_DOMAIN_ID", "ROS_DISTRO", "ROS_LOCALHOST_ONLY", "ROS_AUTOMATIC_DISCOVERY_RANGE", "ROS_STATIC_PEERS",
        "ROS_DISCOVERY_SERVER", "FASTRTPS_DEFAULT_PROFILES_FILE", "ROS_SECURITY_KEYSTORE"}) {
    if (const auto value = environment(name)) findings.push_back({Severity::kOk, name, *value});
  }
  if (environment("ROS_LOCALHOST_ONLY").value_or("0") != "0" && environment("ROS_AUTOMATIC_DISCOVERY_RANGE")) {
    findings.push_back({Severity::kWarning, "ROS_LOCALHOST_ONLY", "prevails over ROS_AUTOMATIC_DISCOVERY_RANGE",
                        "unset one of the two"});
  }
  if (const auto file = environment("FASTRTPS_DEFAULT_PROFILES_FILE"); file && access(file->c_str(), R_OK) != 0) {
    findings.push_back({Severity::kProblem, "FASTRTPS_DEFAULT_PROFILES_FILE", *file + " cannot be read",
                        "correct or unset the variable"});
  }
  return findings;
}

Findings check_cameras(const fs::path& root) {
  Findings findings;
  int usable = 0;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(root / "dev", error)) {
    const auto name = entry.path().filename().string();
    if (!name.starts_with("video")) continue;
    if (access(entry.path().c_str(), R_OK | W_OK) == 0) {
      ++usable;
    } else {
      findings.push_back({Severity::kProblem, "cameras", "/dev/" + name + " may not be opened by this user",
                          "usermod -aG video USER, then log in again"});
    }
  }
  std::ranges::sort(findings, {}, &Finding::text);
  if (findings.empty()) findings.push_back({Severity::kOk, "cameras", fmt::format("{} video devices", usable)});
  return findings;
}

}  // namespace panvo::runtime::doctor
