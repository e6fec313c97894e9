// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration/report.hpp"

#include <gmock/gmock.h>

#include "panvo/calibration/rectified_pair.hpp"
#include "simulated_boards.hpp"

namespace panvo::calibration {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using vision::LensModel;

const Board kCharuco = parse_board("charuco:10x7:0.04:0.03");

Report report_of(int boards, double widest_off_deg, double noise_px) {
  const auto truth = test::stereo_pair(test::plumb_bob());
  Report report;
  report.title = "Calibration <test>";
  report.board = kCharuco;
  report.seen =
      test::observe(kCharuco, truth, test::hold_boards(kCharuco, truth, boards, widest_off_deg, 0.5, 3), noise_px, 4);
  report.calibration =
      calibrate(report.seen, {{LensModel::kPlumbBob, LensModel::kPlumbBob}, {std::nullopt, std::nullopt}});
  const auto& cameras = report.calibration.rig.cameras;
  report.pair = rectify(cameras[0], cameras[1]);
  report.epipolar = epipolar_errors(report.calibration.used, cameras[0].lens, cameras[1].lens, *report.pair);
  return report;
}

TEST(Report, HasNoDoubtsAboutAGoodCalibration) {
  const auto report = report_of(30, 38.0, 0.05);
  EXPECT_THAT(doubts(report), IsEmpty());
  EXPECT_THAT(to_page(report), HasSubstr("No problems found"));
  EXPECT_THAT(to_text(report), Not(HasSubstr("warning")));
}

TEST(Report, DoubtsFewImagesInTheMiddleThatAreNoisy) {
  const auto found = doubts(report_of(8, 8.0, 0.9));
  EXPECT_THAT(found, Contains(AllOf(HasSubstr("camera_0"), HasSubstr("only 8 images"))));
  EXPECT_THAT(found, Contains(AllOf(HasSubstr("camera_1"), HasSubstr("cover"), HasSubstr("borders"))));
  EXPECT_THAT(found, Contains(AllOf(HasSubstr("px off"), HasSubstr("--model"))));
  EXPECT_THAT(found, Contains(AllOf(HasSubstr("focal length has a standard deviation of"), HasSubstr("tilt"))));
  EXPECT_THAT(found, Contains(AllOf(HasSubstr("rows of the rectified images"), HasSubstr("same moment"))));
}

TEST(Report, ListsWhatIsNotUsedWithTheReason) {
  auto report = report_of(20, 20.0, 0.05);
  report.seen.views[0].missing = {"cannot be read as an image", ""};
  report.calibration.rejections.push_back({1, 2, "its corners are 3.00 px off"});
  for (const auto& text : {to_text(report), to_page(report)})
    EXPECT_THAT(text, AllOf(HasSubstr("view_0"), HasSubstr("cannot be read as an image"), HasSubstr("view_2"),
                            HasSubstr("3.00 px off")));
}

TEST(Report, TellsParametersWithTheirDeviations) {
  auto report = report_of(20, 20.0, 0.05);
  EXPECT_THAT(to_text(report), AllOf(HasSubstr("fx"), HasSubstr("k3"), HasSubstr("std. deviation"),
                                     HasSubstr("epipolar residual: rms"), HasSubstr("baseline 0.12")));
  report.calibration.sigmas.reset();
  EXPECT_THAT(to_text(report), AllOf(HasSubstr("not determined"), HasSubstr("warning: the images do not determine")));
}

TEST(Report, DrawsEveryCornerAndEscapesNames) {
  const auto report = report_of(10, 20.0, 0.05);
  const auto count = [](const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
  };
  std::size_t corners = 0;
  for (const auto& residual : report.calibration.residuals) corners += residual.camera == 1 ? 1 : 0;
  EXPECT_EQ(count(coverage_svg(report, 1), "<circle"), corners);
  EXPECT_EQ(count(residual_svg(report, 1), "<circle"), corners);
  EXPECT_EQ(count(residual_svg(report, 1), "<title>view_"), report.calibration.used.views.size());
  EXPECT_THAT(to_page(report), AllOf(HasSubstr("Calibration &lt;test>"), Not(HasSubstr("<test>"))));
}

}  // namespace
}  // namespace panvo::calibration
