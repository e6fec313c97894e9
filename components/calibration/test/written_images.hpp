// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "panvo/test/temporary_folder.hpp"
#include "rendered_board.hpp"
#include "simulated_boards.hpp"

namespace panvo::calibration::test {

struct Outcome {
  int status = -1;
  std::string out;
  std::string err;
};

/// Fixture that runs the command in a temporary folder.
class CommandTest : public ::testing::Test {
 protected:
  /// Renders the boards for each camera to IMAGES/NAME/000.png etc.; skips boards outside the camera's view.
  void photograph(const std::string& images, const Board& board, const std::vector<std::string>& names,
                  const std::vector<RigCamera>& cameras,
                  const std::vector<Eigen::Isometry3d>& reference_from_board) const {
    for (std::size_t camera = 0; camera < cameras.size(); ++camera) {
      const BoardRenderer renderer(board, cameras[camera].lens);
      const vision::CameraModel model(cameras[camera].lens);
      const auto place = folder_ / images / names[camera];
      std::filesystem::create_directories(place);
      for (std::size_t view = 0; view < reference_from_board.size(); ++view) {
        const Eigen::Isometry3d pose = cameras[camera].camera_from_reference * reference_from_board[view];
        const auto middle = model.project(pose * (0.5 * (board.point(0) + board.point(board.corners() - 1))));
        if (!middle || !cameras[camera].lens.pinhole.contains(*middle, -100.0)) continue;
        cv::imwrite((place / fmt::format("{:03}.png", view)).string(),
                    renderer.render(pose, static_cast<unsigned>(100 * view + camera)));
      }
    }
  }

  Outcome call(const std::string& arguments) const {
    const std::string command = "cd '" + folder_.path().string() + "' && " PANVO_CALIBRATE " " + arguments +
                                " > out.txt 2> err.txt < /dev/null";
    const int status = std::system(command.c_str());
    return {WEXITSTATUS(status), folder_.read("out.txt"), folder_.read("err.txt")};
  }

  panvo::test::TemporaryFolder folder_;
};

inline void expect_same_focal_lengths(const vision::LensCamera& found, const vision::LensCamera& truth) {
  EXPECT_NEAR(found.pinhole.fx / truth.pinhole.fx, 1.0, 1e-3);
  EXPECT_NEAR(found.pinhole.fy / truth.pinhole.fy, 1.0, 1e-3);
  EXPECT_NEAR(found.pinhole.cx, truth.pinhole.cx, 1e-3 * truth.pinhole.width);
  EXPECT_NEAR(found.pinhole.cy, truth.pinhole.cy, 1e-3 * truth.pinhole.width);
}

inline void expect_same_pose(const Eigen::Isometry3d& found, const Eigen::Isometry3d& truth) {
  const Eigen::Isometry3d between = found.inverse() * truth;
  EXPECT_LT(between.translation().norm(), 1e-3);
  EXPECT_LT(vision::so3_log(between.linear()).norm(), 0.05 * kDegree);
}

}  // namespace panvo::calibration::test
