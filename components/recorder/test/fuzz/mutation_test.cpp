// SPDX-License-Identifier: Apache-2.0
/// Runs the fuzz target on several thousand damaged bags, the same in every run. $PANVO_FUZZ_CASES sets the number of
/// each kind, $PANVO_FUZZ_SEED the first seed.
#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>

#include "mutation.hpp"
#include "read_bag.hpp"
#include "seeds.hpp"

namespace panvo::recorder {
namespace {

using fuzz::written;

std::uint64_t number_from(const char* variable, std::uint64_t otherwise) {
  const char* text = std::getenv(variable);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

void read_mutations(const char* name, const std::string& file, std::uint64_t count) {
  const auto first = number_from("PANVO_FUZZ_SEED", 1);
  count = number_from("PANVO_FUZZ_CASES", count);
  std::uint64_t readable = 0;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const auto damaged = fuzz::mutated(file, seed);
    const auto messages = fuzz::read_bag(name, reinterpret_cast<const std::uint8_t*>(damaged.data()), damaged.size());
    ASSERT_LE(messages, 50u * 64) << "seed " << seed;
    readable += messages > 0 ? 1 : 0;
  }
  EXPECT_GT(readable, count / 20) << "too few of the damaged bags are readable";
}

TEST(MutatedBag, OfMcapWithoutCompressionIsReadOrRefused) {
  read_mutations("bag_0.mcap", written({.storage = Storage::kMcap, .chunk_bytes = 500}, 40), 1500);
}

TEST(MutatedBag, OfMcapWithLz4IsReadOrRefused) {
  read_mutations("bag_0.mcap",
                 written({.storage = Storage::kMcap, .compression = Compression::kLz4, .chunk_bytes = 500}, 40), 1500);
}

TEST(MutatedBag, OfMcapWithZstdIsReadOrRefused) {
  read_mutations("bag_0.mcap",
                 written({.storage = Storage::kMcap, .compression = Compression::kZstd, .chunk_bytes = 500}, 40), 1500);
}

TEST(MutatedBag, OfSqliteIsReadOrRefused) { read_mutations("bag_0.db3", written({}, 40), 300); }

}  // namespace
}  // namespace panvo::recorder
