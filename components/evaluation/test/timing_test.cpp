// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/timing.hpp"

#include <gmock/gmock.h>

#include "panvo/test/temporary_folder.hpp"
#include "trajectories.hpp"

namespace panvo::evaluation {
namespace {

using ::testing::HasSubstr;

class TimingFile : public ::testing::Test {
 protected:
  static std::string times(double scale) {
    std::string text = "{";
    for (const char* key : {"mean", "median", "p95", "p99", "max"}) {
      text += std::string(text.size() > 1 ? "," : "") + "\"" + key + "\":" + std::to_string(scale += 1.0);
    }
    return text + "}";
  }
  static std::string stage(const std::string& wall) {
    return R"({"count":7,"wall_ms":)" + wall + R"(,"cpu_ms":)" + times(10) + "}";
  }

  panvo::test::TemporaryFolder folder_;
};

TEST_F(TimingFile, IsReadInItsOwnOrder) {
  const auto file = folder_.write("timing.json", R"({"components":{"vo":{"stages":{"match":)" + stage(times(0)) +
                                                     R"(,"detect":)" + stage(times(1)) + R"(}},"a":{"stages":{}}}})");
  const StageTimes result = read_timing(file);
  ASSERT_EQ(result.size(), 2u);
  EXPECT_EQ(result[0].component, "vo");
  EXPECT_EQ(result[0].stage, "match");
  EXPECT_EQ(result[0].count, 7);
  EXPECT_DOUBLE_EQ(result[0].wall.mean_ms, 1.0);
  EXPECT_DOUBLE_EQ(result[0].wall.p95_ms, 3.0);
  EXPECT_DOUBLE_EQ(result[0].cpu.max_ms, 15.0);
  EXPECT_EQ(result[1].stage, "detect");
}

TEST_F(TimingFile, NamesWhatIsWrong) {
  const auto error = [&](const std::string& text) {
    return input_error_of([&, file = folder_.write("timing.json", text)] { read_timing(file); });
  };
  EXPECT_THAT(error("{\"components\":"), HasSubstr("timing.json: is not valid JSON"));
  EXPECT_THAT(error("[]"), HasSubstr("no key 'components'"));
  EXPECT_THAT(error(R"({"components":{"vo":{}}})"), HasSubstr("no key 'stages' in 'components.vo'"));
  EXPECT_THAT(error(R"({"components":{"vo":{"stages":{"match":)" + stage(R"({"mean":"fast"})") + "}}}}"),
              HasSubstr("'components.vo.stages.match.wall_ms.mean' is not a number of milliseconds"));
}

}  // namespace
}  // namespace panvo::evaluation
