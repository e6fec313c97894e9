// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "panvo/camera_stream/raw_image.hpp"

namespace panvo::camera_stream {

/// Number of bytes of an image in that format, without gaps between rows.
std::size_t packed_bytes(PixelFormat format, int width, int height);

/// Left shift in bits that expands a grey pixel of 10 to 16 bits to 16.
int shift_of(PixelFormat format);

/// Whether several pixels share a byte.
bool is_packed(PixelFormat format);

/// Unpacks the pixels of a packed format and shifts each to fill 16 bits. `pixels` must be CV_16UC1 and continuous.
void unpack(const RawImage& raw, cv::Mat& pixels);

}  // namespace panvo::camera_stream
