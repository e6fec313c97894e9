// SPDX-License-Identifier: Apache-2.0
#include "charuco.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "panvo/calibration/calibration_error.hpp"

namespace panvo::calibration {
namespace {

/// In the order of OpenCV's PREDEFINED_DICTIONARY_NAME.
constexpr std::array<std::string_view, 21> kDictionaries{
    "DICT_4X4_50",        "DICT_4X4_100",        "DICT_4X4_250",       "DICT_4X4_1000",      "DICT_5X5_50",
    "DICT_5X5_100",       "DICT_5X5_250",        "DICT_5X5_1000",      "DICT_6X6_50",        "DICT_6X6_100",
    "DICT_6X6_250",       "DICT_6X6_1000",       "DICT_7X7_50",        "DICT_7X7_100",       "DICT_7X7_250",
    "DICT_7X7_1000",      "DICT_ARUCO_ORIGINAL", "DICT_APRILTAG_16h5", "DICT_APRILTAG_25h9", "DICT_APRILTAG_36h10",
    "DICT_APRILTAG_36h11"};

}  // namespace

cv::Ptr<cv::aruco::CharucoBoard> charuco_board(const Board& board) {
  const auto* const found = std::find(kDictionaries.begin(), kDictionaries.end(), board.dictionary);
  if (found == kDictionaries.end())
    throw CalibrationError(
        fmt::format("board '{}': unknown dictionary '{}'; use one of OpenCV's, DICT_4X4_50 to "
                    "DICT_7X7_1000, DICT_ARUCO_ORIGINAL or DICT_APRILTAG_36h11",
                    to_string(board), board.dictionary));
  const auto name = static_cast<cv::aruco::PREDEFINED_DICTIONARY_NAME>(found - kDictionaries.begin());
  const auto dictionary = cv::aruco::getPredefinedDictionary(name);
  const int markers = (board.columns + 1) * (board.rows + 1) / 2;
  if (markers > dictionary->bytesList.rows)
    throw CalibrationError(fmt::format("board '{}': it has {} markers, but {} has only {}; use a larger dictionary",
                                       to_string(board), markers, board.dictionary, dictionary->bytesList.rows));
  return cv::aruco::CharucoBoard::create(board.columns + 1, board.rows + 1, static_cast<float>(board.square_m),
                                         static_cast<float>(board.marker_m), dictionary);
}

}  // namespace panvo::calibration
