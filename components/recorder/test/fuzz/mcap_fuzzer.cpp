// SPDX-License-Identifier: Apache-2.0
/// libFuzzer target (PANVO_FUZZ): reads the input as an MCAP file. Seeds an empty corpus with bags of our writer.
#include "fuzzing.hpp"
#include "mcap_mutator.hpp"
#include "mutation.hpp"
#include "read_bag.hpp"
#include "seeds.hpp"

using namespace panvo::recorder;

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  fuzz::plant_seeds(Storage::kMcap, *argc, *argv);
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t limit, unsigned seed) {
  const std::string file(reinterpret_cast<const char*>(data), size);
  const auto changed = seed % 3 == 0   ? fuzz::mutate_bytes(file, limit)
                       : seed % 3 == 1 ? fuzz::mutated(file, seed)
                                       : fuzz::mutate_record(file, seed, fuzz::mutate_bytes);
  return fuzz::hand_back(changed, data, limit);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::read_bag("bag_0.mcap", data, size);
  return 0;
}
