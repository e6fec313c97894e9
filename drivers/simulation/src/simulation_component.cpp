// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "panvo/conversions/camera_info.hpp"
#include "panvo/conversions/image.hpp"
#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/conversions/transform_buffer.hpp"
#include "panvo/interfaces/node_topics.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/component.hpp"
#include "panvo/simulation/simulation.hpp"

namespace panvo::simulation {

struct ComponentParameters {
  std::string route;                   // route file
  std::vector<std::string> junctions;  // or a custom route
  int random_junctions = 0;            // or a random route
  std::string rig;                     // rig file
  std::vector<std::string> effects;
  std::string assets;
  std::string cameras = "all";
  int seed = 1;
  double hilliness = 0.0;
  double hour = 10.5;
  std::string season = "summer";
  bool overcast = false;
  bool night = false;
  bool wet = false;
  double vibration = 1.0;
  double calibration_error = 0.0;
  double start_s = 0.0;
  double duration_s = 0.0;
  template <class Field>
  static void describe(Field&& field) {
    using P = ComponentParameters;
    field.path(&P::route, "route", "route file, as in config/routes");
    field(&P::junctions, "junctions", "", "custom route: junctions of the campus, successive ones joined by a road");
    field(&P::random_junctions, "random_junctions", "1", "number of junctions of a random route, drawn from the seed",
          0, 1000);
    field.path(&P::rig, "rig", "rig file, as config/rigs/paper/rig.yaml; empty: the paper's rig");
    field(&P::effects, "effects", "",
          "effects: sudden_light, sun_drift, movers, weak_texture, rain, smear, dropped_frames, time_offset, all");
    field.path(&P::assets, "assets", "folder of photographs, MATERIAL.jpg, in place of painted textures");
    field(&P::cameras, "cameras", "", "cameras to render", {"all", "stereo", "panorama"});
    field(&P::seed, "seed", "1", "seed of the world, the motion and the noise", 0, 1'000'000'000);
    field(&P::hilliness, "hilliness", "1", "0: flat, 1: hills of 8 m", 0.0, 2.0);
    field(&P::hour, "hour", "h", "hour of the day at the start", 6.0, 18.0);
    field(&P::season, "season", "", "bare: trees without leaves; snow: also snow on what faces upwards",
          {"summer", "bare", "snow"});
    field(&P::overcast, "overcast", "", "a closed layer of clouds, no shadows");
    field(&P::night, "night", "", "street lamps and lit windows instead of the sun");
    field(&P::wet, "wet", "", "after rain: roads and pavements mirror, under clouds; not in snow");
    field(&P::vibration, "vibration", "1", "scale of the vehicle's vibration; 0: none", 0.0, 10.0);
    field(&P::calibration_error, "calibration_error", "1",
          "error of the published stereo calibration; 0: exact, 1: a good one after months of driving", 0.0, 100.0);
    field(&P::start_s, "start_s", "s", "start time on the journey", 0.0, 1e6);
    field(&P::duration_s, "duration_s", "s", "duration; 0: to the end", 0.0, 1e6);
  }
};

namespace {

Route route_of(const ComponentParameters& parameters) {
  if (!parameters.junctions.empty()) return {"custom", parameters.junctions, ""};
  if (!parameters.route.empty()) return read_route(parameters.route);
  const auto seed = static_cast<std::uint64_t>(parameters.seed);
  if (parameters.random_junctions > 1)
    return random_route(simulated_world::campus_roads(seed), parameters.random_junctions, seed);
  throw std::runtime_error(
      "parameter route: no route is given; set route to a file, junctions to a list, or random_junctions to a number");
}

SimulationParameters to_simulation(const ComponentParameters& parameters) {
  SimulationParameters simulation;
  simulation.route = route_of(parameters);
  if (!parameters.rig.empty()) simulation.rig = read_rig(parameters.rig);
  simulation.effects = effects_of(parameters.effects);
  simulation.motion.vibration = parameters.vibration;
  simulation.calibration_error = parameters.calibration_error;
  simulation.seed = static_cast<std::uint64_t>(parameters.seed);
  simulation.hilliness = parameters.hilliness;
  simulation.day.hour = parameters.hour;
  simulation.day.season = season_of(parameters.season);
  simulation.day.overcast = parameters.overcast;
  simulation.day.night = parameters.night;
  simulation.day.wet = parameters.wet;
  simulation.assets = parameters.assets;
  simulation.start_s = parameters.start_s;
  simulation.duration_s = parameters.duration_s;
  simulation.stereo = parameters.cameras != "panorama";
  simulation.panorama = parameters.cameras != "stereo";
  return simulation;
}

}  // namespace

/// The simulated vehicle: publishes what a vehicle with this rig would, and the ground truth, on a simulated clock.
class SimulationComponent final : public runtime::Component, public runtime::Source {
 public:
  explicit SimulationComponent(runtime::Context& context);

  std::optional<std::int64_t> next_stamp_ns() override;
  void emit() override;
  Progress progress() const override { return {next_, simulation_->instants().size()}; }

 private:
  using ImagePtr = std::shared_ptr<const sensor_msgs::msg::Image>;
  struct Camera {
    std::string frame_id;
    runtime::Output<sensor_msgs::msg::Image> images;
    std::optional<runtime::Output<sensor_msgs::msg::CameraInfo>> infos;  // nullopt: not needed for a panorama
    sensor_msgs::msg::CameraInfo info;                                   // without stamp
  };

  void open_stereo(const StereoCamera& stereo);
  void open_panorama(const PanoramicCamera& panorama);
  void publish_clock(std::int64_t stamp_ns);
  void publish_static_transforms(std::int64_t stamp_ns);
  void publish_ground_truth(const Instant& instant);
  void publish_info(Camera& camera, std::int64_t stamp_ns);
  static ImagePtr to_message(const cv::Mat& pixels, std::int64_t stamp_ns, const std::string& frame_id);

  runtime::Context& context_;
  std::optional<Simulation> simulation_;
  std::vector<Camera> eyes_, heads_;
  runtime::Output<tf2_msgs::msg::TFMessage> static_transforms_;
  runtime::Output<nav_msgs::msg::Odometry> ground_truth_;
  runtime::Output<rosgraph_msgs::msg::Clock> clock_;
  std::size_t next_ = 0;
};

SimulationComponent::SimulationComponent(runtime::Context& context)
    : context_(context),
      static_transforms_(context.output(topics::kTfStatic)),
      ground_truth_(context.output(topics::kGroundTruth)),
      clock_(context.output(topics::kClock)) {
  const auto parameters = context.parameters<ComponentParameters>();
  try {
    simulation_.emplace(to_simulation(parameters));
  } catch (const std::exception& error) {
    throw runtime::ConfigError(error.what());
  }
  const auto& rig = simulation_->parameters().rig;
  if (simulation_->parameters().stereo) open_stereo(rig.stereo);
  if (simulation_->parameters().panorama) open_panorama(rig.panorama);
  const auto& motion = simulation_->motion();
  context.log().info("route {} on the campus of seed {}: {:.0f} m in {:.0f} s, effects: {}",
                     simulation_->parameters().route.name, parameters.seed, motion.travelled_m(motion.duration_s()),
                     motion.duration_s(),
                     fmt::format("{}", fmt::join(names_of(simulation_->parameters().effects), " ")));
  context.source(*this);
}

void SimulationComponent::open_stereo(const StereoCamera& stereo) {
  const auto rectified = vision::rectify(stereo.calibration);
  const auto eye = [&](const char* frame_id, const auto& image_topic, const auto& info_topic,
                       const conversions::PairedCamera& geometry) {
    eyes_.push_back({frame_id, context_.output(image_topic), context_.output(info_topic),
                     conversions::to_camera_info(geometry, 0, frame_id)});
  };
  eye("stereo_left_optical", topics::kStereoLeftImageRaw, topics::kStereoLeftCameraInfo,
      conversions::left_camera(stereo.calibration, rectified));
  eye("stereo_right_optical", topics::kStereoRightImageRaw, topics::kStereoRightCameraInfo,
      conversions::right_camera(stereo.calibration, rectified));
}

void SimulationComponent::open_panorama(const PanoramicCamera& panorama) {
  if (panorama.kind == PanoramaKind::kEquirectangular) {
    heads_.push_back({panorama.heads.front().frame_id, context_.output(topics::kPanorama), std::nullopt, {}});
    return;
  }
  for (std::size_t i = 0; i < panorama.heads.size(); ++i) {
    const auto& head = panorama.heads[i];
    const auto& p = head.fisheye.pinhole;
    sensor_msgs::msg::CameraInfo info;
    info.header().frame_id(head.frame_id);
    info.width(static_cast<std::uint32_t>(head.width));
    info.height(static_cast<std::uint32_t>(head.height));
    info.distortion_model("equidistant");
    info.d().assign(head.fisheye.distortion.begin(), head.fisheye.distortion.end());
    info.k({p.fx, 0, p.cx, 0, p.fy, p.cy, 0, 0, 1});
    info.r({1, 0, 0, 0, 1, 0, 0, 0, 1});
    info.p({p.fx, 0, p.cx, 0, 0, p.fy, p.cy, 0, 0, 0, 1, 0});
    heads_.push_back({head.frame_id, context_.output(topics::kPanoramaHeadImageRaw[i]),
                      context_.output(topics::kPanoramaHeadCameraInfo[i]), info});
  }
}

std::optional<std::int64_t> SimulationComponent::next_stamp_ns() {
  if (next_ == simulation_->instants().size()) return std::nullopt;
  return simulation_->instants()[next_].stamp_ns;
}

void SimulationComponent::emit() {
  const auto& instant = simulation_->instants()[next_];
  publish_clock(instant.stamp_ns);
  if (next_ == 0) publish_static_transforms(instant.stamp_ns);
  publish_ground_truth(instant);
  if (instant.stereo_frame) {
    const auto images = [&] {
      const runtime::StageTimer timer(context_.times(), "render_stereo");
      return simulation_->render_stereo(instant);
    }();
    for (auto& eye : eyes_) publish_info(eye, instant.stamp_ns);
    eyes_[0].images.publish(to_message(images.left, instant.stamp_ns, eyes_[0].frame_id));
    eyes_[1].images.publish(to_message(images.right, instant.stamp_ns, eyes_[1].frame_id));
  }
  if (instant.panorama_frame) {
    const auto images = [&] {
      const runtime::StageTimer timer(context_.times(), "render_panorama");
      return simulation_->render_panorama(instant);
    }();
    for (std::size_t i = 0; i < heads_.size(); ++i) {
      publish_info(heads_[i], instant.stamp_ns);
      heads_[i].images.publish(to_message(images[i], instant.stamp_ns, heads_[i].frame_id));
    }
  }
  ++next_;
}

void SimulationComponent::publish_clock(std::int64_t stamp_ns) {
  rosgraph_msgs::msg::Clock message;
  message.clock(conversions::to_stamp(stamp_ns));
  clock_.publish(std::move(message));
}

void SimulationComponent::publish_static_transforms(std::int64_t stamp_ns) {
  tf2_msgs::msg::TFMessage message;
  const auto place = [&](const std::string& frame_id, const Eigen::Isometry3d& base_from_camera) {
    message.transforms().push_back(conversions::to_static_transform(stamp_ns, "base_link", frame_id, base_from_camera));
  };
  const auto& stereo = simulation_->parameters().rig.stereo;
  const auto& panorama = simulation_->parameters().rig.panorama;
  if (!eyes_.empty()) {
    place(eyes_[0].frame_id, stereo.base_from_left);
    place(eyes_[1].frame_id, stereo.base_from_right());
  }
  for (std::size_t i = 0; i < heads_.size(); ++i) place(heads_[i].frame_id, panorama.heads[i].base_from_head);
  static_transforms_.publish(std::move(message));
}

void SimulationComponent::publish_ground_truth(const Instant& instant) {
  const auto& motion = simulation_->motion();
  nav_msgs::msg::Odometry message;
  message.header().stamp(conversions::to_stamp(instant.stamp_ns));
  message.header().frame_id("map");
  message.child_frame_id("base_link");
  message.pose().pose(conversions::to_pose(motion.world_from_base(instant.t_s)));
  const auto twist = motion.twist(instant.t_s);
  auto& linear = message.twist().twist().linear();
  linear.x(twist[0]);
  linear.y(twist[1]);
  linear.z(twist[2]);
  auto& angular = message.twist().twist().angular();
  angular.x(twist[3]);
  angular.y(twist[4]);
  angular.z(twist[5]);
  ground_truth_.publish(std::move(message));
}

void SimulationComponent::publish_info(Camera& camera, std::int64_t stamp_ns) {
  if (!camera.infos) return;
  camera.info.header().stamp(conversions::to_stamp(stamp_ns));
  camera.infos->publish(sensor_msgs::msg::CameraInfo(camera.info));
}

SimulationComponent::ImagePtr SimulationComponent::to_message(const cv::Mat& pixels, std::int64_t stamp_ns,
                                                              const std::string& frame_id) {
  const auto* encoding = pixels.channels() == 1 ? "mono8" : "rgb8";
  const auto image = conversions::make_image(stamp_ns, frame_id, encoding, pixels.cols, pixels.rows);
  pixels.copyTo(conversions::pixels(*image));
  return image;
}

PANVO_REGISTER_COMPONENT(SimulationComponent)

}  // namespace panvo::simulation
