// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/drive_page.hpp"

#include <string_view>

#include "drive_pictures.hpp"
#include "drive_rows.hpp"
#include "panvo/evaluation/input_error.hpp"
#include "panvo/evaluation/journey_page.hpp"
#include "text_file.hpp"

namespace panvo::evaluation {
namespace {

namespace fs = std::filesystem;

void replace_all(std::string& text, std::string_view what, std::string_view by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
}

/// Replaces the one element that `page` must have, from `begin` to `end`.
void replace_element(std::string& page, std::string_view begin, std::string_view end, const std::string& by) {
  const std::size_t from = page.find(begin);
  const std::size_t to = from == std::string::npos ? from : page.find(end, from);
  if (to == std::string::npos)
    throw InputError("index.html", "has no " + std::string(begin), "build panvo again: the page is of another version");
  page.replace(from, to + end.size() - from, by);
}

/// Scripts end where `</script` stands, even in a text.
std::string in_script(std::string script) {
  replace_all(script, "</script", "<\\/script");
  replace_all(script, "<!--", "<\\!--");
  return script;
}

}  // namespace

fs::path live_page_folder() {
  std::error_code error;
  fs::path folder = fs::canonical("/proc/self/exe", error).parent_path();
  constexpr int kMostLevels = 6;  // of the program below the prefix or the build folder
  for (int level = 0; level < kMostLevels && folder.has_relative_path(); ++level, folder = folder.parent_path()) {
    for (const char* place : {"share/panvo/web_view/page", "components/web_view/page/dist"}) {
      if (fs::is_regular_file(folder / place / "index.html", error)) return folder / place;
    }
  }
  return {};
}

std::string drive_page(const JourneyReport& report, const fs::path& page_folder) {
  auto drive = drive_rows(report.run.frames);
  drive["version"] = 1;
  drive["title"] = report.title;
  drive["report"] = journey_page(report);
  drive["pictures"] = drive_pictures(report.run.frames);
  std::string data =
      drive.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);  // names may be in Latin-1
  replace_all(data, "<", "\\u003c");

  std::string page = read_text(page_folder / "index.html");
  replace_element(page, "<link rel=\"icon\"", ">", "");
  replace_element(page, "<link rel=\"manifest\"", ">", "");
  replace_element(page, "<link rel=\"stylesheet\"", ">", "<style>" + read_text(page_folder / "style.css") + "</style>");
  replace_element(page, "<script src=\"page.js\"", "</script>",
                  "<script type=\"application/json\" id=\"recorded-drive\">" + data + "</script>\n<script>" +
                      in_script(read_text(page_folder / "page.js")) + "</script>");
  return page;
}

}  // namespace panvo::evaluation
