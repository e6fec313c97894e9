// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "panvo/simulation/simulation.hpp"

namespace panvo::simulation {

enum class ImageFormat { kJpeg, kPng };

/// Bytes that the images of a simulation will take on disk, roughly (to ask the disk before anything is rendered).
std::uint64_t estimated_bytes(const Simulation& simulation, ImageFormat format);

/// Writes a simulation as a data set in the EuRoC/ASL layout: mav0/cam0 (left), cam1 (right), cam2 (panorama; cam2 to
/// cam7 for the heads of a rig), each with data.csv, sensor.yaml and data/; state_groundtruth_estimate0 with the pose of
/// base_link at every stamp; and sequence.yaml with junctions, visits, revisits and effects. Every failure to write
/// throws std::runtime_error naming the file.
class EurocWriter {
 public:
  /// Makes the folders and writes what is known before the first image. `directory` must not be there, or be empty.
  EurocWriter(std::filesystem::path directory, const Simulation& simulation, ImageFormat format);

  void write(const Instant& instant, const Simulation::StereoImages& images);
  void write(const Instant& instant, const std::vector<cv::Mat>& panorama_heads);

  /// Completes the data set. Without it there is no sequence.yaml: the mark of a data set that is whole.
  void finish();

 private:
  struct Camera {
    std::filesystem::path folder;
    std::ofstream list;
  };
  void add_camera(const std::string& name, const std::string& sensor_yaml);
  void write_ground_truth();
  void write_image(Camera& camera, std::int64_t stamp_ns, const cv::Mat& image);

  std::filesystem::path directory_;
  const Simulation& simulation_;
  ImageFormat format_;
  std::vector<Camera> cameras_;
};

}  // namespace panvo::simulation
