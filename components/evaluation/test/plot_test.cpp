// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/plot.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "../src/gnuplot.hpp"
#include "../src/plot_axes.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "reports.hpp"

namespace panvo::evaluation {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

bool gnuplot_is_installed() { return std::system("command -v gnuplot > /dev/null 2>&1") == 0; }

std::string start_of(const std::filesystem::path& file, std::size_t count) {
  std::string text(count, '\0');
  std::ifstream(file, std::ios::binary).read(text.data(), static_cast<std::streamsize>(count));
  return text;
}

class Plot : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!gnuplot_is_installed()) GTEST_SKIP() << "gnuplot is not installed: apt-get install gnuplot-nox";
  }

  panvo::test::TemporaryFolder folder_;
};

TEST_F(Plot, IsDrawnAsPngAndSvg) {
  draw_plot(small_report(), folder_.path());
  EXPECT_EQ(start_of(folder_ / "evaluation.png", 8), "\x89PNG\r\n\x1a\n");
  EXPECT_THAT(start_of(folder_ / "evaluation.svg", 400), HasSubstr("<svg"));
  EXPECT_GT(std::filesystem::file_size(folder_ / "evaluation.png"), 20000u);
}

TEST_F(Plot, IsDrawnOfAPathThatStaysInPlace) {
  draw_plot(still_report(), folder_.path());
  EXPECT_EQ(start_of(folder_ / "evaluation.png", 8), "\x89PNG\r\n\x1a\n");
}

TEST_F(Plot, RunsNothingThatATitleNameOrFolderSays) {
  const auto folder = folder_ / "it's `touch a` $(touch b); \"touch c\"";
  std::filesystem::create_directories(folder);
  const std::string evil = "'; system('touch d'); `touch e` $(touch f) \"@g\" \\\n!touch h\n%s {/Bold x} _y";
  draw_plot(small_report(evil, evil), folder);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    EXPECT_THAT(entry.path().filename().string(), ::testing::StartsWith("evaluation."));
    ++files;
  }
  EXPECT_EQ(files, 3u);
}

TEST_F(Plot, IsDrawnWithNamesInAnyBytes) {
  draw_plot(small_report("Gr\u00fc\u00dfe", "no \xff\xfe UTF-8"), folder_.path());
  EXPECT_EQ(start_of(folder_ / "evaluation.png", 8), "\x89PNG\r\n\x1a\n");
}

TEST_F(Plot, NamesTheRemedyIfGnuplotIsNotInstalled) {
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", folder_.path().c_str(), 1);
  std::string error;
  try {
    draw_plot(small_report(), folder_.path());
  } catch (const PlotError& e) {
    error = e.what();
  }
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_THAT(error, HasSubstr("gnuplot is not installed"));
  EXPECT_THAT(error, HasSubstr("apt-get install gnuplot-nox"));
}

TEST_F(Plot, SaysWhatGnuplotSaidIfItFails) {
  folder_.write("broken.gp", "plot sin(\n");
  EXPECT_THROW(
      try { run_gnuplot(folder_.path(), "broken.gp"); } catch (const PlotError& error) {
        EXPECT_THAT(error.what(), HasSubstr("line 1"));
        throw;
      },
      PlotError);
}

TEST(PlotScript, IsTheSameTextEachTime) { EXPECT_EQ(plot_script(small_report()), plot_script(small_report())); }

TEST(PlotScript, HoldsNoNumberThatIsNone) {
  for (const Report& report : {small_report(), still_report()}) {
    EXPECT_THAT(plot_script(report), Not(HasSubstr("nan")));
    EXPECT_THAT(plot_script(report), Not(HasSubstr("inf ")));
  }
}

TEST(PlotScript, ThinsOutALongPathAndKeepsItsEnd) {
  const Trajectory path = straight_line(40001, 0.1);
  const Report report{"long", path, {evaluate({"e", path, std::nullopt, {}, std::nullopt}, path)}};
  const std::string script = plot_script(report);
  EXPECT_LT(script.size(), 1'000'000u);
  EXPECT_THAT(script, HasSubstr("\n4000 4000 4000 0 0 "));
}

TEST(PlotScript, DrawsStereoAndEnhancedOdometryInTheColoursOfTheReport) {
  auto report = small_report();
  const auto any = report.evaluations.front();
  report.evaluations = {any, any, any};
  report.evaluations[0].name = "rival";
  report.evaluations[1].name = "odometry_binocular";
  report.evaluations[2].name = "odometry_enhanced";
  EXPECT_THAT(plot_script(report), HasSubstr("colour0 = '#009E73'\ncolour1 = '#D55E00'\ncolour2 = '#0072B2'\n"));
}

TEST(PlotScript, NamesTheEndsOfAClosedPathOnce) {
  const auto script_of = [](const Trajectory& path) {
    return plot_script({"drive", path, {evaluate({"e", path, std::nullopt, {}, std::nullopt}, path)}});
  };
  Trajectory path = straight_line(101);
  EXPECT_THAT(script_of(path), AllOf(HasSubstr(" 'start' "), HasSubstr(" 'end' ")));
  for (std::size_t i = 51; i < path.poses.size(); ++i)
    path.poses[i].world_from_base = path.poses[100 - i].world_from_base;
  EXPECT_THAT(script_of(path), AllOf(HasSubstr(" 'start, end' "), Not(HasSubstr(" 'end' "))));
}

TEST(GnuplotQuoted, LeavesNoQuoteAndNoControlCharacterInside) {
  EXPECT_EQ(gnuplot_quoted("'it's\n`x`"), "'\u2019it\u2019s `x`'");
}

TEST(EqualScale, MakesAMetreAsLongOnEitherAxisAndKeepsTheMargin) {
  const Box box{100, 50, 700, 450};
  for (const auto& [x, y] : {std::pair<Range, Range>{{0, 60}, {-3, 1}}, {{5, 6}, {0, 100}}, {{1, 1}, {2, 2}}}) {
    const PlanRanges ranges = equal_scale(x, y, box, 0.1);
    EXPECT_NEAR(ranges.x.size() / box.width(), ranges.y.size() / box.height(), 1e-12);
    EXPECT_LE(ranges.x.low + 0.0999 * ranges.x.size(), x.low);
    EXPECT_GE(ranges.y.high - 0.0999 * ranges.y.size(), y.high);
  }
}

TEST(RoundNumberBelow, IsOneTwoOrFiveTimesAPowerOfTen) {
  EXPECT_DOUBLE_EQ(round_number_below(19.9), 10.0);
  EXPECT_DOUBLE_EQ(round_number_below(20.0), 20.0);
  EXPECT_DOUBLE_EQ(round_number_below(0.07), 0.05);
  EXPECT_DOUBLE_EQ(round_number_below(999.0), 500.0);
}

}  // namespace
}  // namespace panvo::evaluation
