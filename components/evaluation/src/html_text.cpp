// SPDX-License-Identifier: Apache-2.0
#include "html_text.hpp"

#include <array>
#include <cstdint>

namespace panvo::evaluation {

std::string html(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string base64(std::string_view bytes) {
  static constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      three = (three << 8U) | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k <= bytes.size() ? kDigits[(three >> (18U - 6U * k)) & 63U] : '=';
    }
  }
  return text;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text.append(text.empty() ? "" : ", ").append(word);
  return text;
}

std::string html_table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows,
                       std::size_t left_columns, const std::string& caption) {
  const auto cells = [&](const std::vector<std::string>& row, const char* tag) {
    std::string text = "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) {
      text.append("<").append(tag).append(i < left_columns ? " class=\"l\">" : ">").append(row[i]);
      text.append("</").append(tag).append(">");
    }
    return text + "</tr>\n";
  };
  std::string text = "<div class=\"wide\"><table>";
  if (!caption.empty()) text.append("<caption>").append(caption).append("</caption>");
  text.append("<thead>").append(cells(header, "th")).append("</thead><tbody>");
  for (const auto& row : rows) text += cells(row, "td");
  return text + "</tbody></table></div>\n";
}

std::string html_section(const std::string& title, const std::string& lead, const std::string& body) {
  std::string text = "<section>\n<h2>" + title + "</h2>\n";
  if (!lead.empty()) text.append("<p class=\"lead\">").append(lead).append("</p>\n");
  return text + body + "</section>\n";
}

}  // namespace panvo::evaluation
