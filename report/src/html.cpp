#include "html.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

namespace coagula::report {

namespace {

/// Read on a screen and on paper; colours by Okabe and Ito (2008), which the colour-blind tell apart.
constexpr std::string_view page_style = R"css(
:root { --ink: #1d2329; --soft: #5b6770; --rule: #d5dade; --pale: #f3f5f7; --base: #d55e00; --extended: #0072b2; --good: #009e73; }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 2.2rem 1.6rem 3rem; max-width: 66rem; color: var(--ink); background: #fff;
  font: 16px/1.5 "Source Sans 3", "Source Sans Pro", "Helvetica Neue", Arial, "Liberation Sans", "DejaVu Sans", sans-serif; }
h1 { margin: 0 0 .2rem; font-size: 1.75rem; line-height: 1.2; font-weight: 650; }
h2 { margin: 2.6rem 0 .7rem; padding-top: .8rem; border-top: 1px solid var(--rule); font-size: 1.22rem; font-weight: 650; }
h3 { margin: 1.5rem 0 .3rem; font-size: 1.02rem; font-weight: 650; }
p { margin: .45rem 0; max-width: 46rem; }
.soft, figcaption { color: var(--soft); font-size: .92rem; }
.verdict { margin: 1.2rem 0 .4rem; padding: .9rem 1.1rem; border-left: 6px solid var(--extended); background: var(--pale); font-size: 1.18rem; }
.verdict p { max-width: 52rem; margin: 0; }
.verdict.no-discrepancy { border-color: var(--good); }
.verdict.tied { border-color: #e69f00; }
.verdict.none-of-catalogue { border-color: var(--base); }
.facts { display: flex; flex-wrap: wrap; gap: .6rem 2.4rem; margin: 1rem 0 0; padding: 0; }
.facts div { min-width: 7rem; }
.facts dt { color: var(--soft); font-size: .84rem; }
.facts dd { margin: 0; font-size: 1.22rem; font-variant-numeric: tabular-nums; }
ul.findings { margin: .4rem 0; padding-left: 1.2rem; max-width: 50rem; }
ul.findings li { margin: .3rem 0; }
figure { margin: .6rem 0 1.4rem; }
figure svg { display: block; width: 100%; height: auto; }
figure svg text { font-family: inherit; }
figcaption { max-width: 52rem; }
table { border-collapse: collapse; margin: .6rem 0; font-size: .94rem; font-variant-numeric: tabular-nums; }
th { text-align: left; font-weight: 600; color: var(--soft); font-size: .84rem; border-bottom: 1.5px solid var(--ink); padding: .2rem .9rem .25rem 0; vertical-align: bottom; }
td { padding: .26rem .9rem .26rem 0; border-bottom: 1px solid var(--rule); vertical-align: top; }
table.bars { width: 100%; }
table.bars td:nth-child(2) { width: 34%; }
.bar { position: relative; height: 1.05rem; margin-top: .22rem; background: var(--pale); }
.bar span { position: absolute; left: 0; top: 0; bottom: 0; background: var(--extended); }
.outside .bar span { background: #9aa5ad; }
.name { font-weight: 600; white-space: nowrap; }
.number { text-align: right; white-space: nowrap; }
.key-base { color: var(--base); font-weight: 600; } .key-extended { color: var(--extended); font-weight: 600; }
.missing { padding: .6rem .9rem; background: #fdf3e3; border-left: 4px solid #e69f00; max-width: 52rem; }
code, .mono { font: .87rem/1.5 "DejaVu Sans Mono", Menlo, Consolas, monospace; overflow-wrap: anywhere; }
dl.made { display: grid; grid-template-columns: max-content 1fr; gap: .25rem 1.4rem; font-size: .92rem; }
dl.made dt { color: var(--soft); } dl.made dd { margin: 0; overflow-wrap: anywhere; }
@page { margin: 16mm 14mm; }
@media print { body { padding: 0; max-width: none; font-size: 10.5pt; } h2 { break-after: avoid; } figure, tr, .verdict { break-inside: avoid; }
  * { print-color-adjust: exact; -webkit-print-color-adjust: exact; } }
@media (max-width: 46rem) { table { display: block; overflow-x: auto; } }
)css";

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
    return number(value / std::pow(1000.0, power)) + no_break + prefixes.at(static_cast<std::size_t>(power + 3)) +
           printed_unit(unit);
}

std::string paragraph(const std::string& html, const std::string& style) {
    return (style.empty() ? "<p>" : "<p class=\"" + style + "\">") + html + "</p>\n";
}

std::string heading(const std::string& text) {
    return "<h2>" + text + "</h2>\n";
}

std::string percent(double part) {
    if (part > 0.9995 && part < 1) {
        return "&gt; 99.9 %";
    }
    return part > 0 && part < 0.001 ? "&lt; 0.1 %" : printed(100 * part) + " %";
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

std::string html_page(const std::string& title, const std::string& body) {
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
           escaped(title) + "</title>\n<style>" + std::string(page_style) + "</style>\n</head>\n<body>\n" + body +
           "</body>\n</html>\n";
}

}  // namespace coagula::report
