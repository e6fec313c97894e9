// SPDX-License-Identifier: Apache-2.0
#include "bag_files.hpp"

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

#include "panvo/recorder/bag_error.hpp"

namespace panvo::recorder {
namespace {

namespace fs = std::filesystem;

bool is_bag_file(const fs::path& file) {
  auto name = file.filename().string();
  if (name.ends_with(".zstd")) {
    name.resize(name.size() - std::string_view(".zstd").size());
  }
  return name.ends_with(".db3") || name.ends_with(".mcap");
}

/// Sort key: the number before the extension, then the name; "bag_10.db3" comes after "bag_9.db3".
std::pair<unsigned long long, std::string> recording_order(const fs::path& file) {
  const auto stem = (file.extension() == ".zstd" ? file.stem().stem() : file.stem()).string();
  const auto last = stem.find_last_not_of("0123456789");
  const auto digits = stem.substr(last == std::string::npos ? 0 : last + 1);
  const bool numbered = !digits.empty() && digits.size() < 19;
  return {numbered ? std::stoull(digits) : 0, stem};
}

std::vector<fs::path> bag_files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && is_bag_file(entry.path())) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end(),
            [](const auto& a, const auto& b) { return recording_order(a) < recording_order(b); });
  return files;
}

void refuse_other_storage(const fs::path& bag, const BagMetadata& metadata) {
  const auto convert =
      "convert it on a machine with ROS 2: `ros2 bag convert -i " + bag.string() +
      " -o out.yaml` with out.yaml: `output_bags: [{uri: converted, storage_id: mcap, all_topics: true}]`";
  if (metadata.storage_identifier != "sqlite3" && metadata.storage_identifier != "mcap") {
    throw BagError(bag.string() + ": storage '" + metadata.storage_identifier + "' is not supported; " + convert);
  }
  if (!metadata.compression_format.empty() && metadata.compression_format != "zstd" &&
      metadata.compression_format != "none") {
    throw BagError(bag.string() + ": compression '" + metadata.compression_format + "' is not supported; " + convert);
  }
}

/// Resolves a path of metadata.yaml. It is relative to the bag, in early versions to the bag's parent. The result is
/// always inside the bag.
fs::path locate(const fs::path& bag, const std::string& written) {
  const auto inside = (bag / written).lexically_normal();
  const auto relative = inside.lexically_relative(bag.lexically_normal());
  const bool is_inside = !relative.empty() && *relative.begin() != "..";
  return is_inside && fs::exists(inside) ? inside : bag / fs::path(written).filename();
}

}  // namespace

bool is_bag(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return fs::exists(path, error) && is_bag_file(path);
  if (fs::exists(path / kMetadataFile, error)) return true;
  return std::ranges::any_of(fs::directory_iterator(path, error),
                             [](const auto& entry) { return is_bag_file(entry.path()); });
}

BagFiles find_bag_files(const fs::path& bag, bool use_metadata, std::vector<std::string>& warnings) {
  if (!fs::exists(bag)) {
    throw BagError(bag.string() + ": does not exist");
  }
  BagFiles found;
  if (!fs::is_directory(bag)) {
    found.folder = bag.parent_path();
    found.files = {bag};
    return found;
  }
  found.folder = bag;
  const auto metadata_file = bag / kMetadataFile;
  if (fs::exists(metadata_file)) {
    try {
      found.metadata = read_metadata(bag);
    } catch (const BagError& error) {
      if (use_metadata) {
        warnings.push_back(error.what());
      }
    }
  } else if (use_metadata) {
    warnings.push_back(metadata_file.string() + ": is missing; rebuilt from the files (`panvo bag reindex` writes it)");
  }
  if (use_metadata && found.metadata) {
    refuse_other_storage(bag, *found.metadata);
  }

  std::set<fs::path> listed;
  if (use_metadata && found.metadata) {
    for (const auto& file : found.metadata->files) {
      const auto path = locate(bag, file.path);
      if (fs::exists(path)) {
        found.files.push_back(path);
      } else {
        ++found.missing;
        warnings.push_back(path.string() + ": is missing; its messages are lost");
      }
      listed.insert(path);
    }
  }
  const auto is_copy_of_another = [&](const fs::path& path) {
    return listed.contains(path.string() + ".zstd") || (path.extension() == ".zstd" && fs::exists(bag / path.stem()));
  };
  for (const auto& path : bag_files_in(bag)) {
    if (listed.contains(path) || is_copy_of_another(path)) {
      continue;
    }
    found.files.push_back(path);
    if (use_metadata && found.metadata) {
      warnings.push_back(path.string() + ": is not listed in " + kMetadataFile +
                         " (was the recorder killed?) but is read anyway");
    }
  }
  if (!found.files.empty()) {
    return found;
  }
  throw BagError(bag.string() + (listed.empty()
                                     ? ": is not a bag: it contains neither metadata.yaml nor a .db3 or .mcap file"
                                     : ": none of its files exist; copy them next to metadata.yaml"));
}

}  // namespace panvo::recorder
