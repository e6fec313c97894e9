// SPDX-License-Identifier: Apache-2.0
#include "panvo/conversions/transform_listener.hpp"

#include "panvo/interfaces/topics.hpp"

namespace panvo::conversions {
namespace {

void log(runtime::Context& context, std::string_view topic, const std::vector<std::string>& problems) {
  for (const auto& problem : problems) {
    context.log().warn_throttled(problem, "{}: {}", context.resolved_name(topic), problem);
  }
}

}  // namespace

TransformListener::TransformListener(runtime::Context& context, Frames frames) : context_(context) {
  context.input(topics::kTfStatic,
                [this](const auto& message) { log(context_, topics::kTfStatic.name, buffer_.add_static(*message)); });
  if (frames == Frames::kStatic) return;
  context.input(topics::kTf,
                [this](const auto& message) { log(context_, topics::kTf.name, buffer_.add_moving(*message)); });
}

std::optional<Eigen::Isometry3d> TransformListener::lookup(const std::string& target, const std::string& source,
                                                           std::string_view remedy) const {
  auto target_from_source = buffer_.lookup(target, source);
  if (!target_from_source) {
    context_.log().warn_throttled("no chain " + target + " " + source, "{} has no chain from {} to {} yet: {}",
                                  context_.resolved_name(topics::kTfStatic), target, source, remedy);
  }
  return target_from_source;
}

}  // namespace panvo::conversions
