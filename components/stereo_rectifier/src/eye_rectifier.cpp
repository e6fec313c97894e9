// SPDX-License-Identifier: Apache-2.0
#include "eye_rectifier.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "panvo/conversions/image.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/vision/camera_model.hpp"

namespace panvo::stereo_rectifier {
namespace {

bool describes_the_same(const sensor_msgs::msg::CameraInfo& a, const sensor_msgs::msg::CameraInfo& b) {
  return a.width() == b.width() && a.height() == b.height() && a.k() == b.k() && a.d() == b.d() && a.r() == b.r() &&
         a.p() == b.p() && a.distortion_model() == b.distortion_model() && a.binning_x() == b.binning_x() &&
         a.binning_y() == b.binning_y() && a.roi() == b.roi();
}

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

EyeRectifier::Change EyeRectifier::set_camera(const sensor_msgs::msg::CameraInfo& info) {
  if (camera_ && describes_the_same(info, info_)) return Change::kNone;
  const auto change = camera_ ? Change::kChanged : Change::kFirst;
  info_ = info;
  camera_ = usable_camera(info);
  map_.reset();
  return change;
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
