// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "http.hpp"

namespace panvo::web_view {

/// By the extension of the file name; "application/octet-stream" if it is unknown.
std::string_view content_type_of(const std::filesystem::path& file);

/// Where the page lies: share/panvo/web_view/page of the prefix from which this library was loaded, or
/// components/web_view/page/dist of the build or source folder. Empty: it was not built.
std::filesystem::path default_page_folder();

/// Files of a web page, which browsers ask for again only if they have changed. Thread-safe.
class Page {
 public:
  /// `folder`: empty if there is no page, which get() then explains.
  explicit Page(std::filesystem::path folder) : folder_(std::move(folder)) {}

  HttpResponse get(const HttpRequest& request) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace panvo::web_view
