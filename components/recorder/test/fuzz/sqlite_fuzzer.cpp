// SPDX-License-Identifier: Apache-2.0
/// libFuzzer target (PANVO_FUZZ): reads the input as a SQLite file. Seeds an empty corpus with bags of our writer.
#include "fuzzing.hpp"
#include "mutation.hpp"
#include "read_bag.hpp"
#include "seeds.hpp"
#include "sqlite_mutator.hpp"

using namespace panvo::recorder;

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  fuzz::plant_seeds(Storage::kSqlite3, *argc, *argv);
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t limit, unsigned seed) {
  const std::string file(reinterpret_cast<const char*>(data), size);
  const auto changed = seed % 4 == 0   ? fuzz::mutate_bytes(file, limit)
                       : seed % 4 == 1 ? fuzz::mutated(file, seed)
                       : seed % 4 == 2 ? fuzz::mutate_page(file, seed)
                                       : fuzz::mutate_by_sql(file, seed);
  return fuzz::hand_back(changed, data, limit);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::read_bag("bag_0.db3", data, size);
  return 0;
}
