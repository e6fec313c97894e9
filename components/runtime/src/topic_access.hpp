// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "context_state.hpp"
#include "panvo/runtime/topic_access.hpp"

namespace panvo::runtime {

/// `open`: opens an output of the component that asks.
std::unique_ptr<TopicAccess> make_topic_access(
    Host& host, std::function<std::shared_ptr<UntypedOutput>(const TopicDescription&)> open);

}  // namespace panvo::runtime
