// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/measurement_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "seeded_random.hpp"

namespace panvo::vision {
namespace {

/// Smallest integer size, at least 1, within a fractional bound of the paper.
int first_whole(double bound) { return std::max(1, static_cast<int>(std::ceil(bound))); }

/// r-bar of [Eq. 5]: each of the four with probability 1/4; redrawn if none is chosen, because the feature would be
/// zero.
std::array<float, 4> draw_statistics(SeededRandom& random) {
  std::array<float, 4> chosen{};
  while (std::all_of(chosen.begin(), chosen.end(), [](float choice) { return choice == 0.0F; })) {
    for (float& choice : chosen) choice = random.share() < 0.25 ? 1.0F : 0.0F;
  }
  return chosen;
}

/// Log-uniform: with uniform sizes, nearly all rectangles would be about as large as the band.
int draw_size(int from, int to, SeededRandom& random) {
  const double size = from * std::pow(static_cast<double>(to) / from, random.share());
  return std::clamp(static_cast<int>(size), from, to - 1);
}

int draw_left(int anchor, double spread, int width, int columns, SeededRandom& random) {
  const double centre = anchor + random.between(-0.5, 0.5) * spread * columns;
  const int left = static_cast<int>(std::floor(centre - 0.5 * width)) % columns;
  return left < 0 ? left + columns : left;
}

}  // namespace

RectangleBounds large_scale(cv::Size band, double widest) {
  const int to = std::min(band.width, static_cast<int>(std::lround(widest * band.width)));
  return {{first_whole(band.width / 20.0), first_whole(band.height / 8.0)}, {to, band.height}};
}

RectangleBounds small_scale(cv::Size band) {
  return {{first_whole(band.width / 40.0), first_whole(band.height / 10.0)},
          {first_whole(band.width / 20.0), first_whole(band.height / 8.0)}};
}

MeasurementMatrix::MeasurementMatrix(cv::Size band, const RectangleBounds& bounds, const MatrixParameters& parameters,
                                     std::uint64_t seed)
    : band_(band) {
  if (bounds.from.width < 1 || bounds.from.height < 1 || bounds.to.width <= bounds.from.width ||
      bounds.to.height <= bounds.from.height || bounds.to.width > band.width || bounds.to.height > band.height) {
    std::ostringstream text;
    text << "rectangles from " << bounds.from << " to " << bounds.to << " px do not fit into a band of " << band;
    throw std::invalid_argument(text.str());
  }
  if (parameters.rows < 1 || parameters.rectangles < 1 || !(parameters.spread >= 0.0 && parameters.spread <= 1.0)) {
    throw std::invalid_argument("measurement matrix: rows, rectangles or spread out of range");
  }
  if (parameters.balanced && parameters.rectangles % 2 != 0) {
    throw std::invalid_argument("measurement matrix: a balanced row needs an even number of rectangles");
  }
  SeededRandom random(seed);
  for (int row = 0; row < parameters.rows; ++row) {
    const int anchor = random.whole(0, band.width);
    for (int i = 0; i < parameters.rectangles; ++i) {
      Element element;
      BandRectangle& r = element.rectangle;
      r.width = draw_size(bounds.from.width, bounds.to.width, random);
      r.height = draw_size(bounds.from.height, bounds.to.height, random);
      r.x = draw_left(anchor, parameters.spread, r.width, band.width, random);
      r.y = random.whole(0, band.height - r.height + 1);
      const bool plus = random.share() < 0.5;  // [Eq. 3]
      element.sign = (parameters.balanced ? i % 2 == 0 : plus) ? 1.0F : -1.0F;
      element.statistics = draw_statistics(random);
      elements_.push_back(element);
    }
    finish_row();
  }
}

MeasurementMatrix::MeasurementMatrix(cv::Size band, const std::vector<std::vector<Element>>& rows) : band_(band) {
  for (const std::vector<Element>& row : rows) {
    for (const Element& element : row) {
      const BandRectangle& r = element.rectangle;
      if (r.x < 0 || r.x >= band.width || r.width < 1 || r.width > band.width || r.y < 0 || r.height < 1 ||
          r.y + r.height > band.height) {
        throw std::invalid_argument("measurement matrix: a rectangle lies outside the band");
      }
      elements_.push_back(element);
    }
    if (row.empty()) throw std::invalid_argument("measurement matrix: a row without rectangles");
    finish_row();
  }
}

void MeasurementMatrix::finish_row() {
  for (std::size_t i = begins_.back(); i < elements_.size(); ++i) {
    const BandRectangle& r = elements_[i].rectangle;
    elements_[i].share = 1.0F / static_cast<float>(r.width * r.height);
  }
  begins_.push_back(elements_.size());
}

int MeasurementMatrix::widest() const {
  int widest = 0;
  for (const Element& element : elements_) widest = std::max(widest, element.rectangle.width);
  return widest;
}

std::span<const MeasurementMatrix::Element> MeasurementMatrix::row(int index) const {
  const auto i = static_cast<std::size_t>(index);
  return std::span(elements_).subspan(begins_[i], begins_[i + 1] - begins_[i]);
}

}  // namespace panvo::vision
