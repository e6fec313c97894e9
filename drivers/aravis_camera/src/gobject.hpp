// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arv.h>

#include <memory>
#include <string>

/// Owners of GLib objects and errors.
namespace panvo::aravis_camera {

struct Unref {
  template <class Object>
  void operator()(Object* object) const {
    g_object_unref(object);
  }
};
template <class Object>
using ObjectPtr = std::unique_ptr<Object, Unref>;

struct Free {
  void operator()(void* memory) const { g_free(memory); }
};

/// Receives the error of a GLib function: `function(..., error.slot())`.
class ErrorSlot {
 public:
  ErrorSlot() = default;
  ~ErrorSlot() { g_clear_error(&error_); }
  ErrorSlot(const ErrorSlot&) = delete;
  ErrorSlot& operator=(const ErrorSlot&) = delete;

  /// Clears the error for the next call.
  GError** slot() {
    g_clear_error(&error_);
    return &error_;
  }
  explicit operator bool() const { return error_ != nullptr; }
  std::string text() const { return error_ != nullptr ? error_->message : ""; }
  bool is(ArvDeviceError code) const { return error_ != nullptr && g_error_matches(error_, ARV_DEVICE_ERROR, code); }

 private:
  GError* error_ = nullptr;
};

inline std::string text_of(const char* text) { return text != nullptr ? text : ""; }

}  // namespace panvo::aravis_camera
