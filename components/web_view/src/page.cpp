// SPDX-License-Identifier: Apache-2.0
#include "page.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

#include "files_below.hpp"

namespace panvo::web_view {
namespace {

namespace fs = std::filesystem;

/// Changes with the file.
std::string version_of(const fs::path& file) {
  const auto written = fs::last_write_time(file).time_since_epoch();
  return '"' + std::to_string(written.count()) + '-' + std::to_string(fs::file_size(file)) + '"';
}

/// Whether a header Host may be repeated in an answer.
bool is_plain_host(std::string_view host) {
  return !host.empty() && host.size() <= 255 && std::ranges::all_of(host, [](char letter) {
    return is_word_character(letter) || std::string_view(".-:[]").find(letter) != std::string_view::npos;
  });
}

/// The page runs only its own scripts, connects only to this server, and stands in no frame. Addresses that contain the
/// token are not told to other servers.
void add_security(HttpResponse& response, const std::string& host) {
  // Older browsers do not count ws: of the same host as 'self'.
  const std::string sockets = is_plain_host(host) ? " ws://" + host + " wss://" + host : "";
  response.headers.emplace_back("Content-Security-Policy",
                                "default-src 'self'; connect-src 'self'" + sockets +
                                    "; img-src 'self' data: blob:; style-src 'self' 'unsafe-inline'; "
                                    "worker-src 'self' blob:; object-src 'none'; base-uri 'none'; form-action 'none'; "
                                    "frame-ancestors 'none'");
  response.headers.emplace_back("X-Content-Type-Options", "nosniff");
  response.headers.emplace_back("Referrer-Policy", "no-referrer");
  response.headers.emplace_back("Cross-Origin-Opener-Policy", "same-origin");
  response.headers.emplace_back("Cross-Origin-Resource-Policy", "same-origin");
}

HttpResponse explanation(const std::string& host, bool is_secure) {
  const std::string address = std::string(is_secure ? "wss://" : "ws://") + (is_plain_host(host) ? host : "HOST:PORT");
  HttpResponse response{404, "text/html; charset=utf-8", {}, {}};
  response.body =
      "<!doctype html><html lang=\"en\"><meta name=\"viewport\" content=\"width=device-width\"><title>panvo</title>\n"
      "<h1>panvo is running, without its page</h1>\n"
      "<p>The page was not built. To build it, install Debian's <code>nodejs</code> and <code>npm</code>, then run\n"
      "<code>panvo build</code>, and start the view again.</p>\n"
      "<p>Meanwhile open <a href=\"https://app.foxglove.dev/~/view?ds=foxglove-websocket&amp;ds.url=" +
      address + "\">Foxglove</a> or Lichtblick with a Foxglove WebSocket to <code>" + address +
      "</code>; if a token is set, <code>" + address + "?token=TOKEN</code>.</p></html>\n";
  return response;
}

}  // namespace

std::string_view content_type_of(const fs::path& file) {
  constexpr auto kTypes = std::to_array<std::pair<std::string_view, std::string_view>>({
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".mjs", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".json", "application/json"},
      {".map", "application/json"},
      {".webmanifest", "application/manifest+json"},
      {".txt", "text/plain; charset=utf-8"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
      {".jpg", "image/jpeg"},
      {".webp", "image/webp"},
      {".ico", "image/x-icon"},
      {".woff2", "font/woff2"},
      {".wasm", "application/wasm"},
  });
  const std::string extension = file.extension().string();
  const auto* const found = std::ranges::find(kTypes, extension, &decltype(kTypes)::value_type::first);
  return found == kTypes.end() ? "application/octet-stream" : found->second;
}

fs::path default_page_folder() {
  Dl_info library{};
  if (dladdr(reinterpret_cast<const void*>(&default_page_folder), &library) == 0) return {};
  std::error_code error;
  const fs::path file = fs::canonical(library.dli_fname, error);
  constexpr int kMostLevels = 6;  // of the library below the prefix, or below the source folder
  fs::path folder = file.parent_path();
  for (int level = 0; level < kMostLevels && folder.has_relative_path(); ++level, folder = folder.parent_path()) {
    for (const char* place : {"share/panvo/web_view/page", "components/web_view/page/dist"}) {
      if (fs::is_regular_file(folder / place / "index.html", error)) return folder / place;
    }
  }
  return {};
}

HttpResponse Page::get(const HttpRequest& request) const {
  HttpResponse response{404, "text/plain; charset=utf-8", "there is no such file\n", {}};
  if (folder_.empty()) {
    if (request.path == "/") response = explanation(request.host, request.is_secure);
  } else if (const auto file = file_below(folder_, request.path)) {
    const std::string version = version_of(*file);
    if (request.if_none_match == version) {
      response = {304, "", "", {}};
    } else if (auto content = read_file(*file)) {
      response = {200, std::string(content_type_of(*file)), std::move(*content), {}};
    }
    response.headers.emplace_back("ETag", version);
  }
  response.headers.emplace_back("Cache-Control", "no-cache");  // may be kept, but ask whether it has changed
  add_security(response, request.host);
  return response;
}

}  // namespace panvo::web_view
