// SPDX-License-Identifier: Apache-2.0
// For libFuzzer: the bytes are a JPEG or PNG file, or none. They become an image that is whole, or a reason.
#include <cstdint>
#include <cstdlib>

#include "decode.hpp"
#include "panvo/conversions/image.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace panvo::compressed_images;
  sensor_msgs::msg::CompressedImage message;
  message.data().assign(data, data + size);
  for (const Output output : {Output::kSame, Output::kMono8}) {
    const auto image = decode(message, output);
    if (image ? !panvo::conversions::view(**image) : image.reason().empty()) std::abort();
  }
  return 0;
}
