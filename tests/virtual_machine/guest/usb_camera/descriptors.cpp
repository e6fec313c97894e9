// SPDX-License-Identifier: Apache-2.0
#include "descriptors.hpp"

namespace panvo::test {
namespace {

constexpr std::uint8_t kInterfaceDescriptor = 4, kEndpointDescriptor = 5, kAssociationDescriptor = 11,
                       kClassInterface = 0x24;
constexpr std::uint8_t kVideo = 0x0e, kVideoControl = 1, kVideoStreaming = 2;
constexpr std::uint32_t kClock_hz = 48'000'000;

void append(Bytes& bytes, const Bytes& more) {
  for (const std::uint8_t byte : more) bytes.push_back(byte);
}

/// Prepends the length.
Bytes sized(const Bytes& content) {
  Bytes bytes;
  bytes.push_back(static_cast<std::uint8_t>(content.size() + 1));
  append(bytes, content);
  return bytes;
}

Bytes interface(std::uint8_t number, std::uint8_t endpoints, std::uint8_t subclass) {
  return sized({kInterfaceDescriptor, number, 0, endpoints, kVideo, subclass, 0, 0});
}

Bytes frame_sizes(const CameraModel& model, std::uint8_t subtype, const std::vector<int>& rates_hz) {
  const auto size = static_cast<std::uint32_t>(model.width * model.height * 2);
  Bytes content{kClassInterface, subtype, 1, 0};
  put(content, static_cast<std::uint64_t>(model.width), 2);
  put(content, static_cast<std::uint64_t>(model.height), 2);
  put(content, size * 8U * kSlowest_hz, 4);                                // lowest and
  put(content, size * 8U * static_cast<std::uint32_t>(model.rate_hz), 4);  // highest bit rate
  put(content, size, 4);
  put(content, interval_of(rates_hz.front()), 4);
  content.push_back(static_cast<std::uint8_t>(rates_hz.size()));
  for (const int rate_hz : rates_hz) put(content, interval_of(rate_hz), 4);
  return sized(content);
}

Bytes colours() { return sized({kClassInterface, 13, 1, 1, 4}); }  // of sRGB, by BT.601

Bytes formats(const CameraModel& model) {
  constexpr std::uint8_t kMjpg = 6, kMjpgFrame = 7, kUncompressed = 4, kUncompressedFrame = 5;
  Bytes bytes;
  append(bytes, sized({kClassInterface, kMjpg, kMjpgFormat, 1, 1, 1, 0, 0, 0, 0}));
  append(bytes, frame_sizes(model, kMjpgFrame, {model.rate_hz, model.rate_hz / 2, kSlowest_hz}));
  append(bytes, colours());
  // The format GUID consists of the four characters and this suffix.
  append(bytes, sized({kClassInterface,
                       kUncompressed,
                       kYuy2Format,
                       1,
                       'Y',
                       'U',
                       'Y',
                       '2',
                       0,
                       0,
                       0x10,
                       0,
                       0x80,
                       0,
                       0,
                       0xaa,
                       0,
                       0x38,
                       0x9b,
                       0x71,
                       16,
                       1,
                       0,
                       0,
                       0,
                       0}));
  append(bytes, frame_sizes(model, kUncompressedFrame, {kSlowest_hz}));
  append(bytes, colours());
  return bytes;
}

Bytes control_entities() {
  Bytes entities;
  append(entities,
         sized({kClassInterface, 2, kCameraTerminal, 1, 2, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0x0a, 0, 0}));  // exposure
  append(entities,
         sized({kClassInterface, 5, kProcessingUnit, kCameraTerminal, 0, 0, 2, 0x01, 0x02, 0, 0}));  // brightness, gain
  append(entities, sized({kClassInterface, 3, 3, 1, 1, 0, kProcessingUnit, 0}));                     // the host
  constexpr std::size_t kHeader = 13;
  Bytes header{kClassInterface, 1, 0x10, 1};
  put(header, kHeader + entities.size(), 2);
  put(header, kClock_hz, 4);
  append(header, {1, 1});
  Bytes bytes = sized(header);
  append(bytes, entities);
  return bytes;
}

Bytes streaming_formats(const CameraModel& model) {
  const Bytes all = formats(model);
  constexpr std::size_t kHeader = 15;
  Bytes header{kClassInterface, 1, 2};
  put(header, kHeader + all.size(), 2);
  append(header, {0x81, 0, 3, 0, 0, 0, 1, 0, 0});
  Bytes bytes = sized(header);
  append(bytes, all);
  return bytes;
}

}  // namespace

void put(Bytes& bytes, std::uint64_t number, int size) {
  for (int i = 0; i < size; ++i) bytes.push_back(static_cast<std::uint8_t>(number >> (8 * i)));
}

Bytes device_descriptor() {
  Bytes content{1, 0, 2, 0xef, 2, 1, 64};
  put(content, 0x1d6b, 2);
  put(content, 0x0102, 2);
  put(content, 0x0100, 2);
  append(content, {1, 2, 3, 1});  // texts: maker, product, serial number; configurations
  return sized(content);
}

Bytes configuration_descriptor(const CameraModel& model) {
  Bytes rest;
  append(rest, sized({kAssociationDescriptor, 0, 2, kVideo, 3, 0, 2}));
  append(rest, interface(0, 0, kVideoControl));
  append(rest, control_entities());
  append(rest, interface(1, 1, kVideoStreaming));
  append(rest, streaming_formats(model));
  append(rest, sized({kEndpointDescriptor, 0x81, 2, 0, 2, 0}));  // bulk, in, 512 bytes
  constexpr std::size_t kHeader = 9;
  Bytes content{2};
  put(content, kHeader + rest.size(), 2);
  append(content, {2, 1, 0, 0x80, 250});
  Bytes bytes = sized(content);
  append(bytes, rest);
  return bytes;
}

Bytes text_descriptor(const CameraModel& model, int number) {
  if (number == 0) return {4, 3, 9, 4};  // in English
  const std::string text = number == 1 ? "Simulated" : number == 2 ? model.product : number == 3 ? model.serial : "";
  if (text.empty()) return {};
  Bytes content{3};
  for (const char character : text) put(content, static_cast<std::uint8_t>(character), 2);
  return sized(content);
}

}  // namespace panvo::test
