// SPDX-License-Identifier: Apache-2.0
#include "charuco.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <opencv2/core/version.hpp>
#include <string_view>

#if CV_VERSION_MAJOR > 4 || (CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR >= 7)
#define PANVO_ARUCO_IN_OBJDETECT
#include <opencv2/objdetect/charuco_detector.hpp>
#else
#include <opencv2/aruco/charuco.hpp>
#endif

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

/// Throws CalibrationError.
int dictionary_of(const Board& board) {
  const auto* const found = std::find(kDictionaries.begin(), kDictionaries.end(), board.dictionary);
  if (found == kDictionaries.end())
    throw CalibrationError(
        fmt::format("board '{}': unknown dictionary '{}'; use one of OpenCV's, DICT_4X4_50 to "
                    "DICT_7X7_1000, DICT_ARUCO_ORIGINAL or DICT_APRILTAG_36h11",
                    to_string(board), board.dictionary));
  return static_cast<int>(found - kDictionaries.begin());
}

/// Throws CalibrationError.
void require_markers(const Board& board, int there_are) {
  const int markers = (board.columns + 1) * (board.rows + 1) / 2;
  if (markers > there_are)
    throw CalibrationError(fmt::format("board '{}': it has {} markers, but {} has only {}; use a larger dictionary",
                                       to_string(board), markers, board.dictionary, there_are));
}

cv::Mat bits_of(const cv::aruco::Dictionary& dictionary, int id) {
  return cv::aruco::Dictionary::getBitsFromByteList(dictionary.bytesList.rowRange(id, id + 1), dictionary.markerSize);
}

#ifdef PANVO_ARUCO_IN_OBJDETECT
cv::aruco::CharucoBoard charuco_board(const Board& board) {
  const auto dictionary = cv::aruco::getPredefinedDictionary(dictionary_of(board));
  require_markers(board, dictionary.bytesList.rows);
  return {{board.columns + 1, board.rows + 1},
          static_cast<float>(board.square_m),
          static_cast<float>(board.marker_m),
          dictionary};
}
#else
cv::Ptr<cv::aruco::CharucoBoard> charuco_board(const Board& board) {
  const auto name = static_cast<cv::aruco::PREDEFINED_DICTIONARY_NAME>(dictionary_of(board));
  const auto dictionary = cv::aruco::getPredefinedDictionary(name);
  require_markers(board, dictionary->bytesList.rows);
  return cv::aruco::CharucoBoard::create(board.columns + 1, board.rows + 1, static_cast<float>(board.square_m),
                                         static_cast<float>(board.marker_m), dictionary);
}
#endif

}  // namespace

CharucoDetector::~CharucoDetector() = default;

#ifdef PANVO_ARUCO_IN_OBJDETECT

std::vector<CharucoMarker> charuco_markers(const Board& board) {
  const auto charuco = charuco_board(board);
  std::vector<CharucoMarker> markers;
  for (std::size_t i = 0; i < charuco.getIds().size(); ++i)
    markers.push_back({charuco.getObjPoints()[i], bits_of(charuco.getDictionary(), charuco.getIds()[i])});
  return markers;
}

struct CharucoDetector::OpenCv {
  cv::aruco::CharucoDetector detector;
};

CharucoDetector::CharucoDetector(const Board& board)
    : opencv_(std::make_unique<OpenCv>(cv::aruco::CharucoDetector(charuco_board(board)))) {}

CharucoDetector::Found CharucoDetector::detect(const cv::Mat& grey) const {
  Found found;
  std::vector<std::vector<cv::Point2f>> markers;
  std::vector<int> marker_ids;
  opencv_->detector.detectBoard(grey, found.corners, found.ids, markers, marker_ids);
  found.markers = marker_ids.size();
  return found;
}

#else

std::vector<CharucoMarker> charuco_markers(const Board& board) {
  const auto charuco = charuco_board(board);
  std::vector<CharucoMarker> markers;
  for (std::size_t i = 0; i < charuco->ids.size(); ++i)
    markers.push_back({charuco->objPoints[i], bits_of(*charuco->dictionary, charuco->ids[i])});
  return markers;
}

struct CharucoDetector::OpenCv {
  cv::Ptr<cv::aruco::CharucoBoard> board;
  cv::Ptr<cv::aruco::DetectorParameters> parameters = cv::aruco::DetectorParameters::create();
};

CharucoDetector::CharucoDetector(const Board& board) : opencv_(std::make_unique<OpenCv>()) {
  opencv_->board = charuco_board(board);
}

CharucoDetector::Found CharucoDetector::detect(const cv::Mat& grey) const {
  Found found;
  std::vector<std::vector<cv::Point2f>> markers;
  std::vector<int> marker_ids;
  cv::aruco::detectMarkers(grey, opencv_->board->dictionary, markers, marker_ids, opencv_->parameters);
  found.markers = marker_ids.size();
  if (!marker_ids.empty())
    cv::aruco::interpolateCornersCharuco(markers, marker_ids, grey, opencv_->board, found.corners, found.ids);
  return found;
}

#endif

}  // namespace panvo::calibration
