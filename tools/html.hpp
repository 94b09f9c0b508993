// Parts of a page: text in HTML, tables, the style that all pages share.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace coagula::tools {

/// The text with every `what` replaced.
std::string replaced(std::string text, std::string_view what, std::string_view by);

/// Text that may stand anywhere in a page.
std::string escaped(std::string_view text);

/// A physical value for people, with three digits, a proper minus, powers of ten and units as one would print them:
/// "1.47 MPa", "3.2 × 10⁻⁵ m/Pa".
std::string printed(double value, const std::string& unit = "1");

/// <table> with a head; cells are HTML.
std::string html_table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows,
                       const std::string& style = {});

/// A whole page that needs no other file: <title>, style, body.
std::string html_page(const std::string& title, const std::string& body);

}  // namespace coagula::tools
