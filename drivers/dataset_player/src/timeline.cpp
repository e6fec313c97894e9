// SPDX-License-Identifier: Apache-2.0
#include "panvo/dataset_player/timeline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace panvo::dataset_player {
namespace {

/// Appends the events of `all` from the last one at or before the first image to the first one at or after the last.
template <class Item>
void append_around(std::vector<TimelineEvent>& events, const std::vector<Item>& all, TimelineEvent::Kind kind,
                   const std::vector<TimelineEvent>& images) {
  const auto stamp_before = [](const Item& item, std::int64_t stamp_ns) { return item.stamp_ns < stamp_ns; };
  const auto stamp_after = [](std::int64_t stamp_ns, const Item& item) { return stamp_ns < item.stamp_ns; };
  auto first = std::upper_bound(all.begin(), all.end(), images.front().stamp_ns, stamp_after);
  if (first != all.begin()) --first;
  auto last = std::lower_bound(all.begin(), all.end(), images.back().stamp_ns, stamp_before);
  if (last != all.end()) ++last;
  for (auto item = first; item < last; ++item) {
    events.push_back({item->stamp_ns, kind, static_cast<std::size_t>(item - all.begin())});
  }
}

}  // namespace

std::vector<TimelineEvent> timeline(const Dataset& dataset, const Selection& selection) {
  std::vector<TimelineEvent> images;
  if (dataset.stereo && selection.stereo) {
    const auto& frames = dataset.stereo->frames;
    for (std::size_t i = 0; i < frames.size(); ++i)
      images.push_back({frames[i].stamp_ns, TimelineEvent::Kind::kStereo, i});
  }
  if (dataset.panorama && selection.panorama) {
    const auto& frames = dataset.panorama->frames;
    for (std::size_t i = 0; i < frames.size(); ++i)
      images.push_back({frames[i].stamp_ns, TimelineEvent::Kind::kPanorama, i});
  }
  const auto earlier = [](const TimelineEvent& a, const TimelineEvent& b) {
    return std::tie(a.stamp_ns, a.kind) < std::tie(b.stamp_ns, b.kind);
  };
  std::sort(images.begin(), images.end(), earlier);
  if (images.empty()) {
    throw DatasetError(
        fmt::format("{}: has no images of the selected cameras (parameter cameras)", dataset.directory.string()));
  }

  const auto length_ns = images.back().stamp_ns - images.front().stamp_ns;
  const auto begin_ns = images.front().stamp_ns + std::llround(selection.start_s * 1e9);
  const auto end_ns =
      selection.duration_s > 0.0 ? begin_ns + std::llround(selection.duration_s * 1e9) : images.back().stamp_ns;
  std::erase_if(images,
                [&](const TimelineEvent& event) { return event.stamp_ns < begin_ns || event.stamp_ns > end_ns; });
  if (images.empty()) {
    throw DatasetError(
        fmt::format("{}: has no images between start_s = {} and the end of the selected part; the recording lasts {} s",
                    dataset.directory.string(), selection.start_s, static_cast<double>(length_ns) * 1e-9));
  }

  std::vector<TimelineEvent> events;
  append_around(events, dataset.ground_truth, TimelineEvent::Kind::kGroundTruth, images);
  if (dataset.imu) append_around(events, dataset.imu->samples, TimelineEvent::Kind::kImu, images);
  std::sort(events.begin(), events.end(), earlier);
  std::vector<TimelineEvent> merged(events.size() + images.size());
  std::merge(events.begin(), events.end(), images.begin(), images.end(), merged.begin(), earlier);
  return merged;
}

}  // namespace panvo::dataset_player
