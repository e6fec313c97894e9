// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arv.h>

#include <optional>
#include <string>

#include "panvo/camera_stream/raw_image.hpp"

namespace panvo::aravis_camera {

/// nullopt: not supported.
std::optional<camera_stream::PixelFormat> pixel_format_of(ArvPixelFormat format);

/// The supported formats, for messages.
std::string readable_formats();

}  // namespace panvo::aravis_camera
