// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/topic/IContentFilterFactory.hpp>

#include "fast_dds.hpp"

namespace panvo::runtime::dds {

// Our readers filter out what writers of the same participant write: within the process, messages pass by pointer. Fast
// DDS 2.9 matches readers and writers of a participant and has no option against it. The filter runs before a message is
// copied.
//
// Within a process, Fast DDS does not tell a filter the writer of a message. Therefore our writers state it, with
// `written_by`.

inline constexpr const char* kRemoteOnlyClass = "PANVO_REMOTE_ONLY";
inline constexpr const char* kRemoteOnlyExpression = "remote";  // an empty one would switch the filter off

/// Factory of the filter class. Lives as long as the process.
fdds::IContentFilterFactory& remote_only_filters();

/// Parameters of a message that state its writer. They are not sent.
rtps::WriteParams written_by(const rtps::GUID_t& writer);

}  // namespace panvo::runtime::dds
