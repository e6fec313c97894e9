// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/euroc_writer.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "panvo/simulation/sequence_file.hpp"

namespace panvo::simulation {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file) {
  throw std::runtime_error(fmt::format("{}: cannot be written ({}); free space there or name another folder",
                                       file.string(), std::strerror(errno)));
}

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text << std::flush;
  if (!stream) fail(file);
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

std::string eye_yaml(const std::string& side, const vision::DistortedCamera& eye,
                     const Eigen::Isometry3d& base_from_camera, double rate_hz) {
  const auto& p = eye.pinhole;
  std::array<double, 4> distortion{};  // the layout has no place for k3 unless there is one
  std::copy_n(eye.distortion.begin(), 4, distortion.begin());
  const auto coefficients = eye.distortion[4] == 0.0 ? list(distortion) : list(eye.distortion);
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

std::uint64_t estimated_bytes(const Simulation& simulation, ImageFormat format) {
  // Measured on street scenes: what the two formats make of a pixel of one channel.
  const double bytes_per_sample = format == ImageFormat::kJpeg ? 0.35 : 0.75;
  const auto& rig = simulation.parameters().rig;
  const auto& eye = rig.stereo.calibration.left.pinhole;
  double bytes = 0.0;
  for (const auto& instant : simulation.instants()) {
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
  const auto& [stereo, panorama] = parameters.rig;
  if (fs::exists(directory_) && !fs::is_empty(directory_)) {
    throw std::runtime_error(directory_.string() + ": is there already and not empty; name a new folder");
  }
  if (parameters.stereo) {
    add_camera("cam0", eye_yaml("left", stereo.calibration.left, stereo.base_from_left, stereo.rate_hz));
    add_camera("cam1", eye_yaml("right", stereo.calibration.right, stereo.base_from_right(), stereo.rate_hz));
  }
  if (parameters.panorama) {
    for (std::size_t i = 0; i < panorama.heads.size(); ++i) {
      add_camera(fmt::format("cam{}", i + 2), head_yaml(panorama, panorama.heads[i]));
    }
  }
  write_ground_truth();
}

void EurocWriter::add_camera(const std::string& name, const std::string& yaml) {
  Camera camera;
  camera.folder = directory_ / "mav0" / name;
  std::error_code error;
  fs::create_directories(camera.folder / "data", error);
  if (error) throw std::runtime_error(camera.folder.string() + ": cannot be made (" + error.message() + ")");
  write_text(camera.folder / "sensor.yaml", yaml);
  camera.list.open(camera.folder / "data.csv", std::ios::binary);
  camera.list << "#timestamp [ns],filename\n";
  if (!camera.list) fail(camera.folder / "data.csv");
  cameras_.push_back(std::move(camera));
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
  write_image(cameras_.at(0), instant.stamp_ns, images.left);
  write_image(cameras_.at(1), instant.stamp_ns, images.right);
}

void EurocWriter::write(const Instant& instant, const std::vector<cv::Mat>& panorama_heads) {
  const std::size_t first = cameras_.size() - panorama_heads.size();
  for (std::size_t i = 0; i < panorama_heads.size(); ++i) {
    write_image(cameras_.at(first + i), instant.stamp_ns, panorama_heads[i]);
  }
}

void EurocWriter::write_image(Camera& camera, std::int64_t stamp_ns, const cv::Mat& image) {
  const auto name = fmt::format("{}.{}", stamp_ns, format_ == ImageFormat::kJpeg ? "jpg" : "png");
  const auto file = camera.folder / "data" / name;
  cv::Mat bgr = image;
  if (image.channels() == 3) cv::cvtColor(image, bgr, cv::COLOR_RGB2BGR);
  std::vector<unsigned char> bytes;
  const bool is_jpeg = format_ == ImageFormat::kJpeg;
  cv::imencode(
      is_jpeg ? ".jpg" : ".png", bgr, bytes,
      is_jpeg ? std::vector<int>{cv::IMWRITE_JPEG_QUALITY, 95} : std::vector<int>{cv::IMWRITE_PNG_COMPRESSION, 1});
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream) fail(file);
  camera.list << stamp_ns << ',' << name << '\n';
  if (!camera.list) fail(camera.folder / "data.csv");
}

void EurocWriter::finish() {
  for (auto& camera : cameras_) {
    camera.list.close();
    if (!camera.list) fail(camera.folder / "data.csv");
  }
  write_text(directory_ / "sequence.yaml", sequence_yaml(simulation_));
}

}  // namespace panvo::simulation
