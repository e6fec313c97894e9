// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "panvo/dataset_player/dataset.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace panvo::dataset_player {
namespace fs = std::filesystem;
}

namespace panvo::dataset_player::testing {

/// Fixture with a temporary folder, initially empty, and functions that write small data sets of each layout.
class WrittenDataset : public ::testing::Test {
 protected:
  static constexpr int kWidth = 64, kHeight = 48;

  void write(const fs::path& name, const std::string& text) const {
    fs::create_directories((root_ / name).parent_path());
    std::ofstream(root_ / name) << text;
  }

  /// Writes an image with all pixels equal to `grey`.
  void write_image(const fs::path& name, int width = kWidth, int height = kHeight, int channels = 1,
                   int grey = 100) const {
    fs::create_directories((root_ / name).parent_path());
    const cv::Mat image(height, width, CV_8UC(channels), cv::Scalar::all(grey));
    ASSERT_TRUE(cv::imwrite((root_ / name).string(), image)) << name;
  }

  void write_kitti(int frames = 3) const {
    write("calib.txt",
          "P0: 50 0 32 0 0 50 24 0 0 0 1 0\n"
          "P1: 50 0 32 -10 0 50 24 0 0 0 1 0\n");
    for (int i = 0; i < frames; ++i) {
      const auto name = "00000" + std::to_string(i) + ".png";
      write_image(fs::path("image_0") / name);
      write_image(fs::path("image_1") / name);
    }
  }

  static std::string euroc_sensor(double x_m, double y_m, const std::string& model = "pinhole",
                                  const std::string& distortion = "[0, 0, 0, 0]") {
    // A camera that looks along +x of the body frame.
    return "#Default camera sensor yaml file\nsensor_type: camera\ncomment: VI-Sensor cam (MT9M034)\n\nT_BS:\n  cols: "
           "4\n  rows: 4\n  data: "
           "[0, 0, 1, " +
           std::to_string(x_m) + ",\n         -1, 0, 0, " + std::to_string(y_m) +
           ",\n         0, -1, 0, 1.5,\n         0, 0, 0, 1]\nrate_hz: 20\nresolution: [64, 48]\ncamera_model: " +
           model + "\nintrinsics: [50, 50, 32, 24]\ndistortion_model: radial-tangential\ndistortion_coefficients: " +
           distortion + "\n";
  }

  /// Stamps: 1 s + i * 50 ms; those of the right camera later by `right_delay_ns`.
  void write_euroc(int frames = 3, std::int64_t right_delay_ns = 0) const {
    write("mav0/cam0/sensor.yaml", euroc_sensor(2.0, 0.1));
    write("mav0/cam1/sensor.yaml", euroc_sensor(2.0, -0.1));
    for (const std::string camera : {"cam0", "cam1"}) {
      std::string list = "#timestamp [ns],filename\r\n";
      for (int i = 0; i < frames; ++i) {
        const auto stamp = std::to_string(1'000'000'000 + i * 50'000'000 + (camera == "cam1" ? right_delay_ns : 0));
        list += fmt::format("{0},{0}.png\r\n", stamp);
        write_image(fmt::format("mav0/{}/data/{}.png", camera, stamp));
      }
      write(fmt::format("mav0/{}/data.csv", camera), list);
    }
  }

  static std::string boofcv_camera(const std::string& element, double fx) {
    return "<" + element + "><cx>32</cx><cy>24</cy><fx>" + std::to_string(fx) +
           "</fx><fy>50</fy><height>48</height>\n<radial><double>-0.1</double>"
           "<double>0.02</double></radial><skew>0.0</skew><width>64</width></" +
           element + ">\n";
  }
  static std::string boofcv_calibration(double baseline_m = 0.12) {
    return "<boofcv.struct.calib.StereoParameters>\n" + boofcv_camera("left", 50) + boofcv_camera("right", 51) +
           "<rightToLeft><R><data><double>1</double><double>0</double><double>0</double><double>0</double><double>1</"
           "double>"
           "<double>0</double><double>0</double><double>0</double><double>1</double></data></R>\n<T><x>" +
           std::to_string(baseline_m) +
           "</x><y>0</y><z>0</z></T></rightToLeft>\n</boofcv.struct.calib.StereoParameters>\n";
  }

  void write_folders(int frames = 12, int channels = 3) const {
    write("stereo_params.xml", boofcv_calibration());
    for (int i = 1; i <= frames; ++i) {
      write_image("left/left" + std::to_string(i) + ".jpg", kWidth, kHeight, channels);
      write_image("right/right" + std::to_string(i) + ".jpg", kWidth, kHeight, channels);
    }
  }

  /// Message of the error of open_dataset(); fails the test if there is none.
  std::string error() const {
    try {
      open_dataset(root_);
    } catch (const DatasetError& problem) {
      return problem.what();
    }
    ADD_FAILURE() << "the data set was accepted";
    return {};
  }

  const panvo::test::TemporaryFolder folder_;
  fs::path root_ = folder_.path();  // of the data set
};

}  // namespace panvo::dataset_player::testing
