// SPDX-License-Identifier: Apache-2.0
// Files that the localizer writes replace no others.
#include "kept_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <ostream>
#include <sstream>
#include <string>

#include "georeference_file.hpp"
#include "last_pose.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "self_calibration_file.hpp"

namespace panvo::localizer {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct KeptKind {
  const char* name;
  std::function<void(const fs::path&)> write;
  std::function<bool(const fs::path&)> read;  ///< whether there is one
};

std::ostream& operator<<(std::ostream& out, const KeptKind& kind) { return out << kind.name; }

PoseInMap some_pose() { return {Eigen::Isometry3d::Identity(), vision::Matrix6d::Identity()}; }

const KeptKind kKeptKinds[] = {
    {"LastPose",
     [](const fs::path& file) {
       write_last_pose(file, {1'700, "map", some_pose(), 5.0});
     },
     [](const fs::path& file) { return read_last_pose(file).has_value(); }},
    {"Georeference",
     [](const fs::path& file) {
       write_georeference(file, {"map", {48.0, 11.0, 500.0}, some_pose()});
     },
     [](const fs::path& file) { return read_georeference(file).has_value(); }},
    {"SelfCalibration",
     [](const fs::path& file) {
       write_self_calibration(file, {{{0.3, 0.004}}, {}, {}, {{1.004, 0.001}}});
     },
     [](const fs::path& file) { return read_self_calibration(file).has_value(); }},
};

std::string fault_of_kept(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

class KeptFile : public ::testing::TestWithParam<KeptKind> {
 protected:
  std::string text() const {
    std::ostringstream text;
    text << std::ifstream(file_).rdbuf();
    return text.str();
  }
  void put(const std::string& text) const { std::ofstream(file_) << text; }
  std::string write_fault() const {
    return fault_of_kept([this] { GetParam().write(file_); });
  }
  std::string read_fault() const {
    return fault_of_kept([this] { GetParam().read(file_); });
  }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()));
  }
  void expect_left(const std::string& foreign) const {
    put(foreign);
    const auto names_both = AllOf(HasSubstr(file_.string()), HasSubstr("left as it is: name another file, or delete"));
    EXPECT_THAT(read_fault(), names_both);
    EXPECT_THAT(write_fault(), names_both);
    EXPECT_EQ(text(), foreign);
    EXPECT_EQ(files(), 1U);
  }

  const test::TemporaryFolder folder_;
  const fs::path file_ = folder_.path() / "kept.txt";
};

TEST_P(KeptFile, ReplacesNoneOfAnotherKind) {
  expect_left("image_width: 640\nimage_height: 480\n");
  expect_left("one line without an end");
  expect_left(std::string(70'000, 'a'));
}

TEST_P(KeptFile, ReplacesNoneOfANewerVersion) {
  GetParam().write(file_);
  expect_left(text() + "vehicle 7\n");
}

TEST_P(KeptFile, ReplacesNoneOfTheOtherKinds) {
  for (const auto& other : kKeptKinds) {
    if (std::string(other.name) == GetParam().name) continue;
    fs::remove(file_);
    other.write(file_);
    expect_left(text());
  }
}

TEST_P(KeptFile, ReplacesOneOfItsKindEvenIfDamaged) {
  GetParam().write(file_);
  const std::string good = text();
  ASSERT_TRUE(GetParam().read(file_));
  const auto first_end = good.find('\n');
  for (const std::string& damaged :
       {good, std::string(), good.substr(0, first_end + 4), good.substr(0, good.find(' ')) + " ?\n"}) {
    put(damaged);
    EXPECT_THAT(write_fault(), IsEmpty()) << damaged;
    EXPECT_EQ(text(), good);
  }
}

TEST_P(KeptFile, HasATemporaryFileOfItsOwn) {
  const fs::path part = file_.string() + ".part";
  std::ofstream(part) << "of another writer";
  GetParam().write(file_);
  EXPECT_TRUE(GetParam().read(file_));
  std::ostringstream left;
  left << std::ifstream(part).rdbuf();
  EXPECT_EQ(left.str(), "of another writer");
  EXPECT_EQ(files(), 2U);
}

TEST_P(KeptFile, LeavesNothingBehindIfItCannotBeWritten) {
  fs::create_directory(file_);
  EXPECT_THAT(write_fault(), HasSubstr(file_.string()));
  EXPECT_EQ(files(), 1U);
}

INSTANTIATE_TEST_SUITE_P(OfTheLocalizer, KeptFile, ::testing::ValuesIn(kKeptKinds),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace panvo::localizer
