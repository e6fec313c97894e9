// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/brief_gist.hpp"

#include "brief_pattern.hpp"

namespace panvo::evaluation {
namespace {

constexpr int kTiles = 7;  // the band is 1080x150: at a height of 60 px, seven tiles wide

struct Tiles final : PlaceDescriptor {
  std::array<BriefPattern::Bits, kTiles> bits;
};

class BriefGist final : public PlaceMethod {
 public:
  explicit BriefGist(std::uint64_t seed) : pattern_(seed) {}

  std::string name() const override { return "BRIEF-Gist"; }

  std::unique_ptr<PlaceDescriptor> describe_landmark(const cv::Mat& panorama) const override {
    const cv::Mat smoothed = smoothed_band(panorama, kTiles * BriefPattern::kPatch_px);
    auto tiles = std::make_unique<Tiles>();
    for (int i = 0; i < kTiles; ++i) {
      tiles->bits[static_cast<std::size_t>(i)] = pattern_.describe(smoothed, i * BriefPattern::kPatch_px);
    }
    return tiles;
  }

  PlaceDistance distance(const PlaceDescriptor& query, const PlaceDescriptor& landmark) const override {
    const auto& a = static_cast<const Tiles&>(query).bits;
    const auto& b = static_cast<const Tiles&>(landmark).bits;
    int different = 0;
    for (std::size_t i = 0; i < a.size(); ++i) different += hamming_distance(a[i], b[i]);
    return {static_cast<double>(different) / (kTiles * BriefPattern::kBits), 0.0};
  }

 private:
  BriefPattern pattern_;
};

}  // namespace

std::unique_ptr<PlaceMethod> brief_gist(std::uint64_t seed) { return std::make_unique<BriefGist>(seed); }

}  // namespace panvo::evaluation
