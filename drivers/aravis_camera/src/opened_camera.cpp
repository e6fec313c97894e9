// SPDX-License-Identifier: Apache-2.0
#include "opened_camera.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apply_settings.hpp"
#include "panvo/aravis_camera/device_list.hpp"

namespace panvo::aravis_camera {
namespace {

void note_control_lost(ArvDevice*, gpointer flag) { *static_cast<std::atomic<bool>*>(flag) = true; }

std::string reason_of(const ErrorSlot& error) {
  if (error.is(ARV_DEVICE_ERROR_NOT_CONTROLLER) || error.is(ARV_DEVICE_ERROR_PROTOCOL_ERROR_ACCESS_DENIED))
    return "is in use: another program controls it (" + error.text() + "); stop that program";
  std::string text = error.text();
  if (text.find("ACCESS") != std::string::npos || text.find("permission") != std::string::npos ||
      text.find("Access denied") != std::string::npos)
    return "cannot be opened by this user (" + text +
           "); grant access with a udev rule, see drivers/aravis_camera/README.md";
  return "cannot be opened: " + text;
}

constexpr std::chrono::milliseconds kStillTrue(1000);  // reuses the search made for another camera

/// The announced camera that `camera` selects. Throws OpenError with the available cameras.
Announced find(const std::string& camera) {
  const auto devices = announced_devices(kStillTrue);
  if (camera.empty() && !devices.empty()) return devices.front();
  const auto found =
      std::find_if(devices.begin(), devices.end(), [&](const Announced& device) { return is_meant(device, camera); });
  if (found != devices.end()) return *found;
  if (camera.empty()) throw OpenError("no camera found: check cable, power and network address");
  // Aravis also resolves user-defined names, and addresses beyond the reach of broadcasts.
  Announced by_name;
  by_name.id = camera;
  ErrorSlot error;
  const ObjectPtr<ArvDevice> device(arv_open_device(camera.c_str(), error.slot()));
  if (!device) throw OpenError(fmt::format("camera '{}' not found; available: {}", camera, to_text(devices)));
  return by_name;
}

/// The Aravis id of a known camera, found by its serial number.
std::string find_again(const Identity& known) {
  const auto devices = announced_devices(kStillTrue);
  const auto found = std::find_if(devices.begin(), devices.end(),
                                  [&](const Announced& device) { return device.serial == known.serial; });
  if (found == devices.end())
    throw OpenError(fmt::format("{} does not respond; available: {}", known.serial, to_text(devices)));
  return found->id;
}

}  // namespace

FrameStatus ReceivedFrame::status() const {
  switch (arv_buffer_get_status(buffer_)) {
    case ARV_BUFFER_STATUS_SUCCESS:
      return FrameStatus::kWhole;
    case ARV_BUFFER_STATUS_TIMEOUT:
    case ARV_BUFFER_STATUS_MISSING_PACKETS:
      return FrameStatus::kIncomplete;
    default:
      return FrameStatus::kDamaged;
  }
}

std::string ReceivedFrame::status_text() const {
  switch (arv_buffer_get_status(buffer_)) {
    case ARV_BUFFER_STATUS_SUCCESS:
      return "complete";
    case ARV_BUFFER_STATUS_TIMEOUT:
      return "timed out";
    case ARV_BUFFER_STATUS_MISSING_PACKETS:
      return "packets are missing";
    case ARV_BUFFER_STATUS_WRONG_PACKET_ID:
      return "wrong packet numbers";
    case ARV_BUFFER_STATUS_SIZE_MISMATCH:
      return "larger than announced";
    case ARV_BUFFER_STATUS_ABORTED:
      return "aborted";
    default:
      return "unknown status";
  }
}

OpenedCamera::OpenedCamera(const CameraSettings& settings, bool use_packet_socket, const std::optional<Identity>& known,
                           Search search) {
  if (!known) {
    open(find(settings.camera).id, known);
  } else {
    open(search == Search::kEverywhere ? find_again(*known) : known->id, known);
  }
  start(settings, use_packet_socket);
}

OpenedCamera::~OpenedCamera() {
  if (lost_handler_ != 0) g_signal_handler_disconnect(arv_camera_get_device(camera_.get()), lost_handler_);
  if (!is_gone_) {
    ErrorSlot ignored;  // an unresponsive device is closed as well
    arv_camera_stop_acquisition(camera_.get(), ignored.slot());
  }
}

void OpenedCamera::open(const std::string& id, const std::optional<Identity>& known) {
  ErrorSlot error;
  camera_.reset(arv_camera_new(id.c_str(), error.slot()));
  if (!camera_) throw OpenError(id + " " + reason_of(error));
  is_gige_ = arv_camera_is_gv_device(camera_.get()) != FALSE;
  take_in_identity(id);
  if (known && identity_.serial != known->serial) {
    throw OpenError(fmt::format("the camera at {} is now {}; waiting for {}", id, identity_.serial, known->serial));
  }
  ArvDevice* device = arv_camera_get_device(camera_.get());
  if (is_gige_ && !arv_gv_device_is_controller(ARV_GV_DEVICE(device))) {
    throw OpenError(identity_.serial +
                    " is in use: another program controls it (Controller privilege required); stop that program");
  }
  lost_handler_ = g_signal_connect(device, "control-lost", G_CALLBACK(note_control_lost), &is_gone_);
  // Aravis then reports invalid settings by name instead of sending them to the camera.
  arv_camera_set_range_check_policy(camera_.get(), ARV_RANGE_CHECK_POLICY_ENABLE);
  arv_camera_set_access_check_policy(camera_.get(), ARV_ACCESS_CHECK_POLICY_ENABLE);
}

void OpenedCamera::take_in_identity(const std::string& id) {
  ErrorSlot error;
  identity_.id = id;
  identity_.serial = text_of(arv_camera_get_device_serial_number(camera_.get(), error.slot()));
  identity_.vendor = text_of(arv_camera_get_vendor_name(camera_.get(), error.slot()));
  identity_.model = text_of(arv_camera_get_model_name(camera_.get(), error.slot()));
  identity_.protocol = is_gige_ ? "GigEVision" : arv_camera_is_uv_device(camera_.get()) ? "USB3Vision" : "Fake";
  if (!is_gige_) return;
  ArvGvDevice* device = ARV_GV_DEVICE(arv_camera_get_device(camera_.get()));
  const ObjectPtr<GInetAddress> address(G_INET_ADDRESS(g_object_ref(
      g_inet_socket_address_get_address(G_INET_SOCKET_ADDRESS(arv_gv_device_get_device_address(device))))));
  const std::unique_ptr<char, Free> text(g_inet_address_to_string(address.get()));
  identity_.address = text.get();
}

void OpenedCamera::start(const CameraSettings& settings, bool use_packet_socket) {
  negotiated_.refused = apply(camera_.get(), settings);
  ErrorSlot error;
  gint x = 0, y = 0;
  arv_camera_get_region(camera_.get(), &x, &y, &negotiated_.width, &negotiated_.height, error.slot());
  negotiated_.pixel_format = text_of(arv_camera_get_pixel_format_as_string(camera_.get(), error.slot()));
  if (settings.trigger == Trigger::kFreeRun)
    negotiated_.frame_rate_hz = arv_camera_get_frame_rate(camera_.get(), error.slot());
  if (error) negotiated_.frame_rate_hz = 0.0;
  if (is_gige_) {
    negotiated_.packet_size = arv_camera_gv_get_packet_size(camera_.get(), error.slot());
    negotiated_.uses_packet_socket = use_packet_socket;
    arv_camera_gv_set_stream_options(
        camera_.get(), use_packet_socket ? ARV_GV_STREAM_OPTION_NONE : ARV_GV_STREAM_OPTION_PACKET_SOCKET_DISABLED);
  }
  stream_.reset(arv_camera_create_stream(camera_.get(), nullptr, nullptr, error.slot()));
  if (!stream_) throw OpenError(identity_.serial + " " + reason_of(error));
  const guint payload = arv_camera_get_payload(camera_.get(), error.slot());
  if (error) throw OpenError(identity_.serial + " does not report its frame size: " + error.text());
  if (is_gige_) {
    // Kernel buffer for several frames, up to net.core.rmem_max; Aravis's default holds one frame.
    constexpr guint kFrames = 8, kMin = 1U << 20;
    const auto room = static_cast<gint>(std::min(std::max(kFrames * payload, kMin), kFrames * kMin * 4));
    g_object_set(stream_.get(), "packet-resend",
                 settings.resend ? ARV_GV_STREAM_PACKET_RESEND_ALWAYS : ARV_GV_STREAM_PACKET_RESEND_NEVER,
                 "socket-buffer", ARV_GV_STREAM_SOCKET_BUFFER_FIXED, "socket-buffer-size", room, nullptr);
  }
  for (int i = 0; i < settings.buffers; ++i) arv_stream_push_buffer(stream_.get(), arv_buffer_new_allocate(payload));
  chunks_ = settings.chunks;
  if (!chunks_.empty()) chunk_parser_.reset(arv_camera_create_chunk_parser(camera_.get()));
  arv_camera_set_acquisition_mode(camera_.get(), ARV_ACQUISITION_MODE_CONTINUOUS, error.slot());
  arv_camera_start_acquisition(camera_.get(), error.slot());
  if (error) throw OpenError(identity_.serial + " does not start streaming: " + error.text());
}

std::unique_ptr<ReceivedFrame> OpenedCamera::receive(std::chrono::microseconds limit) {
  ArvBuffer* buffer = arv_stream_timeout_pop_buffer(stream_.get(), static_cast<guint64>(limit.count()));
  return buffer != nullptr ? std::make_unique<ReceivedFrame>(stream_.get(), buffer) : nullptr;
}

std::vector<std::string> OpenedCamera::set(const std::vector<camera_group::DeviceSetting>& features) {
  return apply(camera_.get(), features);
}

bool OpenedCamera::trigger() {
  ErrorSlot error;
  arv_camera_software_trigger(camera_.get(), error.slot());
  return !error;
}

std::uint64_t OpenedCamera::resent_packets() const {
  if (!ARV_IS_GV_STREAM(stream_.get())) return 0;
  guint64 resent = 0, missing = 0;
  arv_gv_stream_get_statistics(ARV_GV_STREAM(stream_.get()), &resent, &missing);
  return resent;
}

std::map<std::string, std::string> OpenedCamera::chunk_data(const ReceivedFrame& frame) const {
  std::map<std::string, std::string> values;
  if (!chunk_parser_ || !arv_buffer_has_chunks(frame.buffer())) return values;
  ErrorSlot error;
  for (const auto& name : chunks_) {
    const std::string feature = "Chunk" + name;
    const double real =
        arv_chunk_parser_get_float_value(chunk_parser_.get(), frame.buffer(), feature.c_str(), error.slot());
    if (!error) {
      values[name] = fmt::format("{:.6g}", real);
      continue;
    }
    const auto whole =
        arv_chunk_parser_get_integer_value(chunk_parser_.get(), frame.buffer(), feature.c_str(), error.slot());
    if (!error) values[name] = std::to_string(whole);
  }
  return values;
}

}  // namespace panvo::aravis_camera
