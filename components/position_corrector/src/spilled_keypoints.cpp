// SPDX-License-Identifier: Apache-2.0
#include "panvo/position_corrector/spilled_keypoints.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

namespace panvo::position_corrector {
namespace {

using landmarks::Keypoint;

/// A keypoint in the file, packed, in the byte order of this process.
struct Record {
  float bearing[3];
  float size_px;
  float point[3];
  float inverse_range_sigma;
  std::uint32_t has_point;
  std::uint8_t descriptor[128];
};
static_assert(sizeof(Record) == 9 * 4 + 128, "padding would be written uninitialised");

Record to_record(const Keypoint& keypoint) {
  Record record{};
  std::memcpy(record.bearing, keypoint.bearing.data(), sizeof record.bearing);
  record.size_px = keypoint.size_px;
  std::memcpy(record.point, keypoint.point_in_panorama.data(), sizeof record.point);
  record.inverse_range_sigma = keypoint.inverse_range_sigma;
  record.has_point = keypoint.has_point ? 1U : 0U;
  std::memcpy(record.descriptor, keypoint.descriptor.data(), sizeof record.descriptor);
  return record;
}

Keypoint from_record(const Record& record) {
  Keypoint keypoint;
  keypoint.bearing = Eigen::Map<const Eigen::Vector3f>(record.bearing);
  keypoint.size_px = record.size_px;
  keypoint.point_in_panorama = Eigen::Map<const Eigen::Vector3f>(record.point);
  keypoint.inverse_range_sigma = record.inverse_range_sigma;
  keypoint.has_point = record.has_point != 0;
  std::memcpy(keypoint.descriptor.data(), record.descriptor, sizeof record.descriptor);
  return keypoint;
}

/// Returns whether all bytes were written; else errno is set.
bool write_all(int file, const void* data, std::size_t size, std::uint64_t offset) {
  const auto* bytes = static_cast<const char*>(data);
  while (size > 0) {
    const auto written = ::pwrite(file, bytes, size, static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes += written;
    offset += static_cast<std::uint64_t>(written);
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

bool read_all(int file, void* data, std::size_t size, std::uint64_t offset) {
  auto* bytes = static_cast<char*>(data);
  while (size > 0) {
    const auto got = ::pread(file, bytes, size, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got == 0) errno = EIO;  // shorter than what was written
    if (got <= 0) return false;
    bytes += got;
    offset += static_cast<std::uint64_t>(got);
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

}  // namespace

SpilledKeypoints::SpilledKeypoints(const std::filesystem::path& folder) {
  if (folder.empty()) return;
  file_ = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (file_ < 0) give_up("cannot create a file in " + folder.string());
}

SpilledKeypoints::~SpilledKeypoints() {
  if (file_ >= 0) ::close(file_);
}

void SpilledKeypoints::give_up(const std::string& what) { problem_ = what + " (" + std::strerror(errno) + ")"; }

void SpilledKeypoints::put(std::uint32_t id, std::span<const Keypoint> keypoints) {
  places_.erase(id);
  in_memory_.erase(id);
  if (file_ >= 0 && problem_.empty()) {
    std::vector<Record> records;
    records.reserve(keypoints.size());
    for (const auto& keypoint : keypoints) records.push_back(to_record(keypoint));
    const std::size_t size = records.size() * sizeof(Record);
    if (write_all(file_, records.data(), size, end_)) {
      places_[id] = {end_, records.size()};
      end_ += size;
      return;
    }
    give_up("cannot write the keypoint file");
  }
  in_memory_[id].assign(keypoints.begin(), keypoints.end());
}

std::vector<Keypoint> SpilledKeypoints::keypoints(std::uint32_t id) const {
  if (const auto kept = in_memory_.find(id); kept != in_memory_.end()) return kept->second;
  const auto place = places_.find(id);
  if (place == places_.end()) return {};
  std::vector<Record> records(place->second.count);
  if (!read_all(file_, records.data(), records.size() * sizeof(Record), place->second.offset)) {
    throw std::system_error(errno, std::generic_category(), "cannot read back the keypoints of a landmark");
  }
  std::vector<Keypoint> keypoints;
  keypoints.reserve(records.size());
  for (const auto& record : records) keypoints.push_back(from_record(record));
  return keypoints;
}

}  // namespace panvo::position_corrector
