// SPDX-License-Identifier: Apache-2.0
#include "panvo/v4l2_camera/format_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace panvo::v4l2_camera {
namespace {

bool is_readable(PixelCode code) {
  const Coding coding = coding_of(code);
  return coding == Coding::kRaw || coding == Coding::kJpeg;
}

std::string names_of(const std::vector<OfferedFormat>& offered, bool only_readable) {
  std::set<std::string> told;
  std::string text;
  for (const auto& format : offered) {
    if (only_readable && !is_readable(format.pixels)) continue;
    if (told.insert(to_text(format.pixels)).second) text += (text.empty() ? "" : ", ") + to_text(format.pixels);
  }
  return text;
}

std::string remedy(const std::vector<OfferedFormat>& offered) {
  const std::string usable = names_of(offered, true);
  return usable.empty() ? fmt::format("the camera has no supported format; it has {}, supported are {}",
                                      offered.empty() ? "none" : names_of(offered, false), readable_codes())
                        : "set pixel_format to one of " + usable;
}

std::string code_problem(PixelCode code, const std::vector<OfferedFormat>& offered) {
  if (coding_of(code) == Coding::kVideo) {
    return fmt::format("{} is compressed video, whose frames depend on each other, and is not supported: {}",
                       to_text(code), remedy(offered));
  }
  if (!is_readable(code)) return fmt::format("{} is not supported: {}", to_text(code), remedy(offered));
  return {};
}

/// The highest rate of a format in that size, Hz; 0: not known; -1: it does not have that size.
double best_rate(const OfferedFormat& format, int width, int height) {
  double best_hz = -1.0;
  for (const auto& size : format.sizes) {
    if (size.includes(width, height)) best_hz = std::max(best_hz, size.rates_hz.empty() ? 0.0 : size.rates_hz.front());
  }
  return best_hz;
}

/// Lower is better: closeness to the requested rate, then the requested kind, then less work.
auto rank(const OfferedFormat& format, const FormatWish& wish, double rate_hz, PixelCode current) {
  constexpr double kSame = 1.01;  // 29.97 Hz counts as 30
  const bool is_fast_enough = wish.rate_hz <= 0.0 || rate_hz == 0.0 || rate_hz * kSame >= wish.rate_hz;
  const bool is_grey = format.pixels == pixel_code('G', 'R', 'E', 'Y');
  return std::tuple(!is_fast_enough, is_fast_enough ? 0.0 : -rate_hz, wish.prefers_grey && !is_grey,
                    format.pixels != current, wish.rate_hz <= 0.0 ? -rate_hz : 0.0,
                    coding_of(format.pixels) == Coding::kJpeg);
}

}  // namespace

bool OfferedSize::includes(int wanted_width, int wanted_height) const {
  if (step_x == 0 && step_y == 0) return wanted_width == width && wanted_height == height;
  const auto fits = [](int wanted, int least, int most, int step) {
    return wanted >= least && wanted <= most && (step <= 1 || (wanted - least) % step == 0);
  };
  return fits(wanted_width, min_width, width, step_x) && fits(wanted_height, min_height, height, step_y);
}

std::string to_text(const ImageFormat& format) {
  return fmt::format("{} {} x {} px", to_text(format.pixels), format.width, format.height);
}

conversions::Result<ImageFormat> choose_format(const std::vector<OfferedFormat>& offered, const ImageFormat& current,
                                               const FormatWish& wish) {
  ImageFormat choice{current.pixels, wish.width > 0 ? wish.width : current.width,
                     wish.height > 0 ? wish.height : current.height, 0};
  if (!wish.pixel_format.empty()) {
    const auto code = parse_pixel_code(wish.pixel_format);
    if (!code) {
      return conversions::Reason{fmt::format("pixel_format '{}' is not a code of one to four characters: {}",
                                             wish.pixel_format, remedy(offered))};
    }
    if (auto problem = code_problem(*code, offered); !problem.empty())
      return conversions::Reason{"pixel_format " + std::move(problem)};
    choice.pixels = *code;
    return choice;
  }
  const OfferedFormat* best = nullptr;
  for (const auto& format : offered) {
    const double rate_hz = best_rate(format, choice.width, choice.height);
    if (!is_readable(format.pixels) || rate_hz < 0.0) continue;
    if (best == nullptr || rank(format, wish, rate_hz, current.pixels) <
                               rank(*best, wish, best_rate(*best, choice.width, choice.height), current.pixels))
      best = &format;
  }
  if (best != nullptr) choice.pixels = best->pixels;
  if (best != nullptr || is_readable(choice.pixels)) return choice;
  // No readable format in that size: take any readable format; the camera then chooses the size.
  for (const auto& format : offered) {
    if (!is_readable(format.pixels)) continue;
    choice.pixels = format.pixels;
    return choice;
  }
  return conversions::Reason{code_problem(current.pixels, offered)};
}

std::string format_problem(const ImageFormat& given, const std::vector<OfferedFormat>& offered) {
  if (auto problem = code_problem(given.pixels, offered); !problem.empty())
    return fmt::format("gives {}, and {}", to_text(given), problem);
  if (given.width <= 0 || given.height <= 0) return fmt::format("gives {}, which is not an image", to_text(given));
  return {};
}

std::vector<std::string> not_given(const FormatWish& wish, const ImageFormat& asked, const ImageFormat& given,
                                   double given_rate_hz) {
  std::vector<std::string> texts;
  const bool is_other_size =
      (wish.width > 0 && given.width != wish.width) || (wish.height > 0 && given.height != wish.height);
  const bool is_other_code = !wish.pixel_format.empty() && given.pixels != asked.pixels;
  if (is_other_size || is_other_code)
    texts.push_back(fmt::format("format {}: the camera gives {}", to_text(asked), to_text(given)));
  constexpr double kSame = 0.01;
  if (wish.rate_hz > 0.0 && given_rate_hz <= 0.0) {
    texts.push_back(fmt::format("frame_rate_hz {}: the camera's rate cannot be set", wish.rate_hz));
  } else if (wish.rate_hz > 0.0 && std::abs(given_rate_hz - wish.rate_hz) > kSame * wish.rate_hz) {
    texts.push_back(fmt::format("frame_rate_hz {}: the camera gives {:.4g} Hz", wish.rate_hz, given_rate_hz));
  }
  return texts;
}

}  // namespace panvo::v4l2_camera
