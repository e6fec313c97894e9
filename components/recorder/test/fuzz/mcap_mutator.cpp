// SPDX-License-Identifier: Apache-2.0
#include "mcap_mutator.hpp"

#include <cstring>
#include <optional>
#include <random>
#include <vector>

namespace panvo::recorder::fuzz {
namespace {

constexpr std::size_t kMagicBytes = 8, kHeadBytes = 9;
constexpr char kChunk = 0x06;

// Offsets in a chunk's content: three eight-byte fields, checksum, name of the compression, size of the records.
constexpr std::size_t kUncompressedSize = 16, kChecksum = 24, kCompression = 28, kRecordsSize = 32, kRecords = 40;
constexpr std::size_t kChecksumFromEnd = kMagicBytes + 4;  // of the summary: the footer's last field

struct Place {
  std::size_t head = 0, content = 0, size = 0;
  std::optional<std::size_t> chunk;  // offset of the content of the enclosing chunk
};

std::uint64_t number(const std::string& file, std::size_t at, std::size_t bytes = 8) {
  std::uint64_t value = 0;
  std::memcpy(&value, file.data() + at, bytes);
  return value;
}

void add(std::string& file, std::size_t at, std::uint64_t change) {
  const std::uint64_t value = number(file, at) + change;
  std::memcpy(file.data() + at, &value, sizeof value);
}

bool is_uncompressed(const std::string& file, const Place& place) {
  return file[place.head] == kChunk && place.size > kRecords && number(file, place.content + kCompression, 4) == 0;
}

void find_records(const std::string& file, std::size_t at, std::size_t end, std::optional<std::size_t> chunk,
                  std::vector<Place>& places) {
  while (at + kHeadBytes <= end && number(file, at + 1) <= end - at - kHeadBytes) {
    const Place place{at, at + kHeadBytes, static_cast<std::size_t>(number(file, at + 1)), chunk};
    places.push_back(place);
    at = place.content + place.size;
    if (!chunk && is_uncompressed(file, place)) {
      find_records(file, place.content + kRecords, at, place.content, places);
    }
  }
}

}  // namespace

std::string mutate_record(std::string file, std::uint64_t seed, const Mutate& mutate) {
  std::minstd_rand random(static_cast<std::minstd_rand::result_type>(seed));
  std::vector<Place> places;
  if (file.size() > kMagicBytes) {
    find_records(file, kMagicBytes, file.size(), std::nullopt, places);
  }
  if (places.empty()) {
    return mutate(file, file.size() + 64);
  }
  const auto place = places[random() % places.size()];
  const bool keeps_offsets = random() % 4 != 0;
  auto content = mutate(file.substr(place.content, place.size), place.size + (keeps_offsets ? 0 : 64));
  if (keeps_offsets) {
    content.resize(place.size, '\0');
  }
  const std::uint64_t longer = content.size() - place.size;  // may wrap around, which is intended
  file.replace(place.content, place.size, content);
  add(file, place.head + 1, longer);
  if (place.chunk) {
    add(file, *place.chunk - 8, longer);  // the length in the chunk's record header
    add(file, *place.chunk + kUncompressedSize, longer);
    add(file, *place.chunk + kRecordsSize, longer);
    std::memset(file.data() + *place.chunk + kChecksum, 0, 4);
  }
  if (random() % 2 == 0 && file.size() > kChecksumFromEnd) {
    std::memset(file.data() + file.size() - kChecksumFromEnd, 0, 4);
  }
  return file;
}

}  // namespace panvo::recorder::fuzz
