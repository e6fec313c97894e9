// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/sift.hpp"

#include <algorithm>
#include <opencv2/features2d.hpp>
#include <tuple>

namespace panvo::landmarks {
namespace {

constexpr int kSurplus = 2;  // detected per keypoint kept, so that every sector has a choice

/// Orders by descending strength, independent of the order of detection; ties by position in the image.
bool is_stronger(const cv::KeyPoint& a, const cv::KeyPoint& b) {
  if (a.response != b.response) return a.response > b.response;
  return std::tie(a.pt.y, a.pt.x, a.angle) < std::tie(b.pt.y, b.pt.x, b.angle);
}

/// Keypoints with several orientations become one.
void set_upright(std::vector<cv::KeyPoint>& keypoints) {
  for (auto& keypoint : keypoints) keypoint.angle = 0.0F;
  const auto place = [](const cv::KeyPoint& keypoint) {
    return std::tuple(keypoint.pt.x, keypoint.pt.y, keypoint.size);
  };
  std::sort(keypoints.begin(), keypoints.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
  const auto last = std::unique(keypoints.begin(), keypoints.end(),
                                [&](const auto& a, const auto& b) { return place(a) == place(b); });
  keypoints.erase(last, keypoints.end());
}

/// The strongest ones, with an equal share for each sector first.
std::vector<cv::KeyPoint> choose(std::vector<cv::KeyPoint> found, const SiftRule& rule,
                                 const std::function<std::optional<int>(const cv::KeyPoint&)>& sector_of) {
  std::erase_if(found, [&](const cv::KeyPoint& keypoint) { return !sector_of(keypoint); });
  std::sort(found.begin(), found.end(), is_stronger);
  const int share = (rule.most + rule.sectors - 1) / rule.sectors;
  std::vector<int> taken(static_cast<std::size_t>(rule.sectors), 0);
  std::vector<cv::KeyPoint> chosen, others;
  for (const auto& keypoint : found) {
    const int sector = std::clamp(*sector_of(keypoint), 0, rule.sectors - 1);
    (taken[static_cast<std::size_t>(sector)]++ < share ? chosen : others).push_back(keypoint);
  }
  chosen.insert(chosen.end(), others.begin(), others.end());
  if (chosen.size() > static_cast<std::size_t>(rule.most)) chosen.resize(static_cast<std::size_t>(rule.most));
  std::sort(chosen.begin(), chosen.end(), is_stronger);
  return chosen;
}

}  // namespace

std::vector<SiftFeature> detect_sift(const cv::Mat& image, const SiftRule& rule,
                                     const std::function<std::optional<int>(const cv::KeyPoint&)>& sector_of) {
  const auto sift = cv::SIFT::create(kSurplus * rule.most, 3, rule.min_contrast);
  std::vector<cv::KeyPoint> found;
  sift->detect(image, found);
  if (rule.upright) set_upright(found);
  // Computing descriptors costs more than repeating the blur, so only the chosen keypoints are described.
  auto chosen = choose(std::move(found), rule, sector_of);
  if (chosen.empty()) return {};
  cv::Mat descriptors;
  sift->compute(image, chosen, descriptors);
  std::vector<SiftFeature> features(chosen.size());
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    features[i].keypoint = chosen[i];
    const float* row = descriptors.ptr<float>(static_cast<int>(i));
    std::transform(row, row + 128, features[i].descriptor.begin(),
                   [](float value) { return cv::saturate_cast<uchar>(value); });
  }
  return features;
}

}  // namespace panvo::landmarks
