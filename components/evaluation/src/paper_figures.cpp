// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/paper_figures.hpp"

#include <array>

namespace panvo::evaluation::paper {
namespace {

constexpr std::array kTable2{
    Revisit{1, 1, "Corrected", "1-2-5-1", -8, 13.5, 1.5, 440},
    Revisit{2, 1, "Corrected", "1-7-8-9-1", -138, 23.9, 2.1, 592},
    Revisit{3, 7, "Corrected", "7-8-9-1-7", -50, 22.5, 3.5, 662},
    Revisit{4, 8, "Uncorrected", "8-9-1-14-8", 119, {}, {}, {}},
    Revisit{5, 7, "Corrected", "7-14-15-8-7", -107, 38.3, 4.4, 1082},
    Revisit{6, 14, "Corrected", "14-15-8-7-14", -62, 10.5, 4.2, 1223},
    Revisit{7, 15, "Corrected", "15-21-25-29-15", -168, 29.7, 5.3, 1570},
    Revisit{8, 14, "Given up", "14-21-25-29-14", {}, {}, {}, {}},
};

constexpr std::array kTable4{
    Revisit{1, 1, "Corrected", "", -16, 1.5, 1.5, 0},     Revisit{2, 7, "Corrected", "", -53, 4.9, 3.6, 73},
    Revisit{3, 32, "Corrected", "", -1, 29.3, 2.5, 386},  Revisit{4, 33, "Corrected", "", 7, 30.4, 3.8, 494},
    Revisit{5, 34, "Corrected", "", 8, 42.6, 2.0, 550},   Revisit{6, 35, "Corrected", "", -7, 38.9, 7.0, 753},
    Revisit{7, 22, "Corrected", "", 5, 41.4, 5.3, 862},   Revisit{8, 23, "Corrected", "", 14, 48.3, 9.8, 1091},
    Revisit{9, 24, "Corrected", "", 0, 56.5, 15.1, 1180}, Revisit{10, 8, "Miss", "", {}, {}, {}, {}},
    Revisit{11, 2, "Corrected", "", 12, 83.7, 4.2, 1672}, Revisit{12, 3, "Corrected", "", 2, 80.8, 4.5, 1687},
    Revisit{13, 4, "Corrected", "", 32, 85.4, 3.1, 1692}, Revisit{14, 5, "Corrected", "", -102, 108.2, 3.3, 1724},
};

using Names = std::string_view;
constexpr std::array<Names, 1> kJunction{"junction"};
constexpr std::array<Names, 1> kDescribe{"describe"};
constexpr std::array<Names, 1> kKeypointStages{"keypoints"};
constexpr std::array<Names, 1> kHistogram{"histogram"};
constexpr std::array<Names, 1> kLarge{"large_scale"};
constexpr std::array<Names, 1> kSmall{"small_scale"};
constexpr std::array<Names, 3> kMatching{"keypoints", "sift_matching", "match_keypoints"};
constexpr std::array<Names, 4> kMotion{"verify", "five_point", "ransac", "correct"};
constexpr std::array<Names, 2> kCompass{"compass", "panorama/image"};
constexpr std::array<Names, 2> kOdometry{"stereo/left/image_rect, stereo/right/image_rect", "motion"};

constexpr std::array kTable3{
    Stage{"Building landmarks online", "Landmark detection", 70, "landmark_builder", kJunction},
    Stage{"Building landmarks online", "Multi-level feature", 80, "landmark_builder", kDescribe},
    Stage{"Building landmarks online", "SIFT", 40, "landmark_builder", kKeypointStages},
    Stage{"Global position correction", "Matching, h", 3, "position_corrector", kHistogram},
    Stage{"Global position correction", "Matching, f_l", 8, "position_corrector", kLarge},
    Stage{"Global position correction", "Matching, f_s", 7, "position_corrector", kSmall},
    Stage{"Global position correction", "SIFT matching", 50, "position_corrector", kMatching},
    Stage{"Global position correction", "Five-point RanSaC", 100, "position_corrector", kMotion},
    Stage{"Visual odometry", "Panoramic compass", 100, "panoramic_compass", kCompass},
    Stage{"Visual odometry", "Binocular VO", 35, "binocular_odometry", kOdometry},
};

}  // namespace

std::span<const Revisit> table_2() { return kTable2; }
std::span<const Revisit> table_4() { return kTable4; }
std::span<const Stage> table_3() { return kTable3; }

}  // namespace panvo::evaluation::paper
