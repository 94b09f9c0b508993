// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of a page: text in HTML, tables, the style that all pages share.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace coagula::report {

/// The text with every `what` replaced.
std::string replaced(std::string text, std::string_view what, std::string_view by);

/// Text that may stand anywhere in a page.
std::string escaped(std::string_view text);

/// A physical value for people, with three digits, a proper minus, powers of ten and units as one would print them:
/// "1.47 MPa", "3.2 × 10⁻⁵ m/Pa".
std::string printed(double value, const std::string& unit = "1");

/// Part of something in percent.
std::string percent(double part);
/// A probability in percent, as plain text. What is nearly certain or impossible is so within a model only: "> 99.9 %", "< 0.1 %".
std::string probability_text(double probability);
/// With a sign.
std::string signed_percent(double part);

/// A name of an interface, its underscores replaced.
std::string readable(const std::string& name);

std::string paragraph(const std::string& html, const std::string& style = {});
std::string heading(const std::string& text);

/// <table> with a head; cells are HTML.
std::string html_table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows,
                       const std::string& style = {});

/// A whole page that needs no other file: <title>, style, body.
std::string html_page(const std::string& title, const std::string& body, const std::string& body_style = {});

/// What the script of a page draws: an element of JSON, and the long arrays beside it (PageArrays::base64; may be empty).
std::string page_data(const nlohmann::ordered_json& data, const std::string& arrays = {});

/// A script of the bundle, to stand at the end of the body.
std::string page_script(std::string_view script);

}  // namespace coagula::report
