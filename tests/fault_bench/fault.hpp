// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <opencv2/core.hpp>
#include <string_view>
#include <vector>

#include "draw.hpp"
#include "nav_msgs/msg/Odometry.h"
#include "panvo_msgs/msg/AzimuthChange.h"
#include "panvo_msgs/msg/OdometryQuality.h"
#include "panvo_msgs/msg/PanoramicLandmark.h"
#include "panvo_msgs/msg/PositionCorrection.h"
#include "sensor_msgs/msg/CameraInfo.h"
#include "tf2_msgs/msg/TFMessage.h"

namespace panvo::test {

/// A stereo pair; a fault may change the stamps separately.
struct StereoPair {
  std::int64_t left_ns = 0, right_ns = 0;
  cv::Mat left, right;
};

struct Panorama {
  std::int64_t stamp_ns = 0;
  cv::Mat pixels;
};

/// Time interval of a fault, s after the first message.
struct FaultWindow {
  double from_s = 0.0;
  double to_s = 0.0;

  bool contains(double t_s) const { return t_s >= from_s && t_s < to_s; }
};

/// Time of a message in the undisturbed recording.
struct Moment {
  double t_s = 0.0;
  bool is_on = false;  ///< within the fault's window
};

/// Maps a message to the messages that replace it: none, itself, another one, or several. Called for every message in
/// order, also outside the window, because a fault may have to store messages.
template <class Message>
using Passage = std::function<std::vector<Message>(const Message& message, const Moment& moment)>;

/// The function of a fault for each stream between recording and system. A stream without a function passes unchanged.
/// Input images are shared and must not be modified.
struct Fault {
  Passage<StereoPair> pairs{};
  Passage<Panorama> panoramas{};
  Passage<sensor_msgs::msg::CameraInfo> left_infos{}, right_infos{};
  Passage<tf2_msgs::msg::TFMessage> static_transforms{};
  Passage<nav_msgs::msg::Odometry> truth{};
  Passage<nav_msgs::msg::Odometry> odometry{};
  Passage<panvo_msgs::msg::OdometryQuality> qualities{};
  Passage<panvo_msgs::msg::AzimuthChange> azimuths{};
  Passage<panvo_msgs::msg::PanoramicLandmark> landmarks{};
  Passage<panvo_msgs::msg::PositionCorrection> corrections{};
};

/// How long a fault lasts.
enum class Lasting {
  kWhile,   ///< some seconds in the first half, to observe the recovery
  kOnward,  ///< from a time in the first half to the end
  kWhole,   ///< from the first message to the last
};

/// A kind of fault. Details depend on the seed.
struct FaultKind {
  std::string_view name;
  std::string_view description;
  Lasting lasting = Lasting::kWhile;
  Fault (*make)(Draw& draw, const FaultWindow& window) = nullptr;
};

/// All kinds in the order of the table; the first is "none".
const std::vector<FaultKind>& fault_kinds();

/// Throws std::invalid_argument, listing the kinds, for an unknown name.
const FaultKind& fault_kind(std::string_view name);

/// Time interval of the fault in a recording of duration `span_s`.
FaultWindow fault_window(const FaultKind& kind, std::uint64_t seed, double span_s);

Fault make_fault(const FaultKind& kind, std::uint64_t seed, double span_s);

}  // namespace panvo::test
