// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "panvo/camera_stream/raw_image.hpp"

namespace panvo::camera_stream {

/// How many bytes an image of that format takes, rows without gaps.
std::size_t packed_bytes(PixelFormat format, int width, int height);

/// Bits a grey pixel of 10 to 16 bits is to be shifted by to fill 16.
int shift_of(PixelFormat format);

/// Whether several pixels share a byte.
bool is_packed(PixelFormat format);

/// The pixels of a packed format, each shifted to fill 16 bits. `pixels` is of type CV_16UC1, its rows without gaps.
void unpack(const RawImage& raw, cv::Mat& pixels);

}  // namespace panvo::camera_stream
