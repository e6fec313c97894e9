// SPDX-License-Identifier: Apache-2.0
#include "panvo/recorder/input_proposal.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include "panvo/interfaces/topics.hpp"
#include "panvo/recorder/bag_reader.hpp"

namespace panvo::recorder {
namespace {

constexpr std::string_view kCompressed = "/compressed";
/// How drivers name the cameras of a pair, most telling first.
constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kPairs{
    {{"left", "right"}, {"infra1", "infra2"}, {"cam0", "cam1"}, {"camera0", "camera1"}, {"0", "1"}, {"1", "2"}}};

/// Words of a topic name: "/zed/left/image_rect" has zed, left, image and rect. Lower case.
std::vector<std::string> words_of(const std::string& name) {
  std::vector<std::string> words(1);
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) {
      words.emplace_back();
    } else {
      words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
  }
  std::erase(words, "");
  return words;
}

bool has_any(const std::vector<std::string>& words, std::initializer_list<std::string_view> wanted) {
  return std::find_first_of(words.begin(), words.end(), wanted.begin(), wanted.end()) != words.end();
}

/// The name with one word replaced wherever it stands alone; empty if it does not contain the word.
std::string with_word(const std::string& name, std::string_view word, std::string_view instead) {
  const auto is_part = [&](std::size_t at) {
    return at < name.size() && std::isalnum(static_cast<unsigned char>(name[at])) != 0;
  };
  std::string result;
  bool is_found = false;
  for (std::size_t at = 0; at < name.size();) {
    const bool is_here =
        name.compare(at, word.size(), word) == 0 && !(at > 0 && is_part(at - 1)) && !is_part(at + word.size());
    result += is_here ? instead : std::string_view(name).substr(at, 1);
    at += is_here ? word.size() : 1;
    is_found = is_found || is_here;
  }
  return is_found ? result : std::string();
}

struct ImageTopic {
  std::string name;
  std::vector<std::string> words;
  bool is_compressed = false;
  std::uint64_t count = 0;

  bool is_rectified() const { return has_any(words, {"rect", "rectified"}); }
};

std::vector<ImageTopic> image_topics(const std::vector<BagTopic>& recorded) {
  std::vector<ImageTopic> images;
  for (const auto& topic : recorded) {
    const auto type = full_type_name(topic.type);
    const bool is_compressed = type == "sensor_msgs/msg/CompressedImage" && topic.name.ends_with(kCompressed);
    if ((type != "sensor_msgs/msg/Image" && !is_compressed) || topic.message_count == 0) continue;
    auto words = words_of(topic.name);
    if (has_any(words, {"depth", "disparity", "aligned", "mask", "confidence", "thermal", "segmentation"})) continue;
    ImageTopic image{topic.name, std::move(words), is_compressed, topic.message_count};
    // the rectifier, which reads decoded images, would rectify them again
    if (image.is_compressed && image.is_rectified()) continue;
    images.push_back(std::move(image));
  }
  return images;
}

struct Pair {
  ImageTopic left, right;
  std::size_t naming = 0;  ///< index into kPairs

  /// The smallest is the best: telling names, rectified, not compressed, grey, most images.
  auto rank() const {
    return std::tuple(naming, !left.is_rectified(), left.is_compressed,
                      !has_any(left.words, {"gray", "grey", "mono", "infra1"}), -static_cast<std::int64_t>(left.count),
                      left.name);
  }
};

std::optional<Pair> best_pair(const std::vector<ImageTopic>& images) {
  std::optional<Pair> best;
  for (const auto& left : images) {
    for (std::size_t naming = 0; naming < kPairs.size(); ++naming) {
      const auto partner = with_word(left.name, kPairs[naming].first, kPairs[naming].second);
      const auto right = std::find_if(images.begin(), images.end(), [&](const ImageTopic& image) {
        return image.name == partner && image.is_compressed == left.is_compressed;
      });
      if (right == images.end()) continue;
      const Pair pair{left, *right, naming};
      if (!best || pair.rank() < best->rank()) best = pair;
    }
  }
  return best;
}

std::optional<ImageTopic> best_panorama(const std::vector<ImageTopic>& images, bool is_compressed) {
  std::optional<ImageTopic> best;
  for (const auto& image : images) {
    if (!has_any(image.words, {"panorama", "pano", "panoramic", "equirectangular", "360", "theta", "thetav", "thetax",
                               "thetaz1", "insta360", "ladybug", "omni"}) ||
        has_any(image.words, {"fisheye", "dual", "head", "lens"})) {
      continue;
    }
    // the system's one switch for compressed images applies to all cameras
    const auto rank = [&](const ImageTopic& topic) {
      return std::tuple(topic.is_compressed != is_compressed, topic.name);
    };
    if (!best || rank(image) < rank(*best)) best = image;
  }
  return best;
}

void rename(InputProposal& proposal, const std::string& recorded, std::string_view topic) {
  const std::string read_as = std::string("/").append(topic);
  if (recorded != read_as) proposal.renames.push_back({recorded, read_as});
}

/// The camera_info beside an image; empty if the bag has none.
std::string camera_info_of(const std::vector<BagTopic>& recorded, const ImageTopic& image) {
  std::string name = image.name;
  if (image.is_compressed) name.resize(name.size() - kCompressed.size());
  name = name.substr(0, name.rfind('/')) + "/camera_info";
  const bool is_there = std::any_of(recorded.begin(), recorded.end(), [&](const BagTopic& topic) {
    return topic.name == name && full_type_name(topic.type) == "sensor_msgs/msg/CameraInfo" && topic.message_count > 0;
  });
  return is_there ? name : std::string();
}

}  // namespace

InputProposal propose_inputs(const std::vector<BagTopic>& recorded) {
  InputProposal proposal;
  const auto images = image_topics(recorded);
  const auto suffix = [](const ImageTopic& image) { return image.is_compressed ? kCompressed : std::string_view(); };
  const auto image_as = [&](const ImageTopic& image, std::string_view topic) {
    rename(proposal, image.name, std::string(topic).append(suffix(image)));
  };
  if (const auto pair = best_pair(images)) {
    proposal.has_stereo = true;
    proposal.is_compressed = pair->left.is_compressed;
    const bool is_rectified = pair->left.is_rectified();
    image_as(pair->left, is_rectified ? topics::kStereoLeftImageRect.name : topics::kStereoLeftImageRaw.name);
    image_as(pair->right, is_rectified ? topics::kStereoRightImageRect.name : topics::kStereoRightImageRaw.name);
    const auto left = camera_info_of(recorded, pair->left), right = camera_info_of(recorded, pair->right);
    proposal.has_camera_info = !left.empty() && !right.empty();
    if (proposal.has_camera_info) {
      rename(proposal, left, topics::kStereoLeftCameraInfo.name);
      rename(proposal, right, topics::kStereoRightCameraInfo.name);
    }
  }
  if (const auto panorama = best_panorama(images, proposal.is_compressed)) {
    proposal.has_panorama = true;
    image_as(*panorama, topics::kPanorama.name);
  }
  return proposal;
}

}  // namespace panvo::recorder
