// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "panvo/interfaces/fingerprint.hpp"
#include "panvo/runtime/context.hpp"
#include "panvo/runtime/fingerprint.hpp"
#include "panvo/runtime/version.hpp"

namespace panvo::runtime {

/// Base class of the components a container loads. The constructor takes a Context, registers callbacks and throws only
/// ConfigError. The runtime then runs the callbacks, one at a time, and the destructor at unload.
class Component {
 public:
  Component() = default;
  virtual ~Component() = default;
  Component(const Component&) = delete;
  Component& operator=(const Component&) = delete;
};

/// Describes one component class of a plugin.
struct ComponentDescriptor {
  std::string_view runtime_build;  ///< build the plugin was compiled against; must equal the container's
  std::string_view class_name;     ///< "StereoRectifierComponent"
  Component* (*create)(Context&);
  void (*destroy)(Component*);
  const ComponentDescriptor* next;  ///< the plugin's other components
};

inline constexpr std::string_view kRuntimeVersion = PANVO_RUNTIME_VERSION;

/// Distinguishes builds of one version with different headers: their plugins have incompatible memory layouts.
inline constexpr std::string_view kRuntimeBuild =
    PANVO_RUNTIME_VERSION " (headers " PANVO_RUNTIME_FINGERPRINT ", messages " PANVO_INTERFACES_FINGERPRINT ")";

/// C function through which a container gets a plugin's components.
inline constexpr const char* kPluginEntryPoint = "panvo_components";

namespace detail {
/// Components registered in this plugin. Hidden visibility gives each plugin its own list.
__attribute__((visibility("hidden"))) inline const ComponentDescriptor* registered = nullptr;

struct Registrar {
  explicit Registrar(ComponentDescriptor& descriptor) {
    descriptor.next = registered;
    registered = &descriptor;
  }
};
}  // namespace detail
}  // namespace panvo::runtime

extern "C" __attribute__((weak, visibility("default"))) const panvo::runtime::ComponentDescriptor* panvo_components() {
  return panvo::runtime::detail::registered;
}

/// Makes a component class loadable. Use at namespace scope in its source file, with an unqualified class name.
#define PANVO_REGISTER_COMPONENT(Class)                                                                      \
  namespace {                                                                                                \
  ::panvo::runtime::ComponentDescriptor panvo_descriptor_of_##Class{                                         \
      ::panvo::runtime::kRuntimeBuild, #Class,                                                               \
      [](::panvo::runtime::Context& context) -> ::panvo::runtime::Component* { return new Class(context); }, \
      [](::panvo::runtime::Component* component) { delete component; }, nullptr};                            \
  const ::panvo::runtime::detail::Registrar panvo_registrar_of_##Class{panvo_descriptor_of_##Class};         \
  }
