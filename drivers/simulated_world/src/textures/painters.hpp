// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>
#include <opencv2/core.hpp>
#include <vector>

#include "noise.hpp"

namespace panvo::simulated_world {

inline constexpr float kTurn = 2.0f * std::numbers::pi_v<float>;  ///< full turn, rad

// Painters: each paints one kind of surface with row 0 at the top. Colours are linear RGB reflectances, CV_32FC3;
// overlays are factors with mean 1, CV_32FC1.
using Colour = cv::Vec3f;

/// Converts a picture for Texture: sRGB RGBA, row 0 at v = 0 (the bottom). `alpha` (CV_32FC1, 0..1) may be empty.
cv::Mat encoded_picture(const cv::Mat3f& linear, const cv::Mat1f& alpha = {});
/// Converts an overlay for Texture, scaled by half.
cv::Mat encoded_overlay(const cv::Mat1f& factor);

/// A colour near `colour`, with brightness and hue varied by these fractions.
Colour varied(const Colour& colour, float brightness, float hue, Random random);

/// Darkens crevices and lightens ridges, from `height` in px relative to its blur of `reach_px`.
void add_relief(cv::Mat3f& picture, const cv::Mat1f& height, float reach_px, float strength);

/// A random position (px) in a picture of `size`.
cv::Point2f somewhere(int size, Random& random);

/// Offsets in px at which to draw a shape with that bounding box so that the picture of `size` stays tileable.
std::vector<cv::Point> tiling_offsets(const cv::Rect& box, int size);

/// The corners, `step_px` apart, of a random line from `start` (px) in `direction_rad`.
std::vector<cv::Point2f> wandering_line(cv::Point2f start, float direction_rad, float length_px, float step_px,
                                        float unrest_rad, Random random);

/// Draws a polyline with that value, wrapping around the borders.
void draw_line(cv::Mat1f& picture, const std::vector<cv::Point2f>& line, float value, float width_px);

/// Reduces variations larger than a tenth of the picture by the fraction `share`, because they make the repetition
/// visible.
void flatten(cv::Mat3f& picture, float share);

// Ground
cv::Mat3f paint_asphalt(float mm_per_px, const Colour& stone, const Colour& binder, float contrast, Random random);
cv::Mat3f paint_concrete(const Colour& colour, float grain, Random random);
cv::Mat3f paint_slabs(int rows, int columns, bool staggered, const Colour& colour, Random random);
cv::Mat3f paint_cobbles(int cells, const Colour& colour, Random random);
cv::Mat3f paint_gravel(int cells, const Colour& colour, Random random);
cv::Mat3f paint_grass(Random random);
cv::Mat3f paint_soil(Random random);
cv::Mat3f paint_marking(Random random);
cv::Mat3f paint_manhole(Random random);
cv::Mat3f paint_far_land(Random random);

// Walls
cv::Mat3f paint_bricks(const Colour& brick, const Colour& mortar, float variety, Random random);
cv::Mat3f paint_plaster(const Colour& colour, float roughness, Random random);
cv::Mat3f paint_stone_blocks(const Colour& colour, Random random);
cv::Mat3f paint_rubble(const Colour& colour, Random random);
cv::Mat3f paint_concrete_panels(const Colour& colour, Random random);
cv::Mat3f paint_boards(const Colour& colour, int boards, bool upright, Random random);
cv::Mat3f paint_sheet(const Colour& colour, int ribs, Random random);
cv::Mat3f paint_roof_tiles(const Colour& colour, int rows, int columns, bool slate, Random random);

// Overlays
cv::Mat1f paint_road_wear(float amount, Random random);    ///< cracks, seams, stains, skid marks; fades at its borders
cv::Mat1f paint_ground_wear(float amount, Random random);  ///< stains and spots; fades at its borders
cv::Mat1f paint_wall_wear(float streaks, float repairs, Random random);  ///< rain, splashes at the foot; over 16 m

// Plants
struct Cutout {
  cv::Mat3f colour;
  cv::Mat1f alpha;
};
struct LeafShape {
  int leaves = 90;
  float length_m = 0.1f;
  float width_share = 0.6f;  ///< of the length
  int needles = 0;           ///< per twig, in place of leaves
};
Cutout paint_leaves(const LeafShape& shape, const Colour& colour, Random random);
cv::Mat3f paint_hedge(const Colour& colour, Random random);
cv::Mat3f paint_flowers(Random random);
cv::Mat3f paint_bark(const Colour& colour, Random random);

// Things
cv::Mat3f paint_plain(const Colour& colour, float blotches, float grain, Random random);
cv::Mat3f paint_glass(Random random);
cv::Mat3f paint_curtain(const Colour& colour, Random random);
cv::Mat3f paint_door(const Colour& colour, Random random);
cv::Mat3f paint_shutter(const Colour& colour, Random random);
cv::Mat3f paint_sign(const Colour& face, const Colour& border, Random random);
cv::Mat3f paint_poster(Random random);
cv::Mat3f paint_plate(Random random);
cv::Mat3f paint_tyre(Random random);
cv::Mat3f paint_cloth(const Colour& colour, int threads, Random random);
cv::Mat3f paint_hair(Random random);

}  // namespace panvo::simulated_world
