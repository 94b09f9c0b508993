// SPDX-License-Identifier: GPL-3.0-or-later
#include "html.hpp"

#include "bundle.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

namespace coagula::report {

namespace {

const std::string no_break = "\u00a0";  ///< a space that no line ends at

/// Digits of an exponent, raised.
std::string raised(int exponent) {
    static constexpr std::array<const char*, 10> digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text = exponent < 0 ? "⁻" : "";
    for (const char digit : std::to_string(std::abs(exponent))) {
        text += digits.at(static_cast<std::size_t>(digit - '0'));
    }
    return text;
}

std::string formatted(const char* format, double value) {
    std::array<char, 48> text{};
    std::snprintf(text.data(), text.size(), format, value);
    return replaced(text.data(), "-", "−");
}

/// Three digits without an exponent where that is readable.
std::string number(double value) {
    if (value == 0 || !std::isfinite(value)) {
        return value == 0 ? "0" : "–";
    }
    const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-12));
    if (exponent >= -3 && exponent < 5) {
        return formatted(exponent >= 2 ? "%.0f" : "%.3g", value);
    }
    return formatted("%.3g", value / std::pow(10.0, exponent)) + no_break + "×" + no_break + "10" + raised(exponent);
}

std::string printed_unit(std::string unit) {
    for (const auto& [plain, proper] : {std::pair{"m2", "m²"}, {"m^2", "m²"}, {"m3", "m³"}, {"N.m", "N m"}, {"N m", "N m"}}) {
        unit = replaced(std::move(unit), plain, proper);
    }
    return unit;
}

}  // namespace

std::string replaced(std::string text, std::string_view what, std::string_view by) {
    for (std::size_t place = 0; (place = text.find(what, place)) != std::string::npos; place += by.size()) {
        text.replace(place, what.size(), by);
    }
    return text;
}

std::string escaped(std::string_view text) {
    std::string safe;
    for (const char letter : text) {
        switch (letter) {
            case '&':
                safe += "&amp;";
                break;
            case '<':
                safe += "&lt;";
                break;
            case '>':
                safe += "&gt;";
                break;
            case '"':
                safe += "&quot;";
                break;
            default:
                safe += letter;
        }
    }
    return safe;
}

std::string printed(double value, const std::string& unit) {
    if (unit == "1" || unit.empty()) {
        return number(value);
    }
    static constexpr std::array prefixes = {"n", "µ", "m", "", "k", "M", "G"};
    int power = 0;
    if ((unit == "Pa" || unit == "m") && value != 0 && std::isfinite(value)) {
        power = std::min(std::max(static_cast<int>(std::floor(std::log10(std::abs(value)) / 3 + 1e-9)), -3), 3);
    }
    const int place = power + 3;
    return number(value / std::pow(1000.0, power)) + no_break + prefixes.at(static_cast<std::size_t>(place)) + printed_unit(unit);
}

std::string paragraph(const std::string& html, const std::string& style) {
    return (style.empty() ? "<p>" : "<p class=\"" + style + "\">") + html + "</p>\n";
}

std::string heading(const std::string& text) {
    return "<h2>" + text + "</h2>\n";
}

std::string percent(double part) {
    return printed(100 * part) + " %";
}

std::string probability_text(double probability) {
    if (probability >= 0.9995) {
        return "> 99.9 %";
    }
    return probability < 0.001 ? "< 0.1 %" : percent(probability);
}

std::string signed_percent(double part) {
    return (part > 0 ? "+" : "") + printed(100 * part) + " %";
}

std::string readable(const std::string& name) {
    return escaped(replaced(name, "_", " "));
}

std::string html_table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows,
                       const std::string& table_style) {
    std::string text = table_style.empty() ? "<table>" : "<table class=\"" + table_style + "\">";
    text += "\n<thead><tr>";
    for (const std::string& cell : head) {
        text += "<th>" + cell + "</th>";
    }
    text += "</tr></thead>\n<tbody>\n";
    for (const auto& row : rows) {
        text += "<tr>";
        for (const std::string& cell : row) {
            text += "<td>" + cell + "</td>";
        }
        text += "</tr>\n";
    }
    return text + "</tbody></table>\n";
}

std::string html_page(const std::string& title, const std::string& body, const std::string& body_style) {
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
           escaped(title) + "</title>\n<style>" + std::string(page_style) + "</style>\n</head>\n" +
           (body_style.empty() ? "<body>\n" : "<body class=\"" + body_style + "\">\n") + body + "</body>\n</html>\n";
}

std::string page_data(const nlohmann::ordered_json& data, const std::string& arrays) {
    // "<" would let a text of the data end the element.
    return "<script type=\"application/json\" id=\"data\">" + replaced(data.dump(), "<", "\\u003c") + "</script>\n" +
           (arrays.empty() ? std::string{} : "<script type=\"text/plain\" id=\"arrays\">" + arrays + "</script>\n");
}

std::string page_script(std::string_view script) {
    return "<noscript><p class=\"missing\">This page draws its figures with JavaScript, which is switched off "
           "here.</p></noscript>\n"
           "<script>" +
           std::string(script) + "</script>\n";
}

}  // namespace coagula::report
