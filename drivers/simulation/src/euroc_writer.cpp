// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/euroc_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <span>
#include <sstream>
#include <stdexcept>

#include "panvo/simulation/sequence_file.hpp"
#include "render_journal.hpp"
#include "write_failure.hpp"

namespace panvo::simulation {
namespace {

namespace fs = std::filesystem;

// Files of an incomplete data set: its description, and its progress.
constexpr auto kAsked = "rendering.yaml", kJournal = "rendered.csv";

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text << std::flush;
  if (!stream) fail_to_write(file);
}

std::string read_text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw std::runtime_error(folder.string() + ": cannot be created (" + error.message() + ")");
}

const char* extension(ImageFormat format) { return format == ImageFormat::kJpeg ? "jpg" : "png"; }

/// The first pair of lines that differ between two texts.
std::optional<std::pair<std::string, std::string>> first_difference(const std::string& a, const std::string& b) {
  std::istringstream lines_a(a), lines_b(b);
  for (std::string line_a, line_b; lines_a || lines_b;) {
    line_a.clear();
    line_b.clear();
    std::getline(lines_a, line_a);
    std::getline(lines_b, line_b);
    if (line_a != line_b) return std::pair(line_a, line_b);
  }
  return {};
}

std::string matrix(const Eigen::Isometry3d& transform) {
  const Eigen::Matrix4d values = transform.matrix();
  std::string text;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      text += fmt::format("{}{:.15g}", text.empty() ? "" : ", ", values(row, column));
    }
  }
  return text;
}

template <class Values>
std::string list(const Values& values) {
  std::string text;
  for (const double value : values) text += fmt::format("{}{:.15g}", text.empty() ? "" : ", ", value);
  return text;
}

std::string sensor_yaml(const std::string& comment, const Eigen::Isometry3d& base_from_camera, double rate_hz,
                        int width, int height, const std::string& model, const std::string& lens) {
  return fmt::format(
      "%YAML:1.0\n"
      "# T_BS: sensor -> body, p_B = R p_S + t. Body (base_link): x forward, y left, z up, on the ground below the "
      "vehicle's "
      "middle.\n"
      "sensor_type: camera\n"
      "comment: {}\n"
      "T_BS:\n  cols: 4\n  rows: 4\n  data: [{}]\n"
      "rate_hz: {:g}\n"
      "resolution: [{}, {}]\n"
      "camera_model: {}\n{}",
      comment, matrix(base_from_camera), rate_hz, width, height, model, lens);
}

std::string eye_yaml(const std::string& side, const vision::LensCamera& eye, const Eigen::Isometry3d& base_from_camera,
                     double rate_hz) {
  const auto& p = eye.pinhole;
  // the layout has no k3: written only if it is not zero
  const auto coefficients = list(std::span(eye.distortion).first(eye.distortion[4] == 0.0 ? 4 : 5));
  return sensor_yaml(side + " eye of the stereo camera", base_from_camera, rate_hz, p.width, p.height, "pinhole",
                     fmt::format("intrinsics: [{}]  # fx fy cx cy; pixel centres at integer coordinates\n"
                                 "distortion_model: radial-tangential\ndistortion_coefficients: [{}]\n",
                                 list(std::array{p.fx, p.fy, p.cx, p.cy}), coefficients));
}

std::string head_yaml(const PanoramicCamera& panorama, const PanoramaHead& head) {
  if (panorama.kind == PanoramaKind::kEquirectangular) {
    return sensor_yaml(
        "equirectangular panorama", head.base_from_head, panorama.rate_hz, head.width, head.height, "equirectangular",
        fmt::format("# camera axes X right, Y down, Z forward; azimuth 2 pi u / {} - pi clockwise from ahead, "
                    "elevation pi v / {} - pi / 2 downwards [Lu2015 Eqs. 9, 10]\n"
                    "intrinsics: [{}, {}]\ndistortion_model: none\ndistortion_coefficients: [0, 0, 0, 0]\n",
                    head.width, head.height, head.width, head.height));
  }
  const auto& p = head.fisheye.pinhole;
  return sensor_yaml("head of the panoramic camera, " + head.frame_id, head.base_from_head, panorama.rate_hz,
                     head.width, head.height, "pinhole",
                     fmt::format("intrinsics: [{}]  # fx fy cx cy; pixel centres at integer coordinates\n"
                                 "distortion_model: equidistant\ndistortion_coefficients: [{}]\n"
                                 "field_of_view_rad: {:.15g}\n",
                                 list(std::array{p.fx, p.fy, p.cx, p.cy}), list(head.fisheye.distortion),
                                 head.fisheye.field_of_view_rad));
}

}  // namespace

std::uint64_t estimated_bytes(const Simulation& simulation, std::size_t first_instant, ImageFormat format) {
  // Bytes per pixel and channel, measured on street scenes.
  const double bytes_per_sample = format == ImageFormat::kJpeg ? 0.35 : 0.75;
  const auto& rig = simulation.parameters().rig;
  const auto& eye = rig.stereo.calibration.left.pinhole;
  double bytes = 0.0;
  for (const auto& instant : std::span(simulation.instants()).subspan(first_instant)) {
    if (instant.stereo_frame) bytes += 2.0 * eye.width * eye.height * (rig.stereo.sensor.colour ? 3 : 1);
    if (instant.panorama_frame) {
      for (const auto& head : rig.panorama.heads) {
        bytes += static_cast<double>(head.width) * head.height * (rig.panorama.sensor.colour ? 3 : 1);
      }
    }
  }
  return static_cast<std::uint64_t>(bytes * bytes_per_sample);
}

EurocWriter::EurocWriter(fs::path directory, const Simulation& simulation, ImageFormat format)
    : directory_(std::move(directory)), simulation_(simulation), format_(format) {
  const auto& parameters = simulation.parameters();
  const auto& stereo = parameters.rig.stereo;
  const auto& panorama = parameters.rig.panorama;
  const auto add_camera = [this](bool is_panoramic, int number, std::string description) {
    cameras_.push_back({is_panoramic, directory_ / "mav0" / fmt::format("cam{}", number), std::move(description), {}});
  };
  if (parameters.stereo) {
    add_camera(false, 0, eye_yaml("left", stereo.calibration.left, stereo.base_from_left, stereo.rate_hz));
    add_camera(false, 1, eye_yaml("right", stereo.calibration.right, stereo.base_from_right(), stereo.rate_hz));
  }
  if (parameters.panorama) {
    int number = 2;
    for (const auto& head : panorama.heads) add_camera(true, number++, head_yaml(panorama, head));
  }
  make_folder(directory_);
  journal_ = std::make_unique<RenderJournal>(directory_ / kJournal);
  describe();
  find_what_is_written();
  write_ground_truth();
}

EurocWriter::~EurocWriter() = default;

/// Before the first image, writes everything that determines the pixels, so that two simulations are not mixed.
void EurocWriter::describe() {
  const auto& parameters = simulation_.parameters();
  std::string asked = fmt::format(
      "format: {}\nassets: {}\nvibration: {:g}\nbody: {}\nspeed: {:g}\nturns in place: {}\n{}", extension(format_),
      parameters.assets.string(), parameters.motion.vibration, parameters.rig.vehicle.has_body,
      parameters.rig.vehicle.speed_m_per_s, parameters.rig.vehicle.turns_in_place, sequence_yaml(simulation_));
  for (const auto& camera : cameras_) asked += camera.description;
  const auto file = directory_ / kAsked;
  if (!fs::exists(file)) {
    journal_->keep(0);
    write_text(file.string() + ".new", asked);
    fs::rename(file.string() + ".new", file);
  } else if (const auto difference = first_difference(read_text(file), asked)) {
    throw std::runtime_error(
        fmt::format("{}: is an incomplete data set of another simulation ('{}' there, '{}' requested); use the same "
                    "arguments, remove the folder, or choose another",
                    directory_.string(), difference->first, difference->second));
  }
}

/// Lists the existing images. A killed process leaves complete files; a power failure may leave empty ones, and
/// rendering resumes at the first of them.
void EurocWriter::find_what_is_written() {
  for (auto& camera : cameras_) {
    make_folder(camera.folder / "data");
    write_text(camera.folder / "sensor.yaml", camera.description);
    camera.list.open(camera.folder / "data.csv", std::ios::binary);
    camera.list << "#timestamp [ns],filename\n";
  }
  const auto& instants = simulation_.instants();
  const auto is_written = [&](const Instant& instant) {
    return std::ranges::all_of(cameras_, [&](const Camera& camera) {
      std::error_code error;
      const auto bytes = fs::file_size(camera.folder / "data" / image_name(instant), error);
      return !exposes(camera, instant) || (!error && bytes > 0);
    });
  };
  const auto& found = journal_->found();
  while (written_before_ < std::min(found.size(), instants.size()) &&
         found[written_before_].stamp_ns == instants[written_before_].stamp_ns &&
         is_written(instants[written_before_])) {
    list_images(instants[written_before_++]);
  }
  journal_->keep(written_before_);
}

Exposure EurocWriter::exposure_before() const {
  return written_before_ > 0 ? journal_->found()[written_before_ - 1].exposure : Exposure{};
}

bool EurocWriter::exposes(const Camera& camera, const Instant& instant) {
  return camera.is_panoramic ? instant.panorama_frame.has_value() : instant.stereo_frame.has_value();
}

std::string EurocWriter::image_name(const Instant& instant) const {
  return fmt::format("{}.{}", instant.stamp_ns, extension(format_));
}

void EurocWriter::list_images(const Instant& instant) {
  for (auto& camera : cameras_) {
    if (!exposes(camera, instant)) continue;
    camera.list << instant.stamp_ns << ',' << image_name(instant) << '\n';
    if (!camera.list) fail_to_write(camera.folder / "data.csv");
  }
}

void EurocWriter::write_ground_truth() {
  const auto folder = directory_ / "mav0" / "state_groundtruth_estimate0";
  fs::create_directories(folder);
  std::string text =
      "#timestamp [ns], p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z [], "
      "v_RS_R_x [m s^-1], v_RS_R_y [m s^-1], v_RS_R_z [m s^-1], b_w_RS_S_x [rad s^-1], b_w_RS_S_y [rad s^-1], "
      "b_w_RS_S_z [rad s^-1], b_a_RS_S_x [m s^-2], b_a_RS_S_y [m s^-2], b_a_RS_S_z [m s^-2]\n";
  for (const auto& instant : simulation_.instants()) {
    const auto pose = simulation_.motion().world_from_base(instant.t_s);
    const Eigen::Quaterniond q(pose.linear());
    const Eigen::Vector3d p = pose.translation();
    const Eigen::Vector3d v = pose.linear() * simulation_.motion().twist(instant.t_s).head<3>();
    text += fmt::format("{},{:.9f},{:.9f},{:.9f},{:.12f},{:.12f},{:.12f},{:.12f},{:.7f},{:.7f},{:.7f},0,0,0,0,0,0\n",
                        instant.stamp_ns, p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z(), v.x(), v.y(), v.z());
  }
  write_text(folder / "data.csv", text);
}

void EurocWriter::write(const Instant& instant, const Simulation::StereoImages& images) {
  write_image(cameras_.at(0), instant, images.left);
  write_image(cameras_.at(1), instant, images.right);
}

void EurocWriter::write(const Instant& instant, const std::vector<cv::Mat>& panorama_heads) {
  const std::size_t first = cameras_.size() - panorama_heads.size();
  for (std::size_t i = 0; i < panorama_heads.size(); ++i)
    write_image(cameras_.at(first + i), instant, panorama_heads[i]);
}

void EurocWriter::write_image(const Camera& camera, const Instant& instant, const cv::Mat& image) const {
  const auto file = camera.folder / "data" / image_name(instant);
  cv::Mat bgr = image;
  if (image.channels() == 3) cv::cvtColor(image, bgr, cv::COLOR_RGB2BGR);
  std::vector<unsigned char> bytes;
  const auto quality = format_ == ImageFormat::kJpeg ? std::vector<int>{cv::IMWRITE_JPEG_QUALITY, 95}
                                                     : std::vector<int>{cv::IMWRITE_PNG_COMPRESSION, 1};
  cv::imencode(fmt::format(".{}", extension(format_)), bgr, bytes, quality);
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream) fail_to_write(file);
}

void EurocWriter::complete(const Instant& instant, const Exposure& exposure) {
  list_images(instant);
  journal_->add({instant.stamp_ns, exposure});
}

void EurocWriter::finish() {
  for (auto& camera : cameras_) {
    camera.list.close();
    if (!camera.list) fail_to_write(camera.folder / "data.csv");
  }
  write_text(directory_ / "sequence.yaml", sequence_yaml(simulation_));
  fs::remove(directory_ / kAsked);
  fs::remove(directory_ / kJournal);
}

}  // namespace panvo::simulation
