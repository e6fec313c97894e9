// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "panvo/interfaces/fingerprint.hpp"
#include "panvo/runtime/context.hpp"
#include "panvo/runtime/fingerprint.hpp"

namespace panvo::runtime {

/// What a container loads. A component sets itself up in its constructor, which takes a Context and throws ConfigError only; from then on
/// the runtime calls what the constructor registered, one call at a time, and the destructor when it is unloaded.
class Component {
 public:
  Component() = default;
  virtual ~Component() = default;
  Component(const Component&) = delete;
  Component& operator=(const Component&) = delete;
};

/// What a plugin says of one component class in it.
struct ComponentDescriptor {
  std::string_view runtime_build;  ///< of what the plugin was built with; must equal the container's
  std::string_view class_name;     ///< "StereoRectifierComponent"
  Component* (*create)(Context&);
  void (*destroy)(Component*);
  const ComponentDescriptor* next;  ///< the plugin's other components
};

inline constexpr std::string_view kRuntimeVersion = "0.1.0";

/// Tells apart two builds of one version whose headers differ: a plugin of the one would misread the other's memory.
inline constexpr std::string_view kRuntimeBuild =
    "0.1.0 (headers " PANVO_RUNTIME_FINGERPRINT ", messages " PANVO_INTERFACES_FINGERPRINT ")";

/// The C function by which a container asks a plugin for its components.
inline constexpr const char* kPluginEntryPoint = "panvo_components";

namespace detail {
/// The components registered in this plugin: hidden, so that each plugin has a list of its own.
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

/// Makes a component class loadable; at namespace scope in its source file, with an unqualified class name.
#define PANVO_REGISTER_COMPONENT(Class)                                                                      \
  namespace {                                                                                                \
  ::panvo::runtime::ComponentDescriptor panvo_descriptor_of_##Class{                                         \
      ::panvo::runtime::kRuntimeBuild, #Class,                                                               \
      [](::panvo::runtime::Context& context) -> ::panvo::runtime::Component* { return new Class(context); }, \
      [](::panvo::runtime::Component* component) { delete component; }, nullptr};                            \
  const ::panvo::runtime::detail::Registrar panvo_registrar_of_##Class{panvo_descriptor_of_##Class};         \
  }
