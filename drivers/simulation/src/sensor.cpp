// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/sensor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core/hal/intrin.hpp>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "panvo/simulated_world/random.hpp"

namespace panvo::simulation {

using simulated_world::mix;
using simulated_world::Random;

namespace {

constexpr int kQuantiles = 4096;
constexpr int kCurveEntries = 4096;
constexpr float kCurveSteps = kCurveEntries - 1;
constexpr int kRowsPerStripe = 32;
constexpr std::array<float, 3> kLuminance{0.2126f, 0.7152f, 0.0722f};  // of linear RGB [ITU-R BT.709]

/// Quantile of the standard normal distribution, by Newton's method.
double normal_quantile(double probability) {
  double value = 0.0;
  for (int i = 0; i < 60; ++i) {
    const double error = 0.5 * std::erfc(-value / std::sqrt(2.0)) - probability;
    const double density = std::exp(-0.5 * value * value) / std::sqrt(2.0 * CV_PI);
    value -= std::clamp(error / std::max(density, 1e-12), -0.5, 0.5);
  }
  return value;
}

/// Equally likely values of a standard normal variable, scaled to variance one.
const std::array<float, kQuantiles>& normal_values() {
  static const auto values = [] {
    std::array<float, kQuantiles> table{};
    double square = 0.0;
    for (int i = 0; i < kQuantiles; ++i) {
      const double value = normal_quantile((i + 0.5) / kQuantiles);
      table[static_cast<std::size_t>(i)] = static_cast<float>(value);
      square += value * value;
    }
    for (auto& value : table) value = static_cast<float>(value / std::sqrt(square / kQuantiles));
    return table;
  }();
  return values;
}

/// The 8-bit value as a function of the square root of the light, which is almost linear.
std::array<std::uint8_t, kCurveEntries> curve_by_root(double gamma) {
  std::array<std::uint8_t, kCurveEntries> table{};
  for (int i = 0; i < kCurveEntries; ++i) {
    const double light = std::pow(i / static_cast<double>(kCurveSteps), 2.0);
    table[static_cast<std::size_t>(i)] = cv::saturate_cast<std::uint8_t>(255.0 * std::pow(light, 1.0 / gamma));
  }
  return table;
}

cv::Mat vignetting_map(cv::Size size, double loss) {
  cv::Mat map(size, CV_32FC1);
  const cv::Point2d middle(0.5 * (size.width - 1), 0.5 * (size.height - 1));
  const double corner = std::max(middle.dot(middle), 1.0);
  for (int row = 0; row < size.height; ++row) {
    for (int column = 0; column < size.width; ++column) {
      const cv::Point2d place = cv::Point2d(column, row) - middle;
      const double share = place.dot(place) / corner;
      map.at<float>(row, column) = static_cast<float>(1.0 - loss * share * (0.7 + 0.3 * share));
    }
  }
  return map;
}

/// Degree of smudging of each pixel, 0..1: round spots and wiped streaks.
cv::Mat smear_map(cv::Size size, double amount, std::uint64_t seed) {
  cv::Mat map(size, CV_32FC1, cv::Scalar::all(0.0));
  Random random(seed, "smear on the lens");
  const double scale = std::hypot(size.width, size.height);
  const int spots = 6 + static_cast<int>(14.0 * amount);
  for (int i = 0; i < spots; ++i) {
    const cv::Point2d middle(random.uniform(0, size.width), random.uniform(0, size.height));
    const double radius = random.uniform(0.01, 0.05) * scale;
    const double longer = random.uniform(1.0, 4.0);
    const double angle = random.uniform(0.0, CV_PI);
    const double strength = random.uniform(0.4, 1.0) * amount;
    const cv::Point2d along(std::cos(angle), std::sin(angle));
    for (int row = 0; row < size.height; ++row) {
      for (int column = 0; column < size.width; ++column) {
        const cv::Point2d place = cv::Point2d(column, row) - middle;
        const double on = place.dot(along) / (radius * longer);
        const double beside = (place.x * along.y - place.y * along.x) / radius;
        auto& value = map.at<float>(row, column);
        value = std::max(value, static_cast<float>(strength * std::exp(-on * on - beside * beside)));
      }
    }
  }
  return map;
}

/// Adds falling drops as short, bright, almost vertical streaks.
void add_rain(cv::Mat& light, double amount, Random random) {
  const int channels = light.channels();
  const int streaks = static_cast<int>(amount * 0.0008 * static_cast<double>(light.total()));
  const double slant = random.uniform(-0.12, 0.12);
  const auto mean = cv::mean(light);
  for (int i = 0; i < streaks; ++i) {
    const double distance = random.uniform(0.15, 1.0);  // relative to the farthest visible drop
    const double length = 0.03 * light.rows / distance;
    const double width = 0.45 / distance;
    const double opacity = std::min(0.5, 0.12 / distance);
    double column = random.uniform(-10.0, light.cols + 10.0);
    const double top = random.uniform(-length, light.rows);
    for (int row = std::max(0, static_cast<int>(top)); row < std::min<double>(light.rows, top + length); ++row) {
      const double centre = column + slant * (row - top);
      for (int x = static_cast<int>(std::floor(centre - width)); x <= static_cast<int>(std::ceil(centre + width));
           ++x) {
        if (x < 0 || x >= light.cols) continue;
        const double cover = std::clamp(0.5 + width - std::abs(x - centre), 0.0, 1.0) * opacity;
        float* pixel = light.ptr<float>(row) + x * channels;
        for (int c = 0; c < channels; ++c) {
          pixel[c] += static_cast<float>(cover) * (1.3f * static_cast<float>(mean[c]) - pixel[c]);
        }
      }
    }
  }
}

cv::Mat luminance(const cv::Mat& radiance) {
  cv::Mat grey(radiance.size(), CV_32FC1);
  cv::parallel_for_(cv::Range(0, radiance.rows), [&](const cv::Range& range) {
    for (int row = range.start; row < range.end; ++row) {
      const auto* from = radiance.ptr<cv::Vec3f>(row);
      auto* to = grey.ptr<float>(row);
      for (int column = 0; column < radiance.cols; ++column) {
        const auto& colour = from[column];
        to[column] = kLuminance[0] * colour[0] + kLuminance[1] * colour[1] + kLuminance[2] * colour[2];
      }
    }
  });
  return grey;
}

/// A quarter-size copy of the light, blurred: what a smudge on the lens spreads over its neighbourhood.
cv::Mat veil_of(const cv::Mat& light) {
  cv::Mat small, veiled;
  cv::resize(light, small, {}, 0.25, 0.25, cv::INTER_AREA);
  cv::GaussianBlur(small, small, {}, 2.5);
  cv::resize(small, veiled, light.size(), 0, 0, cv::INTER_LINEAR);
  return veiled;
}

/// How electrons become pixel values, equal for all rows of a frame.
struct Conversion {
  Conversion(const SensorParameters& parameters, std::uint64_t frame_noise)
      : full_well(static_cast<float>(parameters.full_well)),
        read_variance(static_cast<float>(parameters.read_noise * parameters.read_noise)),
        curve(curve_by_root(parameters.gamma)),
        noise(frame_noise) {}

  float full_well, read_variance;
  std::array<std::uint8_t, kCurveEntries> curve;
  std::uint64_t noise;
};

/// Exposes one row after another.
class RowExposure {
 public:
  RowExposure(int width, int channels)
      : width_(width * channels),
        channels_(channels),
        electrons_(static_cast<std::size_t>(width_) + 4),
        deviates_(static_cast<std::size_t>(width_) + 4),
        places_(static_cast<std::size_t>(width_) + 4) {}

  void collect(const float* light, float electrons_per_light) {
    for (int i = 0; i < width_; ++i) electrons_[i] = light[i] * electrons_per_light;
  }

  void smear(const float* veil, const float* smudged, float electrons_per_light) {
    for (int i = 0; i < width_; ++i) {
      electrons_[i] += smudged[i / channels_] * (veil[i] * electrons_per_light * 1.05f - electrons_[i]);
    }
  }

  void vignette(const float* shade) {
    if (channels_ == 1) {
      for (int i = 0; i < width_; ++i) electrons_[i] *= shade[i];
    } else {
      for (int i = 0, x = 0; i < width_; i += 3, ++x) {
        electrons_[i] *= shade[x];
        electrons_[i + 1] *= shade[x];
        electrons_[i + 2] *= shade[x];
      }
    }
  }

  /// Adds noise and writes the pixel values. Returns their sum.
  std::uint64_t read_out(int row, const Conversion& conversion, std::uint8_t* to) {
    draw_deviates(conversion.noise + static_cast<std::uint64_t>(row) * 0x9e3779b97f4a7c15ULL);
    find_places(conversion);
    std::uint64_t sum = 0;
    for (int i = 0; i < width_; ++i) {
      to[i] = conversion.curve[static_cast<std::size_t>(places_[i])];
      sum += to[i];
    }
    return sum;
  }

 private:
  void draw_deviates(std::uint64_t row_noise) {
    const auto& normal = normal_values();
    // each hash yields four values
    for (int i = 0; i < width_; i += 4) {
      const std::uint64_t bits = mix(row_noise + static_cast<std::uint64_t>(i));
      for (int k = 0; k < 4; ++k) deviates_[i + k] = normal[(bits >> (16 * k + 4)) & (kQuantiles - 1)];
    }
  }

  /// Entries of the curve for the noisy electrons.
  void find_places(const Conversion& conversion) {
    const cv::v_float32x4 none = cv::v_setzero_f32();
    const cv::v_float32x4 most = cv::v_setall_f32(conversion.full_well);
    const cv::v_float32x4 read = cv::v_setall_f32(conversion.read_variance);
    const cv::v_float32x4 share = cv::v_setall_f32(kCurveSteps * kCurveSteps / conversion.full_well);
    for (int i = 0; i < width_; i += 4) {
      const cv::v_float32x4 mean = cv::v_max(cv::v_load(&electrons_[i]), none);
      const cv::v_float32x4 value = mean + cv::v_sqrt(mean + read) * cv::v_load(&deviates_[i]);
      cv::v_store(&places_[i], cv::v_round(cv::v_sqrt(cv::v_min(cv::v_max(value, none), most) * share)));
    }
  }

  int width_, channels_;
  std::vector<float> electrons_, deviates_;
  std::vector<int> places_;
};

}  // namespace

Sensor::Sensor(const SensorParameters& parameters, const LensEffects& effects, cv::Size size, std::uint64_t seed)
    : parameters_(parameters), effects_(effects), seed_(seed), gain_(parameters.start_gain) {
  const auto is_positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  if (size.width <= 0 || size.height <= 0) throw std::invalid_argument("sensor: the image size must be positive");
  if (!is_positive(parameters.full_well)) throw std::invalid_argument("sensor: full_well must be positive");
  if (!is_positive(parameters.start_gain)) throw std::invalid_argument("sensor: start_gain must be positive");
  if (!is_positive(parameters.gamma)) throw std::invalid_argument("sensor: gamma must be positive");
  if (!(parameters.target_brightness > 0.0 && parameters.target_brightness < 1.0)) {
    throw std::invalid_argument("sensor: target_brightness must lie between 0 and 1");
  }
  if (!(parameters.metered_from >= 0.0 && parameters.metered_from < parameters.metered_to &&
        parameters.metered_to <= 1.0)) {
    throw std::invalid_argument("sensor: metered_from must lie below metered_to, both in [0, 1]");
  }
  if (!(parameters.exposure_lag >= 0.0 && parameters.exposure_lag <= 1.0)) {
    throw std::invalid_argument("sensor: exposure_lag must lie in [0, 1]");
  }
  if (!(parameters.vignetting >= 0.0 && parameters.vignetting <= 1.0)) {
    throw std::invalid_argument("sensor: vignetting must lie in [0, 1]");
  }
  if (!(parameters.read_noise >= 0.0) || !(parameters.blur_px >= 0.0)) {
    throw std::invalid_argument("sensor: read_noise and blur_px must not be negative");
  }
  vignetting_ = vignetting_map(size, parameters.vignetting);
  if (effects.smear > 0.0) smear_ = smear_map(size, effects.smear, seed);
}

cv::Mat Sensor::expose(cv::Mat& radiance, std::uint64_t frame) {
  if (radiance.type() != CV_32FC3 || radiance.size() != vignetting_.size()) {
    throw std::invalid_argument("sensor: the radiance must be CV_32FC3 of the sensor's size");
  }
  const cv::Mat light = through_lens(radiance, frame);
  const cv::Mat veiled = smear_.empty() ? cv::Mat() : veil_of(light);
  const int channels = light.channels();
  cv::Mat image(light.size(), CV_8UC(channels));
  const Conversion conversion(parameters_, mix(mix(seed_ ^ 0x6e6f697365ULL) + frame));
  const auto electrons_per_light = static_cast<float>(gain_ * parameters_.full_well);
  const int stripes = (light.rows + kRowsPerStripe - 1) / kRowsPerStripe;
  const cv::Range metered(static_cast<int>(parameters_.metered_from * light.rows),
                          std::max(1, static_cast<int>(parameters_.metered_to * light.rows)));
  std::vector<std::uint64_t> sums(static_cast<std::size_t>(stripes), 0);
  cv::parallel_for_(cv::Range(0, stripes), [&](const cv::Range& range) {
    RowExposure exposure(light.cols, channels);
    for (int row = range.start * kRowsPerStripe; row < std::min(light.rows, range.end * kRowsPerStripe); ++row) {
      exposure.collect(light.ptr<float>(row), electrons_per_light);
      if (!veiled.empty()) exposure.smear(veiled.ptr<float>(row), smear_.ptr<float>(row), electrons_per_light);
      exposure.vignette(vignetting_.ptr<float>(row));
      const std::uint64_t sum = exposure.read_out(row, conversion, image.ptr<std::uint8_t>(row));
      if (metered.start <= row && row < metered.end) sums[static_cast<std::size_t>(row / kRowsPerStripe)] += sum;
    }
  });
  if (parameters_.exposure_lag > 0.0) {
    double brightness = 0.0;
    for (const auto sum : sums) brightness += static_cast<double>(sum);
    control_exposure(brightness / (255.0 * metered.size() * image.cols * channels));
  }
  return image;
}

cv::Mat Sensor::through_lens(cv::Mat& radiance, std::uint64_t frame) const {
  cv::Mat light = parameters_.colour ? radiance : luminance(radiance);
  if (effects_.rain > 0.0) add_rain(light, effects_.rain, Random(seed_, "rain past the lens").part(frame));
  if (parameters_.blur_px > 0.0) {
    const int reach = parameters_.blur_px < 0.7 ? 1 : static_cast<int>(std::ceil(3.0 * parameters_.blur_px));
    cv::GaussianBlur(light, light, cv::Size(2 * reach + 1, 2 * reach + 1), parameters_.blur_px, parameters_.blur_px,
                     cv::BORDER_REFLECT_101);
  }
  return light;
}

void Sensor::control_exposure(double brightness) {
  gain_ *= std::pow(parameters_.target_brightness / std::max(brightness, 0.01),
                    parameters_.gamma * parameters_.exposure_lag);
  gain_ = std::clamp(gain_, 0.05, 50.0);
}

}  // namespace panvo::simulation
