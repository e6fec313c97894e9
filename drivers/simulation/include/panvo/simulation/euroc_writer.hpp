// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "panvo/simulation/simulation.hpp"

namespace panvo::simulation {

class RenderJournal;

enum class ImageFormat { kJpeg, kPng };

/// Estimates the bytes of a simulation's images from an instant on, to check the disk space before rendering.
std::uint64_t estimated_bytes(const Simulation& simulation, std::size_t first_instant, ImageFormat format);

/// Writes a simulation as a data set in the EuRoC/ASL layout: mav0/cam0 (left), cam1 (right), cam2 (panorama; cam2 to
/// cam7 for the heads of a rig), each with data.csv, sensor.yaml and data/; state_groundtruth_estimate0 with the pose of
/// base_link at every stamp; and sequence.yaml with junctions, visits, revisits and effects. Every failure to write
/// throws std::runtime_error naming the file.
class EurocWriter {
 public:
  /// Creates the folders and writes everything except images, or resumes an incomplete data set in `directory`. Throws
  /// if that belongs to another simulation (with the first line that differs), or if another process is writing it.
  EurocWriter(std::filesystem::path directory, const Simulation& simulation, ImageFormat format);
  ~EurocWriter();

  /// Number of instants that were already complete, and the exposure after them.
  std::size_t written_before() const { return written_before_; }
  Exposure exposure_before() const;

  void write(const Instant& instant, const Simulation::StereoImages& images);
  void write(const Instant& instant, const std::vector<cv::Mat>& panorama_heads);

  /// Marks an instant as complete, with the exposure for the next one: an interrupted run resumes after it.
  void complete(const Instant& instant, const Exposure& exposure);

  /// Completes the data set by writing sequence.yaml, which marks it as complete.
  void finish();

 private:
  struct Camera {
    bool is_panoramic;
    std::filesystem::path folder;
    std::string description;  // sensor.yaml
    std::ofstream list;       // data.csv
  };
  static bool exposes(const Camera& camera, const Instant& instant);
  std::string image_name(const Instant& instant) const;
  void describe();
  void find_what_is_written();
  void list_images(const Instant& instant);
  void write_ground_truth();
  void write_image(const Camera& camera, const Instant& instant, const cv::Mat& image) const;

  std::filesystem::path directory_;
  const Simulation& simulation_;
  ImageFormat format_;
  std::vector<Camera> cameras_;
  std::unique_ptr<RenderJournal> journal_;
  std::size_t written_before_ = 0;
};

}  // namespace panvo::simulation
