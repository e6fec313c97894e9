// SPDX-License-Identifier: Apache-2.0
#include "apply_settings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "feature.hpp"

namespace panvo::aravis_camera {
namespace {

/// Collects the settings that a camera refuses.
class Refusals {
 public:
  /// Calls `set(GError**)`; records a failure with the requested setting.
  template <class Set>
  bool attempt(const std::string& wanted, Set set) {
    ErrorSlot error;
    set(error.slot());
    if (error) texts_.push_back(fmt::format("{}: {}", wanted, error.text()));
    return !error;
  }
  void add(std::string text) { texts_.push_back(std::move(text)); }
  std::vector<std::string> take() { return std::move(texts_); }

 private:
  std::vector<std::string> texts_;
};

void set_pixel_format(ArvCamera* camera, const std::string& format, Refusals& refusals) {
  if (format.empty()) return;
  ErrorSlot error;
  guint count = 0;
  const std::unique_ptr<const char*[], Free> list(
      arv_camera_dup_available_pixel_formats_as_strings(camera, &count, error.slot()));
  std::vector<std::string> formats;
  for (guint i = 0; list && i < count; ++i) formats.emplace_back(list[i]);
  if (!error && std::find(formats.begin(), formats.end(), format) == formats.end()) {
    refusals.add(fmt::format("pixel_format {}: the camera has {}", format, fmt::join(formats, ", ")));
    return;
  }
  refusals.attempt("pixel_format " + format,
                   [&](GError** slot) { arv_camera_set_pixel_format_from_string(camera, format.c_str(), slot); });
}

void set_region(ArvCamera* camera, const CameraSettings& settings, Refusals& refusals) {
  if (settings.width == 0 && settings.height == 0) return;
  // -1: unchanged.
  const int width = settings.width > 0 ? settings.width : -1, height = settings.height > 0 ? settings.height : -1;
  const auto wanted = fmt::format("width {}, height {}, offset {}, {}", settings.width, settings.height,
                                  settings.offset_x, settings.offset_y);
  if (!refusals.attempt(wanted, [&](GError** slot) {
        arv_camera_set_region(camera, settings.offset_x, settings.offset_y, width, height, slot);
      }))
    return;
  gint x = 0, y = 0, got_width = 0, got_height = 0;
  ErrorSlot error;
  arv_camera_get_region(camera, &x, &y, &got_width, &got_height, error.slot());
  if (!error && ((width > 0 && got_width != width) || (height > 0 && got_height != height)))
    refusals.add(fmt::format("{}: the camera gives {} x {} px", wanted, got_width, got_height));
}

void set_trigger(ArvCamera* camera, const CameraSettings& settings, Refusals& refusals) {
  if (settings.trigger == Trigger::kFreeRun) {
    // Errors are ignored: the camera may have no triggers.
    ErrorSlot error;
    arv_camera_clear_triggers(camera, error.slot());
    return;
  }
  const std::string source = settings.trigger == Trigger::kSoftware ? "Software" : settings.trigger_line;
  refusals.attempt("trigger on " + source,
                   [&](GError** slot) { arv_camera_set_trigger(camera, source.c_str(), slot); });
}

void set_ptp(ArvCamera* camera, Refusals& refusals) {
  for (const char* feature : {"PtpEnable", "GevIEEE1588"}) {  // current and older name
    if (arv_camera_is_feature_available(camera, feature, nullptr)) {
      refusals.attempt("clock ptp", [&](GError** slot) { arv_camera_set_boolean(camera, feature, TRUE, slot); });
      return;
    }
  }
  refusals.add("clock ptp: the camera has no PTP (PtpEnable, GevIEEE1588): use clock mapped");
}

void set_packets(ArvCamera* camera, const CameraSettings& settings, Refusals& refusals) {
  if (!arv_camera_is_gv_device(camera)) return;
  if (settings.packet_size > 0) {
    refusals.attempt(fmt::format("packet_size {}", settings.packet_size),
                     [&](GError** slot) { arv_camera_gv_set_packet_size(camera, settings.packet_size, slot); });
  } else {
    refusals.attempt("packet_size 0 (the largest possible)",
                     [&](GError** slot) { arv_camera_gv_auto_packet_size(camera, slot); });
  }
  if (settings.packet_delay_ns) {
    refusals.attempt(fmt::format("packet_delay_ns {}", *settings.packet_delay_ns),
                     [&](GError** slot) { arv_camera_gv_set_packet_delay(camera, *settings.packet_delay_ns, slot); });
  }
}

}  // namespace

std::vector<std::string> apply(ArvCamera* camera, const std::vector<camera_group::DeviceSetting>& features) {
  std::vector<std::string> problems;
  for (const auto& setting : features) {
    if (const auto problem = apply(arv_camera_get_device(camera), setting); !problem.empty())
      problems.push_back("features: " + problem);
  }
  return problems;
}

std::vector<std::string> apply(ArvCamera* camera, const CameraSettings& settings) {
  Refusals refusals;
  for (auto& problem : apply(camera, settings.features)) refusals.add(std::move(problem));
  set_pixel_format(camera, settings.pixel_format, refusals);
  set_region(camera, settings, refusals);
  if (settings.frame_rate_hz > 0.0) {
    refusals.attempt(fmt::format("frame_rate_hz {}", settings.frame_rate_hz),
                     [&](GError** slot) { arv_camera_set_frame_rate(camera, settings.frame_rate_hz, slot); });
  }
  set_trigger(camera, settings, refusals);  // after the rate: setting the rate clears all triggers
  if (settings.exposure_us > 0.0) {
    refusals.attempt(fmt::format("exposure_us {}", settings.exposure_us),
                     [&](GError** slot) { arv_camera_set_exposure_time(camera, settings.exposure_us, slot); });
  }
  if (settings.ptp) set_ptp(camera, refusals);
  if (!settings.chunks.empty()) {
    const std::string list = fmt::format("{}", fmt::join(settings.chunks, ","));
    refusals.attempt("chunks " + list, [&](GError** slot) { arv_camera_set_chunks(camera, list.c_str(), slot); });
  }
  set_packets(camera, settings, refusals);
  return refusals.take();
}

}  // namespace panvo::aravis_camera
