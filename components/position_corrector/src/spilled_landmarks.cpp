// SPDX-License-Identifier: Apache-2.0
#include "panvo/position_corrector/spilled_landmarks.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <type_traits>

namespace panvo::position_corrector {
namespace {

using landmarks::AdaptiveFeature;
using landmarks::Keypoint;

/// A keypoint in the file, packed, in the byte order of this process.
struct KeypointRecord {
  float bearing[3];
  float size_px;
  float point[3];
  float inverse_range_sigma;
  std::uint32_t has_point;
  std::uint8_t descriptor[128];
};
static_assert(sizeof(KeypointRecord) == 9 * 4 + 128, "padding would be written uninitialised");

struct FeatureRecord {
  float value, scale, weight;
  std::uint32_t row;
};
static_assert(sizeof(FeatureRecord) == 16, "padding would be written uninitialised");

KeypointRecord to_record(const Keypoint& keypoint) {
  KeypointRecord record{};
  std::memcpy(record.bearing, keypoint.bearing.data(), sizeof record.bearing);
  record.size_px = keypoint.size_px;
  std::memcpy(record.point, keypoint.point_in_panorama.data(), sizeof record.point);
  record.inverse_range_sigma = keypoint.inverse_range_sigma;
  record.has_point = keypoint.has_point ? 1U : 0U;
  std::memcpy(record.descriptor, keypoint.descriptor.data(), sizeof record.descriptor);
  return record;
}

Keypoint from_record(const KeypointRecord& record) {
  Keypoint keypoint;
  keypoint.bearing = Eigen::Map<const Eigen::Vector3f>(record.bearing);
  keypoint.size_px = record.size_px;
  keypoint.point_in_panorama = Eigen::Map<const Eigen::Vector3f>(record.point);
  keypoint.inverse_range_sigma = record.inverse_range_sigma;
  keypoint.has_point = record.has_point != 0;
  std::memcpy(keypoint.descriptor.data(), record.descriptor, sizeof record.descriptor);
  return keypoint;
}

FeatureRecord to_record(const AdaptiveFeature& feature) {
  return {feature.value, feature.scale, feature.weight, feature.row};
}

AdaptiveFeature from_record(const FeatureRecord& record) {
  return {static_cast<std::uint16_t>(record.row), record.value, record.scale, record.weight};
}

template <class Record, class Values>
void append(const Values& values, std::vector<char>& bytes) {
  for (const auto& value : values) {
    const Record record = [&] {
      if constexpr (std::is_same_v<Record, float>) {
        return value;
      } else {
        return to_record(value);
      }
    }();
    const auto* begin = reinterpret_cast<const char*>(&record);
    bytes.insert(bytes.end(), begin, begin + sizeof record);
  }
}

template <class Value, class Record>
std::vector<Value> values_of(const std::vector<Record>& records) {
  std::vector<Value> values;
  values.reserve(records.size());
  for (const auto& record : records) values.push_back(from_record(record));
  return values;
}

/// -1, with errno set, if the file cannot be created.
int open_unnamed(const std::filesystem::path& folder) {
  std::string name = folder / "panvo-XXXXXX";  // for a moment: not all file systems have O_TMPFILE
  const int file = ::mkostemp(name.data(), O_CLOEXEC);
  if (file >= 0) ::unlink(name.c_str());
  return file;
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

SpilledLandmarks::SpilledLandmarks(const std::filesystem::path& folder) {
  if (folder.empty()) return;
  file_ = open_unnamed(folder);
  if (file_ < 0) give_up("cannot create a file in " + folder.string());
}

SpilledLandmarks::~SpilledLandmarks() {
  if (file_ >= 0) ::close(file_);
}

void SpilledLandmarks::give_up(const std::string& what) { problem_ = what + " (" + std::strerror(errno) + ")"; }

void SpilledLandmarks::put(std::uint32_t id, std::span<const Keypoint> keypoints,
                           const landmarks::PanoramaDescription& description) {
  places_.erase(id);
  in_memory_.erase(id);
  if (file_ >= 0 && problem_.empty()) {
    std::vector<char> bytes;
    append<KeypointRecord>(keypoints, bytes);
    append<float>(description.histogram, bytes);
    append<FeatureRecord>(description.large, bytes);
    append<FeatureRecord>(description.small, bytes);
    if (write_all(file_, bytes.data(), bytes.size(), end_)) {
      const auto count = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
      places_[id] = {end_, count(keypoints), count(description.histogram), count(description.large),
                     count(description.small)};
      end_ += bytes.size();
      return;
    }
    give_up("cannot write the file of landmarks");
  }
  in_memory_[id] = {{keypoints.begin(), keypoints.end()}, description};
}

template <class Record>
std::vector<Record> SpilledLandmarks::read(std::uint64_t offset, std::size_t count) const {
  std::vector<Record> records(count);
  if (!read_all(file_, records.data(), count * sizeof(Record), offset)) {
    throw std::system_error(errno, std::generic_category(), "cannot read back a landmark");
  }
  return records;
}

std::vector<Keypoint> SpilledLandmarks::keypoints(std::uint32_t id) const {
  if (const auto kept = in_memory_.find(id); kept != in_memory_.end()) return kept->second.keypoints;
  const auto place = places_.find(id);
  if (place == places_.end()) return {};
  return values_of<Keypoint>(read<KeypointRecord>(place->second.offset, place->second.keypoints));
}

landmarks::PanoramaDescription SpilledLandmarks::description(std::uint32_t id) const {
  if (const auto kept = in_memory_.find(id); kept != in_memory_.end()) return kept->second.description;
  const auto found = places_.find(id);
  if (found == places_.end()) return {};
  const Place& place = found->second;
  const std::uint64_t histogram = place.offset + place.keypoints * sizeof(KeypointRecord);
  const std::uint64_t features = histogram + place.bins * sizeof(float);
  const auto records = read<FeatureRecord>(features, std::size_t{place.large} + place.small);
  landmarks::PanoramaDescription description{
      read<float>(histogram, place.bins), values_of<AdaptiveFeature>(records), {}};
  description.small.assign(description.large.begin() + place.large, description.large.end());
  description.large.resize(place.large);
  return description;
}

}  // namespace panvo::position_corrector
