// SPDX-License-Identifier: Apache-2.0
#include "panvo/panorama_stitcher/stitch_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "panvo/vision/packed_lookup.hpp"

namespace panvo::panorama_stitcher {
namespace {

constexpr int kTileColumns = 32, kTileRows = 32;
constexpr std::size_t kMaxSamples = 4000;
constexpr int kFraction = vision::kLookupFraction;

/// A position in a head's image in 1/32 px.
struct Place {
  std::uint8_t head = kNoHead;
  int x = 0, y = 0;

  int column() const { return x >> 5; }
  int row() const { return y >> 5; }
};

struct Choice {
  Place first, second;
  std::uint8_t weight = 0;  ///< of the second, in 1/256
};

class TableMaker {
 public:
  TableMaker(const PanoramaRig& rig, int columns, const std::vector<bool>& is_used)
      : rig_(rig), is_used_(is_used), panorama_{columns, columns / 2} {
    table_.columns = panorama_.columns;
    table_.rows = panorama_.rows;
  }

  StitchTable make() {
    for (int row = 0; row < panorama_.rows; row += kTileRows) {
      for (int column = 0; column < panorama_.columns; column += kTileColumns) add_tile(row, column);
    }
    finish_gap();
    thin_samples();
    return std::move(table_);
  }

 private:
  struct Seen {
    Place place;
    double margin_rad = -1.0;
  };

  void add_tile(int first_row, int first_column) {
    const int end_row = std::min(first_row + kTileRows, panorama_.rows);
    const int end_column = std::min(first_column + kTileColumns, panorama_.columns);
    for (int row = first_row; row < end_row; ++row) {
      choices_.clear();
      for (int column = first_column; column < end_column; ++column) choices_.push_back(choose(row, column));
      const auto destination_px = static_cast<std::uint32_t>(row * panorama_.columns + first_column);
      for (std::size_t begin = 0; begin < choices_.size();) begin = add_run(begin, destination_px);
    }
  }

  /// Selects the two heads that see a direction farthest from their borders, and the weight of the second.
  Choice choose(int row, int column) {
    const Eigen::Vector3d direction = panorama_.unproject({column, row});
    Seen first, second;
    for (std::size_t i = 0; i < rig_.heads.size(); ++i) {
      if (!is_used_[i]) continue;
      const auto view = rig_.heads[i].see(direction, rig_.radius_m);
      if (!view) continue;
      const Seen seen{{static_cast<std::uint8_t>(i), static_cast<int>(std::lround(view->pixel.x() * kFraction)),
                       static_cast<int>(std::lround(view->pixel.y() * kFraction))},
                      view->margin_rad};
      if (seen.margin_rad > first.margin_rad) {
        second = first;
        first = seen;
      } else if (seen.margin_rad > second.margin_rad) {
        second = seen;
      }
    }
    note_gap(row, column, first.place.head == kNoHead);
    const std::uint8_t weight = weight_of_second(first, second);
    const bool is_blended = weight > 0 && is_packable(first.place) && is_packable(second.place);
    return {first.place, is_blended ? second.place : Place{}, weight};
  }

  /// One half at the seam, falling to zero across the blended strip, whose width is blend_rad or less at a view's
  /// border.
  std::uint8_t weight_of_second(const Seen& first, const Seen& second) const {
    if (second.place.head == kNoHead) return 0;
    const double width_rad = std::min(rig_.blend_rad, first.margin_rad + second.margin_rad);
    if (!(width_rad > 0.0)) return 0;
    const double share = 0.5 * (1.0 - (first.margin_rad - second.margin_rad) / width_rad);
    return static_cast<std::uint8_t>(std::lround(256.0 * std::clamp(share, 0.0, 0.5)));
  }

  bool is_packable(const Place& place) const {
    const auto& size = rig_.heads[place.head].image_size_px;
    return vision::may_be_looked_up(place.column(), place.row(), size.width, size.height);
  }

  std::uint32_t offset_px(const Place& place) const {
    return static_cast<std::uint32_t>(place.row() * rig_.heads[place.head].image_size_px.width + place.column());
  }

  /// Adds the run that starts at choice `begin`. Returns the start of the next one.
  std::size_t add_run(std::size_t begin, std::uint32_t row_destination_px) {
    const auto& head = choices_[begin];
    StitchTable::Run run;
    run.destination_px = row_destination_px + static_cast<std::uint32_t>(begin);
    if (head.first.head != kNoHead && !is_packable(head.first)) {
      add_patch(run.destination_px, head.first);
      return begin + 1;
    }
    run.first = head.first.head;
    run.second = head.second.head;
    Extent first, second;
    std::size_t end = begin;
    for (; end < choices_.size(); ++end) {
      const auto& choice = choices_[end];
      if (choice.first.head != run.first || choice.second.head != run.second) break;
      if (run.first == kNoHead) continue;
      if (!is_packable(choice.first) || !first.take(offset_px(choice.first))) break;
      if (run.second != kNoHead && !second.take(offset_px(choice.second))) break;
    }
    run.count = static_cast<std::uint32_t>(end - begin);
    run.first_base_px = first.low;
    run.second_base_px = second.low;
    run.lookups = static_cast<std::uint32_t>(table_.lookups.size());
    run.weights = static_cast<std::uint32_t>(table_.weights.size());
    if (run.first != kNoHead) add_lookups(begin, end, run);
    table_.runs.push_back(run);
    return end;
  }

  /// Range of the offsets of a run; take() refuses an offset that does not fit into look-ups relative to the lowest.
  struct Extent {
    std::uint32_t low = 0, high = 0;
    bool is_empty = true;

    bool take(std::uint32_t offset_px) {
      const std::uint32_t new_low = is_empty ? offset_px : std::min(low, offset_px);
      const std::uint32_t new_high = is_empty ? offset_px : std::max(high, offset_px);
      if (new_high - new_low > vision::kMaxLookupOffset) return false;
      low = new_low;
      high = new_high;
      is_empty = false;
      return true;
    }
  };

  void add_lookups(std::size_t begin, std::size_t end, const StitchTable::Run& run) {
    const auto add = [&](const Place& place, std::uint32_t base_px) {
      table_.lookups.push_back(vision::pack_lookup(offset_px(place) - base_px, static_cast<std::uint32_t>(place.x & 31),
                                                   static_cast<std::uint32_t>(place.y & 31)));
    };
    for (std::size_t i = begin; i < end; ++i) add(choices_[i].first, run.first_base_px);
    if (run.second == kNoHead) return;
    for (std::size_t i = begin; i < end; ++i) {
      add(choices_[i].second, run.second_base_px);
      table_.weights.push_back(choices_[i].weight);
      table_.samples.push_back({run.first, run.second, offset_px(choices_[i].first), offset_px(choices_[i].second)});
    }
  }

  void add_patch(std::uint32_t destination_px, const Place& place) {
    const auto& head = rig_.heads[place.head];
    const auto& size = head.image_size_px;
    const auto& region = head.region_px;
    const bool closes = std::holds_alternative<vision::Equirectangular>(head.lens);
    const auto column = [&](int x) {
      if (closes) return region.x + ((x - region.x) % region.width + region.width) % region.width;
      return std::clamp(x, region.x, region.x + region.width - 1);
    };
    const auto row = [&](int y) { return std::clamp(y, region.y, region.y + region.height - 1); };
    StitchTable::Patch patch{destination_px,
                             place.head,
                             static_cast<std::uint8_t>(place.x & 31),
                             static_cast<std::uint8_t>(place.y & 31),
                             {}};
    for (int i = 0; i < 4; ++i) {
      patch.neighbours_px[static_cast<std::size_t>(i)] =
          static_cast<std::uint32_t>(row(place.row() + i / 2) * size.width + column(place.column() + i % 2));
    }
    table_.patches.push_back(patch);
  }

  void note_gap(int row, int column, bool is_unseen) {
    const double elevation_rad = panorama_.elevation_rad(row);
    if (elevation_rad < rig_.highest_rad || elevation_rad > rig_.lowest_rad) return;
    const double solid_angle = std::cos(elevation_rad);
    wanted_ += solid_angle;
    if (!is_unseen) return;
    unseen_ += solid_angle;
    if (std::abs(elevation_rad) < std::abs(gap_.elevation_rad)) {
      gap_.elevation_rad = elevation_rad;
      gap_.azimuth_rad = panorama_.azimuth_rad(column);
    }
  }

  void finish_gap() {
    if (unseen_ == 0.0) return;
    gap_.share = unseen_ / wanted_;
    table_.gap = gap_;
  }

  /// Thins evenly, so that each pair of heads keeps its share.
  void thin_samples() {
    const std::size_t step = table_.samples.size() / kMaxSamples + 1;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < table_.samples.size(); i += step) table_.samples[kept++] = table_.samples[i];
    table_.samples.resize(kept);
  }

  const PanoramaRig& rig_;
  const std::vector<bool>& is_used_;
  vision::Equirectangular panorama_;
  StitchTable table_;
  std::vector<Choice> choices_;  ///< of one row of a tile
  double wanted_ = 0.0, unseen_ = 0.0;
  StitchTable::Gap gap_{0.0, 0.0, std::numeric_limits<double>::infinity()};
};

}  // namespace

StitchTable make_stitch_table(const PanoramaRig& rig, int columns, const std::vector<bool>& is_used) {
  return TableMaker(rig, columns, is_used).make();
}

}  // namespace panvo::panorama_stitcher
