// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "head_watch.hpp"
#include "panvo/calibration_files/file_error.hpp"
#include "panvo/conversions/image.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/conversions/transform_buffer.hpp"
#include "panvo/interfaces/node_topics.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/panorama_stitcher/head_sets.hpp"
#include "panvo/panorama_stitcher/panorama_stitcher.hpp"
#include "panvo/panorama_stitcher/rig_file.hpp"
#include "panvo/runtime/component.hpp"

namespace panvo::panorama_stitcher {

struct Parameters {
  std::string rig;
  int columns = 1080;
  std::string output = "same";
  bool compensate_gains = false;
  double gain_rate = 0.05;
  double gain_limit = 2.0;
  double tolerance_ms = 5.0;
  int missing_after = 5;
  bool publish_transform = true;
  template <class Field>
  static void describe(Field&& field) {
    using P = Parameters;
    field.path(&P::rig, "rig", "rig file with the heads, their lenses and poses; examples in config/rigs");
    field(&P::columns, "columns", "px", "width of the panorama; the height is half", 64, 8192);
    field(&P::output, "output", "", "encoding of the panorama: that of the heads, or grey", {"same", "mono8"});
    field(&P::compensate_gains, "compensate_gains", "", "equalise the brightness of the heads where they overlap");
    field(&P::gain_rate, "gain_rate", "1", "fraction of the difference to the target gains applied with each panorama",
          0.001, 1.0);
    field(&P::gain_limit, "gain_limit", "1", "gains are limited to 1 / limit ... limit", 1.0, 3.9);
    field(&P::tolerance_ms, "tolerance_ms", "ms", "largest stamp difference of the images in a set", 0.0, 500.0);
    field(&P::missing_after, "missing_after", "1",
          "consecutive sets in which a head is missing or dark before it is left out", 1, 1000);
    field(&P::publish_transform, "publish_transform", "",
          "publish the panorama frame relative to the first head on /tf_static; false if another node does");
  }
};

/// panorama/head_N/image_raw -> panorama/image, with the stamp of the heads; /diagnostics of the heads.
class PanoramaStitcherComponent final : public runtime::Component {
 public:
  explicit PanoramaStitcherComponent(runtime::Context& context)
      : context_(context),
        parameters_(context.parameters<Parameters>()),
        stitcher_(make_stitcher(parameters_)),
        sets_(stitcher_.rig().images(), {.tolerance_ns = static_cast<std::int64_t>(1e6 * parameters_.tolerance_ms),
                                         .missing_after = parameters_.missing_after}),
        watch_(stitcher_.rig(), parameters_.missing_after),
        faults_(stitcher_.rig().images()),
        panoramas_(context.output(topics::kPanorama)),
        diagnostics_(context.output(topics::kDiagnostics)),
        transforms_(context.output(topics::kTfStatic)) {
    for (std::size_t i = 0; i < stitcher_.rig().images(); ++i)
      context.input(topics::kPanoramaHeadImageRaw.at(i), [this, i](const ImagePtr& image) { on_image(i, image); });
  }

 private:
  using ImagePtr = std::shared_ptr<const sensor_msgs::msg::Image>;

  static PanoramaStitcher make_stitcher(const Parameters& parameters) {
    if (parameters.rig.empty())
      throw runtime::ConfigError(
          "parameter rig is empty; set it to a rig file such as config/rigs/dual_fisheye/panorama.yaml");
    try {
      const auto file = read_rig_file(parameters.rig);
      const StitchSettings settings{
          parameters.columns / 2 * 2, parameters.compensate_gains, {parameters.gain_rate, parameters.gain_limit}};
      try {
        return {file.rig, settings};
      } catch (const std::invalid_argument& error) {
        throw runtime::ConfigError(
            fmt::format("{}: {}; correct the poses and fields of view of the heads, or narrow the required range",
                        file.seen_elevation_at, error.what()));
      }
    } catch (const calibration_files::FileError& error) {
      throw runtime::ConfigError(error.what());
    }
  }

  void on_image(std::size_t index, const ImagePtr& image) {
    const std::int64_t stamp_ns = conversions::stamp_ns(*image);
    ++received_;
    if (const auto fault = find_fault(index, *image)) {
      ++rejected_;
      const auto& topic = topics::kPanoramaHeadImageRaw.at(index);
      context_.log().warn_throttled(fmt::format("{} {}", topic.name, *fault), "{} {}; image discarded",
                                    context_.resolved_name(topic), *fault);
      faults_[index] = *fault;
    } else {
      faults_[index].clear();
      for (const auto& set : sets_.push(index, stamp_ns, image)) on_set(set);
    }
    if (!last_report_ns_ || stamp_ns - *last_report_ns_ >= kReportInterval_ns || stamp_ns < *last_report_ns_)
      report(stamp_ns);
  }

  std::optional<std::string> find_fault(std::size_t index, const sensor_msgs::msg::Image& image) const {
    const auto pixels = conversions::view(image);
    if (!pixels) return pixels.reason();
    return stitcher_.find_fault(index, *pixels);
  }

  void on_set(const HeadSets<ImagePtr>::Set& set) {
    std::vector<cv::Mat> images;
    const sensor_msgs::msg::Image* first = nullptr;
    for (const auto& image : set.items) {
      images.push_back(image ? *conversions::view(**image) : cv::Mat());
      if (!image) continue;
      if (first == nullptr) first = image->get();
      if ((*image)->encoding() != first->encoding()) return say_mixed((*image)->encoding(), first->encoding());
    }
    if (watch_.look(images)) on_change(set.stamp_ns);
    if (!has_usable_head()) return;
    if (parameters_.publish_transform && set.items.front()) publish_transform(**set.items.front());
    publish_panorama(images, set.stamp_ns, first->encoding());
  }

  bool has_usable_head() const {
    const auto usable = watch_.usable();
    return std::find(usable.begin(), usable.end(), true) != usable.end();
  }

  void on_change(std::int64_t stamp_ns) {
    for (std::size_t i = 0; i < stitcher_.rig().heads.size(); ++i) {
      const auto& name = stitcher_.rig().heads[i].name;
      if (watch_.is_usable(i) == was_usable(i)) continue;
      if (watch_.is_usable(i)) {
        context_.log().info_throttled(name + " is seen", "head '{}' is seen again", name);
      } else {
        context_.log().warn_throttled(
            name, "head '{}' is {}; continuing without it: check its cable, power and lens cap", name, watch_.state(i));
      }
    }
    usable_ = watch_.usable();
    const runtime::StageTimer timer(context_.times(), "make_table");
    stitcher_.use(usable_);
    report(stamp_ns);
  }

  bool was_usable(std::size_t head) const { return usable_.empty() || usable_[head]; }

  void publish_panorama(const std::vector<cv::Mat>& images, std::int64_t stamp_ns, const std::string& encoding) {
    const runtime::StageTimer timer(context_.times(), "stitch");
    const int columns = stitcher_.table().columns;
    const int rows = stitcher_.table().rows;
    const bool turns_grey = parameters_.output == "mono8" && encoding != "mono8" && encoding != "8UC1";
    const auto message =
        conversions::make_image(stamp_ns, stitcher_.rig().frame_id, turns_grey ? "mono8" : encoding, columns, rows);
    cv::Mat pixels = conversions::pixels(*message);
    if (turns_grey) {
      stitcher_.stitch(images, colour_);
      cv::cvtColor(colour_, pixels, encoding == "rgb8" ? cv::COLOR_RGB2GRAY : cv::COLOR_BGR2GRAY);
    } else {
      stitcher_.stitch(images, pixels);
    }
    ++stitched_;
    panoramas_.publish(ImagePtr(message));
  }

  /// Publishes the panorama frame as a child of the first head's frame.
  void publish_transform(const sensor_msgs::msg::Image& image) {
    const auto& parent = image.header().frame_id();
    const auto& child = stitcher_.rig().frame_id;
    if (parent == transform_parent_ || parent == child || parent.empty()) return;
    transform_parent_ = parent;
    std::size_t head = 0;
    while (stitcher_.rig().heads[head].image != 0) ++head;
    tf2_msgs::msg::TFMessage message;
    message.transforms().push_back(conversions::to_static_transform(
        conversions::stamp_ns(image), parent, child, stitcher_.rig().heads[head].panorama_from_head.inverse()));
    transforms_.publish(std::move(message));
  }

  void say_mixed(const std::string& one, const std::string& other) {
    ++rejected_;
    context_.log().warn_throttled(
        "mixed", "the heads' images have encodings {} and {}; set all cameras to the same encoding", one, other);
  }

  /// Publishes one diagnostic status for the rig.
  void report(std::int64_t stamp_ns) {
    last_report_ns_ = stamp_ns;
    diagnostic_msgs::msg::DiagnosticStatus status;
    status.name("panvo: " + context_.name() + " heads");
    status.hardware_id("none");
    const auto add = [&](const std::string& key, const std::string& value) {
      diagnostic_msgs::msg::KeyValue entry;
      entry.key(key);
      entry.value(value);
      status.values().push_back(entry);
    };
    add("panoramas", fmt::format("{} stitched from {} images, {} rejected", stitched_, received_, rejected_));
    std::vector<std::string> bad;
    const auto& heads = stitcher_.rig().heads;
    for (std::size_t i = 0; i < heads.size(); ++i) {
      const bool is_missing = sets_.is_missing(heads[i].image);
      const auto& fault = faults_[heads[i].image];
      const std::string state = !fault.empty() ? "rejected, " + fault : is_missing ? "missing" : watch_.state(i);
      add("head " + heads[i].name,
          parameters_.compensate_gains ? fmt::format("{}, gain {:.3f}", state, stitcher_.gain(i)) : state);
      if (state != "seen") bad.push_back(fmt::format("'{}' {}", heads[i].name, state));
    }
    for (std::size_t i = 0; i < faults_.size(); ++i)
      add(fmt::format("{} unpaired", topics::kPanoramaHeadImageRaw.at(i).name), std::to_string(sets_.unpaired(i)));
    constexpr std::uint8_t kOk = 0, kWarning = 1;  // as in diagnostic_msgs/msg/DiagnosticStatus
    status.level(bad.empty() ? kOk : kWarning);
    status.message(bad.empty() ? "all heads are seen" : fmt::format("heads: {}", fmt::join(bad, "; ")));
    diagnostic_msgs::msg::DiagnosticArray array;
    array.header().stamp(conversions::to_stamp(stamp_ns));
    array.status().push_back(std::move(status));
    diagnostics_.publish(std::move(array));
  }

  static constexpr std::int64_t kReportInterval_ns = 1'000'000'000;

  runtime::Context& context_;
  Parameters parameters_;
  PanoramaStitcher stitcher_;
  HeadSets<ImagePtr> sets_;
  HeadWatch watch_;
  std::vector<std::string> faults_;  ///< of the newest image of each camera
  std::vector<bool> usable_;
  runtime::Output<sensor_msgs::msg::Image> panoramas_;
  runtime::Output<diagnostic_msgs::msg::DiagnosticArray> diagnostics_;
  runtime::Output<tf2_msgs::msg::TFMessage> transforms_;
  cv::Mat colour_;
  std::string transform_parent_;
  std::optional<std::int64_t> last_report_ns_;
  std::uint64_t received_ = 0, rejected_ = 0, stitched_ = 0;
};

PANVO_REGISTER_COMPONENT(PanoramaStitcherComponent)

}  // namespace panvo::panorama_stitcher
