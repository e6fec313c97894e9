// SPDX-License-Identifier: Apache-2.0
/// For libFuzzer (PANVO_FUZZ).
#include "read_bag.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  panvo::recorder::fuzz::read_bag("bag_0.mcap", data, size);
  return 0;
}
