// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "panvo/conversions/transform_buffer.hpp"
#include "panvo/runtime/context.hpp"

namespace panvo::conversions {

/// Subscribes a component to /tf_static, with `Frames::kMoving` also to /tf, and keeps what arrives. Invalid transforms
/// are logged. Create it in the component's constructor; use it on the component's message thread.
class TransformListener {
 public:
  enum class Frames { kStatic, kMoving };

  explicit TransformListener(runtime::Context& context, Frames frames = Frames::kStatic);
  TransformListener(const TransformListener&) = delete;
  TransformListener& operator=(const TransformListener&) = delete;

  const TransformBuffer& buffer() const { return buffer_; }

  /// target_from_source along static transforms. Returns nullopt if no chain connects the frames, and logs a throttled
  /// warning that ends with `remedy`.
  std::optional<Eigen::Isometry3d> lookup(const std::string& target, const std::string& source,
                                          std::string_view remedy) const;

 private:
  runtime::Context& context_;
  TransformBuffer buffer_;
};

}  // namespace panvo::conversions
