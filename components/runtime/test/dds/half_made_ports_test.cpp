// SPDX-License-Identifier: Apache-2.0
#include "dds/half_made_ports.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <fstream>
#include <string>

namespace panvo::runtime::dds {
namespace {

namespace fs = std::filesystem;

class HalfMadePorts : public testing::Test {
 protected:
  void SetUp() override { fs::create_directory(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path make(const std::string& name, const std::string& content, std::chrono::seconds age) const {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    fs::last_write_time(folder_ / name, fs::file_time_type::clock::now() - age);
    return folder_ / name;
  }
  static std::string begun(std::uint32_t state) {
    std::string content(64, '\0');
    content.replace(0, sizeof(state), reinterpret_cast<const char*>(&state), sizeof(state));
    return content;
  }

  const fs::path folder_ = fs::path(testing::TempDir()) / ("panvo_half_made_" + std::to_string(::getpid()));
  const std::chrono::seconds old_{60};
};

TEST_F(HalfMadePorts, OfAProcessThatIsGoneAreRemoved) {
  const auto empty = make("fastrtps_port19163", "", old_);
  const auto begun_only = make("fastrtps_port19164", begun(1), old_);
  EXPECT_EQ(remove_half_made_ports(folder_), 2U);
  EXPECT_FALSE(fs::exists(empty));
  EXPECT_FALSE(fs::exists(begun_only));
}

TEST_F(HalfMadePorts, LeavesThoseThatAreMadeOrBeingMadeAndWhatIsNone) {
  const auto made = make("fastrtps_port7410", begun(2), old_);
  const auto young = make("fastrtps_port7411", "", std::chrono::seconds(0));
  const auto lock = make("fastrtps_port7412_el", "", old_);
  const auto other = make("fastrtps_portrait", "", old_);
  EXPECT_EQ(remove_half_made_ports(folder_), 0U);
  for (const auto& file : {made, young, lock, other}) EXPECT_TRUE(fs::exists(file)) << file;
}

TEST_F(HalfMadePorts, WithoutAFolderAreNone) { EXPECT_EQ(remove_half_made_ports(folder_ / "nowhere"), 0U); }

}  // namespace
}  // namespace panvo::runtime::dds
