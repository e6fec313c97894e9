// SPDX-License-Identifier: Apache-2.0
// libFuzzer target: decodes the input. The result must be a valid image or a reason.
#include <cstdint>
#include <cstdlib>

#include "panvo/compressed_images/decode.hpp"
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
