// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace panvo::evaluation {

/// Escapes text for HTML, also inside double quotes.
std::string html(std::string_view text);

std::string base64(std::string_view bytes);

/// "a, b, c"
std::string joined(const std::vector<std::string>& words);

/// A table; the first `left_columns` columns are text. A cell may hold markup.
std::string html_table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows,
                       std::size_t left_columns, const std::string& caption = "");

/// "<section><h2>title</h2>lead, body</section>"
std::string html_section(const std::string& title, const std::string& lead, const std::string& body);

}  // namespace panvo::evaluation
