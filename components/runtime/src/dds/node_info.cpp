// SPDX-License-Identifier: Apache-2.0
#include "node_info.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

#include "fast_dds.hpp"

namespace panvo::runtime::dds {
namespace {

constexpr std::size_t kEncapsulationBytes = 4;
constexpr std::size_t kGuidSize = 16;
constexpr std::size_t kPrefixSize = 12;

std::array<std::uint8_t, kGuidSize> bytes_of(const NodeInfo::Guid& guid) {
  std::array<std::uint8_t, kGuidSize> bytes{};
  std::copy_n(guid.guidPrefix.value, kPrefixSize, bytes.begin());
  std::copy_n(guid.entityId.value, kGuidSize - kPrefixSize, bytes.begin() + kPrefixSize);
  return bytes;
}

class CdrWriter {
 public:
  explicit CdrWriter(std::size_t gid_size) : gid_size_(gid_size) {}

  void gid(const NodeInfo::Guid& guid) {
    const auto bytes = bytes_of(guid);
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    bytes_.resize(bytes_.size() + gid_size_ - kGuidSize);
  }
  void gids(const std::vector<NodeInfo::Guid>& guids) {
    count(guids.size());
    for (const auto& guid : guids) gid(guid);
  }
  void text(const std::string& text) {
    count(text.size() + 1);
    bytes_.insert(bytes_.end(), text.begin(), text.end());
    bytes_.push_back(0);
  }
  void count(std::size_t value) {
    while (bytes_.size() % 4 != 0) bytes_.push_back(0);  // the encapsulation has the size of the alignment
    for (int shift = 0; shift < 32; shift += 8) bytes_.push_back(static_cast<std::uint8_t>(value >> shift));
  }

  interfaces::Bytes take() { return std::move(bytes_); }

 private:
  const std::size_t gid_size_;
  interfaces::Bytes bytes_{0, 1, 0, 0};
};

/// Checks each length against the remaining bytes. good() returns the result.
class InfoReader {
 public:
  InfoReader(std::span<const std::uint8_t> bytes, std::size_t gid_size)
      : bytes_(bytes), gid_size_(gid_size), is_big_endian_(bytes[1] == 0) {}

  NodeInfo::Guid gid() {
    NodeInfo::Guid guid;
    const auto bytes = take(gid_size_);
    if (bytes.empty()) return guid;
    std::copy_n(bytes.begin(), kPrefixSize, guid.guidPrefix.value);
    std::copy_n(bytes.begin() + kPrefixSize, kGuidSize - kPrefixSize, guid.entityId.value);
    return guid;
  }
  std::vector<NodeInfo::Guid> gids() {
    std::vector<NodeInfo::Guid> guids;
    for (std::uint32_t left = count(); left > 0 && good_; --left) guids.push_back(gid());
    return guids;
  }
  std::string text() {
    constexpr std::size_t kMaxLength = 256 + 1;
    const auto length = count();
    if (length > kMaxLength) good_ = false;
    const auto bytes = take(length);
    std::string text(bytes.begin(), bytes.end());
    if (!text.empty() && text.back() == '\0') text.pop_back();
    return text;
  }
  std::uint32_t count() {
    position_ += (4 - position_ % 4) % 4;
    const auto bytes = take(4);
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i)
      value |= static_cast<std::uint32_t>(bytes[is_big_endian_ ? 3 - i : i]) << (8 * i);
    return value;
  }

  /// Fast DDS pads messages to a multiple of four bytes.
  bool is_at_end() const { return good_ && bytes_.size() - position_ < 4; }
  bool good() const { return good_; }

 private:
  std::span<const std::uint8_t> take(std::size_t size) {
    if (!good_ || position_ > bytes_.size() || size > bytes_.size() - position_) {
      good_ = false;
      return {};
    }
    position_ += size;
    return bytes_.subspan(position_ - size, size);
  }

  std::span<const std::uint8_t> bytes_;
  const std::size_t gid_size_;
  const bool is_big_endian_;
  std::size_t position_ = kEncapsulationBytes;
  bool good_ = true;
};

std::optional<NodeInfo> decode_with(std::span<const std::uint8_t> bytes, std::size_t gid_size) {
  InfoReader reader(bytes, gid_size);
  NodeInfo info;
  info.participant = reader.gid();
  for (std::uint32_t left = reader.count(); left > 0 && reader.good(); --left) {
    NodeInfo::Node node;
    node.name_space = reader.text();
    node.name = reader.text();
    node.readers = reader.gids();
    node.writers = reader.gids();
    info.nodes.push_back(std::move(node));
  }
  return reader.is_at_end() ? std::optional(std::move(info)) : std::nullopt;
}

}  // namespace

bool is_until_humble(const std::string& ros_distro) {
  constexpr std::array<std::string_view, 6> kUntilHumble{"humble",   "galactic", "foxy",
                                                         "eloquent", "dashing",  "crystal"};
  return std::ranges::find(kUntilHumble, ros_distro) != kUntilHumble.end();
}

interfaces::Bytes encode(const NodeInfo& info, std::size_t gid_size) {
  CdrWriter writer(gid_size);
  writer.gid(info.participant);
  writer.count(info.nodes.size());
  for (const auto& node : info.nodes) {
    writer.text(node.name_space);
    writer.text(node.name);
    writer.gids(node.readers);
    writer.gids(node.writers);
  }
  return writer.take();
}

std::optional<NodeInfo> decode_node_info(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kEncapsulationBytes || bytes[0] != 0 || bytes[1] > 1) return std::nullopt;
  auto info = decode_with(bytes, kGidSize);
  return info ? info : decode_with(bytes, kHumbleGidSize);
}

std::string hexadecimal(const rtps::GUID_t& guid) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const auto byte : bytes_of(guid)) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

}  // namespace panvo::runtime::dds
