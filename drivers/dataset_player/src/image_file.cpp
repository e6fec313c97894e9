// SPDX-License-Identifier: Apache-2.0
#include "panvo/dataset_player/image_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <tuple>

#include "panvo/dataset_player/dataset.hpp"

namespace panvo::dataset_player {
namespace {

constexpr std::array kExtensions{".png", ".jpg", ".jpeg", ".pgm", ".ppm", ".bmp", ".tif", ".tiff"};

bool read_bytes(const std::filesystem::path& file, std::vector<std::uint8_t>& bytes) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  const auto size = stream ? static_cast<std::streamoff>(stream.tellg()) : -1;
  if (size < 0) return false;
  bytes.resize(static_cast<std::size_t>(size));
  stream.seekg(0);
  return static_cast<bool>(stream.read(reinterpret_cast<char*>(bytes.data()), size));
}

/// Index of the first byte after a JPEG's header segments, which may hold a thumbnail with an end marker of its own.
std::size_t after_jpeg_header(const std::vector<std::uint8_t>& bytes) {
  constexpr std::uint8_t kMarker = 0xff, kStartOfScan = 0xda;
  std::size_t at = 2;
  while (at + 4 <= bytes.size() && bytes[at] == kMarker && bytes[at + 1] != kStartOfScan) {
    at += 2U + (static_cast<std::size_t>(bytes[at + 2]) << 8U) + bytes[at + 3];
  }
  return std::min(at, bytes.size());
}

/// Whether the file is a JPEG without its end marker. The decoder fills the missing part with grey and reports success.
bool is_cut_off_jpeg(const std::vector<std::uint8_t>& bytes) {
  constexpr std::array<std::uint8_t, 2> kStart{0xff, 0xd8}, kEnd{0xff, 0xd9};
  if (bytes.size() < 4 || !std::equal(kStart.begin(), kStart.end(), bytes.begin())) return false;
  // Some cameras append padding or other data; entropy-coded data cannot contain the marker.
  const auto data = bytes.begin() + static_cast<std::ptrdiff_t>(after_jpeg_header(bytes));
  return std::find_end(data, bytes.end(), kEnd.begin(), kEnd.end()) == bytes.end();
}

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::optional<std::uint64_t> trailing_number(const std::string& stem) {
  const auto last_other = stem.find_last_not_of("0123456789");
  const auto digits = last_other == std::string::npos ? stem : stem.substr(last_other + 1);
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (digits.empty() || error != std::errc{}) return std::nullopt;
  return number;
}

}  // namespace

std::optional<std::string> ImageDecoder::decode(const std::filesystem::path& file, Colour colour, cv::Mat& image) {
  const auto fail = [&](const char* what) {
    image.release();
    return file.string() + ": " + what;
  };
  std::error_code error;
  // Folders and devices have no meaningful size for allocation.
  if (!std::filesystem::is_regular_file(file, error) || !read_bytes(file, bytes_)) return fail("cannot be read");
  if (bytes_.empty()) return fail("is empty");
  if (is_cut_off_jpeg(bytes_)) return fail("is a JPEG that was cut off");
  const int flags =
      (colour == Colour::kGrey ? cv::IMREAD_GRAYSCALE : cv::IMREAD_ANYCOLOR) | cv::IMREAD_IGNORE_ORIENTATION;
  // Release first: OpenCV leaves an existing image untouched if it finds no decoder, which would look like success.
  image.release();
  try {
    image = cv::imdecode(bytes_, flags);
  } catch (const cv::Exception&) {
    return fail("cannot be decoded as an image");
  }
  if (image.empty()) return fail("cannot be decoded as an image");
  return std::nullopt;
}

std::vector<ImageFile> list_images(const std::filesystem::path& folder) {
  std::vector<ImageFile> images;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const auto extension = lower_case(entry.path().extension().string());
    if (std::find(kExtensions.begin(), kExtensions.end(), extension) == kExtensions.end()) continue;
    images.push_back({entry.path(), trailing_number(entry.path().stem().string())});
  }
  if (error) throw DatasetError(folder.string() + ": cannot be listed: " + error.message());
  std::sort(images.begin(), images.end(), [](const ImageFile& a, const ImageFile& b) {
    return std::tie(a.number, a.path) < std::tie(b.number, b.path);
  });
  return images;
}

}  // namespace panvo::dataset_player
