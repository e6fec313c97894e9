// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <string_view>

#include "../shapes.hpp"
#include "hall_parts.hpp"

namespace panvo::simulated_world {
namespace {

using Eigen::Vector3f;

/// Builds on one plot, in its frame: x along the aisle, to the right as seen from it; y away from it, 0 at the front.
class HallPlot {
 public:
  HallPlot(const Site& site, const PlannedPlot& planned, const Random& random)
      : site_(site), random_(random), size_(planned.plot.size.cast<float>()) {
    const auto heading = static_cast<float>(planned.plot.heading_rad);
    const auto x = static_cast<float>(planned.plot.centre.x()), y = static_cast<float>(planned.plot.centre.y());
    world_from_plot_ = Eigen::Translation3f(x, y, 0.0f) * Eigen::AngleAxisf(heading, Vector3f::UnitZ());
  }

  Mesh take() {
    Mesh moved;
    moved.append(mesh_, world_from_plot_);
    return moved;
  }

  /// Pairs of shelves, back to back, with an aisle of 3 m between pairs.
  void add_shelves() {
    constexpr float kBay_m = 2.7f, kPairs_m = 5.2f;
    const int bays = static_cast<int>(size_.x() / kBay_m);
    std::uint64_t number = 0;
    for (float front = 0.0f; front + kShelf_m < size_.y(); front += kPairs_m) {
      for (const float y : {front, front + kShelf_m}) {
        if (y + kShelf_m > size_.y()) continue;
        for (int bay = 0; bay < bays; ++bay) {
          const float x = (static_cast<float>(bay) - 0.5f * static_cast<float>(bays)) * kBay_m;
          add_bay(x, kBay_m, y, goods(++number), bay + 1 == bays);
        }
      }
    }
  }

  /// A box of panels: blank, or with a door, a window or a notice.
  void add_office() {
    constexpr float kHeight_m = 3.2f, kPanel_m = 2.4f;
    const Vector3f low(-0.5f * size_.x(), 0.0f, 0.0f), high(0.5f * size_.x(), size_.y(), kHeight_m);
    add(low, high, "plaster_white", grey(0.9f));
    add({low.x() - 0.05f, -0.05f, kHeight_m}, {high.x() + 0.05f, high.y() + 0.05f, kHeight_m + 0.2f}, "metal_painted",
        grey(0.7f));
    Random random = random_.part(1);
    for (float x = low.x(); x + kPanel_m < high.x(); x += kPanel_m) {
      add({x - 0.03f, -0.03f, 0.0f}, {x + 0.03f, 0.0f, kHeight_m}, "metal_painted", grey(0.5f));
      const double kind = random.uniform();
      if (kind < 0.35) {
        add({x + 0.35f, -0.04f, 1.0f}, {x + kPanel_m - 0.35f, 0.0f, 2.3f}, "window_frame", grey(0.8f));
        add({x + 0.42f, -0.05f, 1.07f}, {x + kPanel_m - 0.42f, 0.0f, 2.23f}, "glass");
      } else if (kind < 0.55) {
        const float shade = between(random, 0.4, 1.0);
        add({x + 0.6f, -0.05f, 0.0f}, {x + 1.55f, 0.0f, 2.1f}, "door_wood", grey(shade));
      } else if (kind < 0.7) {
        add({x + 0.5f, -0.02f, 1.2f}, {x + 1.5f, 0.0f, 2.2f}, random.chance(0.5) ? "poster" : "sign_white");
      }
    }
  }

  /// Cabinets, tanks and pipes up to the roof.
  void add_machines() {
    Random random = random_.part(2);
    for (float x = -0.5f * size_.x() + 1.0f; x < 0.5f * size_.x() - 2.5f; x += between(random, 3.2, 6.0)) {
      const float wide = between(random, 1.2, 2.6), deep = between(random, 1.0, 3.0), tall = between(random, 1.2, 2.8);
      const float y = between(random, 0.2, 2.0);
      const Tint paint = random.chance(0.5) ? tint_of(0.25f, 0.45f, 0.35f) : tint_of(0.75f, 0.72f, 0.6f);
      if (random.chance(0.3)) {
        mesh_.add_column({x + 0.5f * wide, y + 0.5f * wide - 0.5f * size_.y(), 0.0f}, 0.5f * wide, 0.5f * wide,
                         1.5f * tall, 20, material("metal_painted"), paint);
      } else {
        add({x, y, 0.0f}, {x + wide, y + deep, tall}, "metal_painted", paint);
        add({x + 0.15f, y - 0.02f, 0.9f}, {x + 0.65f, y, 1.4f}, "car_glass");
        add({x + 0.8f, y - 0.02f, 1.0f}, {x + 1.1f, y, 1.3f}, "sign_blue");
      }
      const Vector3f foot(x + 0.3f * wide, y + 0.6f * deep - 0.5f * size_.y(), 0.8f * tall);
      add_tube(mesh_, foot, {foot.x(), foot.y(), kHallHeight_m}, 0.09f, 0.09f, 8, material("metal_post"));
    }
  }

  /// Stacks of pallets at equal distances.
  void add_stacks() {
    constexpr float kSpacing_m = 1.5f;
    std::uint64_t number = 1000;
    for (float y = 0.3f; y + kLoad_m < size_.y(); y += kSpacing_m) {
      for (float x = -0.5f * size_.x() + 0.3f; x + kLoad_m < 0.5f * size_.x(); x += kSpacing_m) {
        Random random = goods(++number);
        if (random.chance(0.4)) continue;
        const int layers = 1 + random.below(3);
        float low = 0.0f;
        for (int i = 0; i < layers; ++i) low = add_load(x, y, low, between(random, 0.3, 0.9), random);
      }
    }
  }

 private:
  static constexpr float kShelf_m = 1.1f, kLoad_m = 1.0f;

  std::uint16_t material(std::string_view name) const { return site_.palette->find(name); }

  /// A block, y from the front.
  void add(const Vector3f& low, const Vector3f& high, std::string_view of, Tint tint = {}) {
    const Vector3f to_front(0.0f, -0.5f * size_.y(), 0.0f);
    add_block(mesh_, low + to_front, high + to_front, material(of), tint);
  }

  /// Of the goods at that place: a fifth of them are others on another day.
  Random goods(std::uint64_t place) const {
    constexpr double kMoved = 0.2;
    const Random usual = random_.part(3).part(place);
    const auto& day = site_.parameters.day;
    if (!day) return usual;
    Random today = random_.part(4).part(*day).part(place);
    return today.chance(kMoved) ? today : usual;
  }

  void add_bay(float x, float width, float y, Random random, bool is_last) {
    constexpr float kPost_m = 0.09f, kBeam_m = 0.12f, kTop_m = 5.8f;
    constexpr std::array kLevels_m{0.1f, 1.55f, 3.0f, 4.45f};
    const auto add_posts = [&](float at) {
      for (const float depth : {y, y + kShelf_m - kPost_m}) {
        add({at - 0.5f * kPost_m, depth, 0.0f}, {at + 0.5f * kPost_m, depth + kPost_m, kTop_m}, "metal_painted",
            tint_of(0.2f, 0.35f, 0.65f));
      }
    };
    add_posts(x);
    if (is_last) add_posts(x + width);
    for (const float level : kLevels_m) {
      for (const float depth : {y + 0.02f, y + kShelf_m - 0.07f}) {
        add({x, depth, level - kBeam_m}, {x + width, depth + 0.05f, level}, "metal_painted",
            tint_of(0.95f, 0.4f, 0.08f));
      }
      for (float at = x + 0.2f; at + 0.75f < x + width; at += 0.8f) {
        if (random.chance(0.25)) continue;
        add_load(at, y + 0.05f, level, between(random, 0.3, 1.2), random, 0.75f);
      }
    }
  }

  /// A load on a pallet; returns its top.
  float add_load(float x, float y, float low, float height, Random& random, float width = kLoad_m) {
    constexpr float kPallet_m = 0.14f;
    add({x, y, low}, {x + width, y + kLoad_m, low + kPallet_m}, "wood_fence", grey(0.9f));
    const double kind = random.uniform();
    const float shade = between(random, 0.6, 1.0), in = between(random, 0.0, 0.08);
    const Tint tint = kind < 0.6   ? tint_of(0.75f * shade, 0.55f * shade, 0.36f * shade)  // cardboard
                      : kind < 0.8 ? grey(shade)
                                   : tint_of(0.25f * shade, 0.4f * shade, 0.7f * shade);
    const float top = low + kPallet_m + height;
    add({x + in, y + in, low + kPallet_m}, {x + width - in, y + kLoad_m - in, top},
        kind < 0.6   ? "cloth_c"
        : kind < 0.8 ? "plaster_grey"
                     : "bin_plastic",
        tint);
    if (random.chance(0.4)) add({x + 0.3f, y + in - 0.01f, low + 0.3f}, {x + 0.5f, y + in, low + 0.42f}, "plate");
    return top;
  }

  const Site& site_;
  Random random_;
  Eigen::Vector2f size_;
  Eigen::Affine3f world_from_plot_;
  Mesh mesh_;
};

}  // namespace

Mesh build_hall_plot(const Site& site, const PlannedPlot& planned, const Random& random) {
  HallPlot plot(site, planned, random);
  switch (planned.use) {
    case PlotUse::kHouse:
    case PlotUse::kTown:
      plot.add_shelves();
      break;
    case PlotUse::kInstitute:
      plot.add_office();
      break;
    case PlotUse::kHall:
      plot.add_machines();
      break;
    case PlotUse::kOpen:
      plot.add_stacks();
      break;
  }
  return plot.take();
}

}  // namespace panvo::simulated_world
