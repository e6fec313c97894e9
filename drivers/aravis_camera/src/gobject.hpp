// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arv.h>

#include <memory>
#include <string>

/// GLib's objects and errors with owners.
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

/// Where a GLib function puts its error: `function(..., error.slot())`.
class ErrorSlot {
 public:
  ErrorSlot() = default;
  ~ErrorSlot() { g_clear_error(&error_); }
  ErrorSlot(const ErrorSlot&) = delete;
  ErrorSlot& operator=(const ErrorSlot&) = delete;

  /// Empty again, for the next call.
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
