// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

namespace panvo::bench {

/// Message types: odometry of 720 B, reliable; or an image, best effort: grey with 307 KB, or a colour panorama with
/// 1.75 MB.
enum class Message : std::uint8_t { kOdometry, kGray, kPanorama };

struct ImageFormat {
  const char* encoding;
  std::uint32_t width, height, channels;
  std::uint32_t step() const { return width * channels; }
  std::uint32_t bytes() const { return step() * height; }
};
constexpr ImageFormat image_format(Message message) {
  return message == Message::kGray ? ImageFormat{"mono8", 640, 480, 1} : ImageFormat{"rgb8", 1080, 540, 3};
}

constexpr int kOdometryDepth = 50, kImageDepth = 5;  // as for the topics of panvo
constexpr const char* kOdometryTopic = "rt/bench/odometry";
constexpr const char* kImageTopic = "rt/bench/image";

/// One side of a topic in one process, by one implementation. Messages carry the time of sending; `arrived` is called
/// with it once the complete message is available as a struct.
class Transport {
 public:
  using Arrived = std::function<void(std::int64_t sent_ns)>;

  virtual ~Transport() = default;
  virtual void open_reader(Arrived arrived) = 0;
  virtual void open_writer() = 0;
  /// Whether a reader, of this process or another, is matched with the writer.
  virtual bool is_matched() const = 0;
  virtual void write(std::int64_t sent_ns) = 0;
};

/// A panvo container: pointers within the process, the DDS bridge between processes. `shared_image_bytes`: largest
/// image shared between processes; 0: images are sent.
std::unique_ptr<Transport> make_panvo_transport(Message message, int domain, std::uint32_t shared_image_bytes);
/// One participant, generated types, shared memory and socket buffers as large as panvo's, listener threads.
std::unique_ptr<Transport> make_fastdds_transport(Message message, int domain);
/// The same with Cyclone DDS, without shared memory in Debian's build; nullptr if it is not installed.
std::unique_ptr<Transport> make_cyclone_transport(Message message, int domain);

}  // namespace panvo::bench
