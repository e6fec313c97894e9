// SPDX-License-Identifier: Apache-2.0
#include "eye_rectifier.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "panvo/conversions/image.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/vision/camera_model.hpp"

namespace panvo::stereo_rectifier {
namespace {

/// The camera of a camera_info, if CameraModel accepts its lens.
conversions::Result<conversions::PairedCamera> usable_camera(const sensor_msgs::msg::CameraInfo& info) {
  const auto camera = conversions::to_camera(info);
  if (!camera) return camera;
  try {
    const vision::CameraModel model(camera->raw);
  } catch (const std::invalid_argument& error) {
    return conversions::Reason{error.what()};
  }
  return camera;
}

bool is_grey(const sensor_msgs::msg::Image& image) { return image.encoding() == "mono8" || image.encoding() == "8UC1"; }

}  // namespace

EyeRectifier::Info EyeRectifier::add_info(const sensor_msgs::msg::CameraInfo& info) {
  sensor_msgs::msg::CameraInfo received = info;
  received.header({});
  const auto before = infos_.used();
  // Nothing is lost by leaving one that cannot be used.
  const bool is_remedy = camera_ && !*camera_ && usable_camera(received);
  if (is_remedy) infos_.set(received);
  const bool is_disputed = !is_remedy && infos_.add(received);
  if (is_disputed) return Info::kDisputed;
  if (infos_.used() == before) return Info::kKnown;
  use_info();
  return Info::kTaken;
}

bool EyeRectifier::add_image(const sensor_msgs::msg::Image& raw) {
  const auto fits = [&](const sensor_msgs::msg::CameraInfo& info) {
    return info.width() == raw.width() && info.height() == raw.height();
  };
  if (!infos_.add_image(fits)) return false;
  use_info();
  return true;
}

void EyeRectifier::use_info() {
  camera_ = usable_camera(*infos_.used());
  map_.reset();
}

conversions::Result<EyeRectifier::ImagePtr> EyeRectifier::rectify(const ImagePtr& raw) {
  if (!camera_) return conversions::Reason{"has no camera_info yet"};
  if (!*camera_) return conversions::Reason{"has a camera_info that " + camera_->reason()};
  const auto& camera = **camera_;
  const auto& size = camera.raw.pinhole;
  if (static_cast<int>(raw->width()) != size.width || static_cast<int>(raw->height()) != size.height) {
    return conversions::Reason{
        fmt::format("is {} x {} px, but its camera_info is for {} x {} px; calibrate at the published image size",
                    raw->width(), raw->height(), size.width, size.height)};
  }
  const bool is_wanted_encoding = output_ == Output::kSame || is_grey(*raw);
  if (is_wanted_encoding && conversions::is_rectified(camera)) {
    const auto pixels = conversions::view(*raw);  // also validates images that are passed through
    if (!pixels) return conversions::Reason{pixels.reason()};
    return raw;
  }
  return remap(*raw, camera);
}

conversions::Result<EyeRectifier::ImagePtr> EyeRectifier::remap(const sensor_msgs::msg::Image& raw,
                                                                const conversions::PairedCamera& camera) {
  const auto source = output_ == Output::kMono8 ? conversions::grey(raw) : conversions::view(raw);
  if (!source) return conversions::Reason{source.reason()};
  const auto rectified = conversions::make_image(conversions::stamp_ns(raw), raw.header().frame_id(),
                                                 output_ == Output::kMono8 ? "mono8" : raw.encoding(),
                                                 camera.rectified.width, camera.rectified.height);
  cv::Mat destination = conversions::pixels(*rectified);
  if (conversions::is_rectified(camera)) {
    source->copyTo(destination);
  } else {
    if (!map_) map_.emplace(camera.raw, camera.rectified_from_raw, camera.rectified);
    map_->apply(*source, destination);
  }
  return ImagePtr(rectified);
}

}  // namespace panvo::stereo_rectifier
