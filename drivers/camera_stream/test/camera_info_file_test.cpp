// SPDX-License-Identifier: Apache-2.0
#include "panvo/camera_stream/camera_info_file.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "panvo/conversions/camera_info.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace panvo::camera_stream {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

class CameraInfoFile : public ::testing::Test {
 protected:
  /// Writes the example's left camera file with one text replaced.
  fs::path example_with(const std::string& text, const std::string& other) const {
    std::ifstream example(fs::path(PANVO_RIGS) / "example" / "left.yaml");
    std::string content{std::istreambuf_iterator<char>(example), {}};
    const auto position = content.find(text);
    EXPECT_NE(position, std::string::npos) << text;
    content.replace(position, text.size(), other);
    return folder_.write("left.yaml", content);
  }
  std::string error_of(const fs::path& file) const {
    try {
      read_camera_info(file);
    } catch (const calibration_files::FileError& error) {
      return error.what();
    }
    return "accepted";
  }

  const panvo::test::TemporaryFolder folder_;
  const fs::path path_ = folder_ / "left.yaml";
};

TEST_F(CameraInfoFile, IsReadWhole) {
  const auto info = read_camera_info(fs::path(PANVO_RIGS) / "example" / "right.yaml");
  EXPECT_EQ(info.width(), 640u);
  EXPECT_EQ(info.height(), 480u);
  EXPECT_EQ(info.distortion_model(), "plumb_bob");
  EXPECT_THAT(info.d(), ElementsAre(-0.08, 0.06, 0.0005, -0.0003, 0.0));
  EXPECT_EQ(info.k()[2], 319.5);
  EXPECT_EQ(info.r()[8], 1.0);
  EXPECT_EQ(info.p()[3], -60.0);
  EXPECT_TRUE(conversions::to_camera(info)) << "the other components can use it";
}

TEST_F(CameraInfoFile, IsTakenOfAnyLensModel) {
  const auto info = read_camera_info(example_with("plumb_bob", "equidistant"));
  EXPECT_EQ(info.distortion_model(), "equidistant");
}

TEST_F(CameraInfoFile, NamesFileLineAndKeyOfWhatIsWrong) {
  EXPECT_THAT(error_of("nowhere.yaml"), AllOf(HasSubstr("nowhere.yaml"), HasSubstr("cannot be opened")));
  EXPECT_THAT(error_of(example_with("image_width: 640", "image_width: wide")),
              AllOf(HasSubstr(path_.string() + ":2: "), HasSubstr("image_width must be a whole number")));
  EXPECT_THAT(error_of(example_with("image_width: 640", "image_width: 0")),
              HasSubstr("image_width must be a whole number from 1"));
  EXPECT_THAT(error_of(example_with("image_height", "height")), HasSubstr("image_height is missing"));
  EXPECT_THAT(error_of(example_with("data: [525.0, 0.0", "data: [525.0")),
              AllOf(HasSubstr(":6: "), HasSubstr("camera_matrix must be a list of 9 numbers, not of 8")));
  EXPECT_THAT(error_of(example_with("[525.0, 0.0", "[.nan, 0.0")),
              HasSubstr("camera_matrix must be a list of 9 numbers from -1e+08 to 1e+08, not nan"));
  EXPECT_THAT(error_of(example_with("projection_matrix", "projection")), HasSubstr("projection_matrix is missing"));
  EXPECT_THAT(error_of(example_with("[525.0, 0.0", "[0.0, 0.0")), HasSubstr("focal length"));
  EXPECT_THAT(error_of(example_with("rows: 3", "rows: [3")), HasSubstr("is not YAML"));
}

TEST_F(CameraInfoFile, IsComparedWithTheSizeOfTheImages) {
  const auto info = read_camera_info(fs::path(PANVO_RIGS) / "example" / "left.yaml");
  EXPECT_EQ(size_problem(info, 640, 480), "");
  EXPECT_THAT(size_problem(info, 1280, 960),
              AllOf(HasSubstr("640 x 480"), HasSubstr("1280 x 960"), HasSubstr("calibrate")));
  EXPECT_NE(size_problem(info, 640, 400), "");
}

}  // namespace
}  // namespace panvo::camera_stream
