// SPDX-License-Identifier: Apache-2.0
#include "bag_files.hpp"

#include <algorithm>
#include <cctype>
#include <set>
#include <utility>

#include "open_database.hpp"
#include "panvo/recorder/bag_error.hpp"

namespace panvo::recorder {
namespace {

namespace fs = std::filesystem;

/// "bag_10.db3" after "bag_9.db3": by the number before the ending, then by name.
std::pair<unsigned long long, std::string> recording_order(const fs::path& file) {
  const auto stem = file.stem().string();
  const auto last = stem.find_last_not_of("0123456789");
  const auto digits = stem.substr(last == std::string::npos ? 0 : last + 1);
  const bool numbered = !digits.empty() && digits.size() < 19;
  return {numbered ? std::stoull(digits) : 0, stem};
}

std::vector<fs::path> files_ending_in(const fs::path& folder, const std::string& ending) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && entry.path().filename().string().ends_with(ending)) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end(),
            [](const auto& a, const auto& b) { return recording_order(a) < recording_order(b); });
  return files;
}

void refuse_other_storage(const fs::path& bag, const BagMetadata& metadata) {
  if (metadata.storage_identifier == "mcap") {
    throw BagError(bag.string() + ": is stored as MCAP, which is not read here; " + how_to_convert(bag));
  }
  if (metadata.storage_identifier != "sqlite3") {
    throw BagError(bag.string() + ": is stored as '" + metadata.storage_identifier + "', which is not read here; " +
                   how_to_convert(bag));
  }
  auto mode = metadata.compression_mode;
  std::transform(mode.begin(), mode.end(), mode.begin(), [](unsigned char c) { return std::tolower(c); });
  if (metadata.compression_format.empty() || mode.empty() || mode == "none") {
    return;
  }
  throw BagError(bag.string() + ": is compressed (" + metadata.compression_format + ", mode " + mode +
                 "), which is not read here; " +
                 (mode == "file" ? "unpack its files with `zstd -d --rm " + (bag / "*.zstd").string() +
                                       "` and run `panvo bag reindex`"
                                 : how_to_convert(bag)));
}

/// A path in metadata.yaml is relative to the bag; early versions wrote it relative to the bag's parent. Never
/// outside the bag.
fs::path locate(const fs::path& bag, const std::string& written) {
  const auto inside = (bag / written).lexically_normal();
  const auto relative = inside.lexically_relative(bag.lexically_normal());
  const bool is_inside = !relative.empty() && *relative.begin() != "..";
  return is_inside && fs::exists(inside) ? inside : bag / fs::path(written).filename();
}

}  // namespace

BagFiles find_bag_files(const fs::path& bag, bool use_metadata, std::vector<std::string>& warnings) {
  if (!fs::exists(bag)) {
    throw BagError(bag.string() + ": does not exist");
  }
  BagFiles found;
  if (!fs::is_directory(bag)) {
    found.folder = bag.parent_path();
    found.databases = {bag};
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
    warnings.push_back(metadata_file.string() +
                       ": is missing; taken from the databases, `panvo bag reindex` writes it");
  }
  if (use_metadata && found.metadata) {
    refuse_other_storage(bag, *found.metadata);
  }

  std::set<fs::path> listed;
  if (use_metadata && found.metadata) {
    for (const auto& file : found.metadata->files) {
      const auto path = locate(bag, file.path);
      if (fs::exists(path)) {
        found.databases.push_back(path);
      } else {
        ++found.missing;
        warnings.push_back(path.string() + ": is missing; its messages are lost to this bag");
      }
      listed.insert(path);
    }
  }
  for (const auto& path : files_ending_in(bag, ".db3")) {
    if (listed.contains(path)) {
      continue;
    }
    found.databases.push_back(path);
    if (use_metadata && found.metadata) {
      warnings.push_back(path.string() + ": is not listed in " + kMetadataFile +
                         " (was the recorder killed?), but read all the same");
    }
  }
  if (!found.databases.empty()) {
    return found;
  }
  if (!files_ending_in(bag, ".mcap").empty()) {
    throw BagError(bag.string() + ": is stored as MCAP, which is not read here; " + how_to_convert(bag));
  }
  if (!files_ending_in(bag, ".db3.zstd").empty()) {
    throw BagError(bag.string() + ": is compressed; unpack its files with `zstd -d --rm " + (bag / "*.zstd").string() +
                   "` and run `panvo bag reindex`");
  }
  throw BagError(bag.string() + (listed.empty()
                                     ? ": is not a bag: it holds neither metadata.yaml nor a .db3 file"
                                     : ": none of its database files is there; copy them beside metadata.yaml"));
}

}  // namespace panvo::recorder
