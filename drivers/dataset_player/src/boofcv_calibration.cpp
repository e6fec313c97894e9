// SPDX-License-Identifier: Apache-2.0
#include <tinyxml2.h>

#include "calibration_values.hpp"
#include "panvo/dataset_player/calibration_file.hpp"

namespace panvo::dataset_player {
namespace {

using calibration_files::FileError;

/// Reads elements of an XML file by name. Errors give file and line.
class XmlReader {
 public:
  explicit XmlReader(std::filesystem::path file) : file_(std::move(file)) {
    if (document_.LoadFile(file_.c_str()) != tinyxml2::XML_SUCCESS) {
      const auto line = document_.ErrorLineNum() > 0 ? ":" + std::to_string(document_.ErrorLineNum()) : std::string();
      throw FileError(file_.string() + line + ": cannot be read as XML (" + document_.ErrorName() +
                      "); was the file cut off?");
    }
  }

  const tinyxml2::XMLElement& root() const {
    if (document_.RootElement() == nullptr)
      throw FileError(file_.string() + ": contains no element; was the file cut off?");
    return *document_.RootElement();
  }

  const tinyxml2::XMLElement* find(const tinyxml2::XMLElement& parent, const char* name) const {
    return parent.FirstChildElement(name);
  }

  /// The child with either name; BoofCV changed the case of some names between versions.
  const tinyxml2::XMLElement& child(const tinyxml2::XMLElement& parent, const char* name,
                                    const char* other_name = nullptr) const {
    const auto* element = parent.FirstChildElement(name);
    if (element == nullptr && other_name != nullptr) element = parent.FirstChildElement(other_name);
    if (element == nullptr) fail(parent, std::string("has no element <") + name + ">");
    return *element;
  }

  double number(const tinyxml2::XMLElement& element) const {
    double value = 0.0;
    if (element.QueryDoubleText(&value) != tinyxml2::XML_SUCCESS) fail(element, "must contain a number");
    return value;
  }

  std::vector<double> list(const tinyxml2::XMLElement& parent) const {
    std::vector<double> values;
    for (const auto* item = parent.FirstChildElement("double"); item != nullptr;
         item = item->NextSiblingElement("double")) {
      values.push_back(number(*item));
    }
    return values;
  }

  [[noreturn]] void fail(const tinyxml2::XMLElement& element, const std::string& what) const {
    throw FileError(file_.string() + ":" + std::to_string(element.GetLineNum()) + ": <" + element.Name() + "> " + what +
                    "; expected a BoofCV StereoParameters file");
  }

 private:
  std::filesystem::path file_;
  tinyxml2::XMLDocument document_;
};

vision::LensCamera read_camera(const XmlReader& xml, const tinyxml2::XMLElement& element) {
  const auto value = [&](const char* name) { return xml.number(xml.child(element, name)); };
  const auto pixels = [&](const char* name) {
    const double length = value(name);
    if (!(length >= 1.0 && length <= 65536.0)) xml.fail(xml.child(element, name), "must be from 1 to 65536 px");
    return static_cast<int>(length);
  };
  vision::LensCamera camera;
  camera.pinhole = {value("fx"), value("fy"), value("cx"), value("cy"), pixels("width"), pixels("height")};
  if (xml.find(element, "skew") != nullptr && value("skew") != 0.0) {
    xml.fail(xml.child(element, "skew"), "is not zero: skewed pixels are not supported; calibrate with zero skew");
  }
  if (const auto* radial = xml.find(element, "radial")) {
    const auto k = xml.list(*radial);
    if (k.size() > 3) xml.fail(*radial, "has more than three coefficients; calibrate with two or three");
    constexpr std::array<std::size_t, 3> kPlaces{0, 1, 4};  // indices of k1, k2, k3 in k1 k2 p1 p2 k3
    for (std::size_t i = 0; i < k.size(); ++i) camera.distortion[kPlaces[i]] = k[i];
  }
  if (xml.find(element, "t1") != nullptr) camera.distortion[2] = value("t1");
  if (xml.find(element, "t2") != nullptr) camera.distortion[3] = value("t2");
  return camera;
}

Eigen::Isometry3d read_right_to_left(const XmlReader& xml, const tinyxml2::XMLElement& element) {
  const auto& rotation = xml.child(element, "R", "r");
  const auto values = xml.list(xml.child(rotation, "data"));
  if (values.size() != 9) xml.fail(rotation, "must contain nine numbers");
  const auto& translation = xml.child(element, "T", "t");
  Eigen::Isometry3d left_from_right = Eigen::Isometry3d::Identity();
  left_from_right.linear() = Eigen::Map<const RowMajor3d>(values.data());
  const auto component = [&](const char* name) { return xml.number(xml.child(translation, name)); };
  left_from_right.translation() = Eigen::Vector3d(component("x"), component("y"), component("z"));
  return left_from_right;
}

}  // namespace

CalibratedStereo read_boofcv_calibration(const std::filesystem::path& file) {
  const XmlReader xml(file);
  CalibratedStereo stereo;
  stereo.calibration.left = read_camera(xml, xml.child(xml.root(), "left"));
  stereo.calibration.right = read_camera(xml, xml.child(xml.root(), "right"));
  stereo.calibration.right_from_left = read_right_to_left(xml, xml.child(xml.root(), "rightToLeft")).inverse();
  stereo.rectified = rectified_geometry(stereo.calibration, file);
  return stereo;
}

}  // namespace panvo::dataset_player
