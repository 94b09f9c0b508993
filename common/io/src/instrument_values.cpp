// SPDX-License-Identifier: GPL-3.0-or-later
// Reads what the metadata of an export say about the tool: geometry, radii, gap, angle, inertia and compliance.
#include <coagula/io/measured_file.hpp>
#include <coagula/io/units.hpp>

#include "cell_number.hpp"
#include "rheometer_headings.hpp"
#include "text_reader.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <optional>

namespace coagula::io {

namespace {

/// A key of the metadata and what it says.
struct Key {
    std::string_view key;   ///< lower case, without blanks
    std::string_view name;  ///< of [instrument]
    std::string_view unit;  ///< SI
    double factor;
};

constexpr std::array keys = {
    Key{"diameter", "plate_radius", "m", 0.5},
    Key{"geometrydiameter", "plate_radius", "m", 0.5},
    Key{"platediameter", "plate_radius", "m", 0.5},
    Key{"conediameter", "plate_radius", "m", 0.5},
    Key{"gap", "gap", "m", 1},
    Key{"measuringgap", "gap", "m", 1},
    Key{"coneangle", "cone_angle", "rad", 1},
    Key{"angle", "cone_angle", "rad", 1},
    Key{"bobdiameter", "inner_radius", "m", 0.5},
    Key{"cupdiameter", "outer_radius", "m", 0.5},
    Key{"boblength", "bob_length", "m", 1},
    Key{"stressconstant", "stress_constant", "Pa/(N.m)", 1},
    Key{"strainconstant", "strain_constant", "1/rad", 1},
    Key{"geometryinertia", "tool_inertia", "kg.m2", 1},
    Key{"inertia", "tool_inertia", "kg.m2", 1},
    Key{"instrumentinertia", "instrument_inertia", "kg.m2", 1},
    Key{"compliance", "tool_compliance", "rad/(N.m)", 1},
    Key{"geometrycompliance", "tool_compliance", "rad/(N.m)", 1},
    Key{"uppercompliance", "tool_compliance", "rad/(N.m)", 1},
    Key{"lowercompliance", "tool_compliance", "rad/(N.m)", 1},
};

/// Keys whose text names the tool: "25mm parallel plate", "PP08-SN23708; [d=0.1 mm]".
constexpr std::array tool_keys = {"geometryname",  "geometrytype", "measuringsystem", "measuringgeometry",
                                  "measuringcell", "messsystem",   "systèmedemesure", "測定治具"};

std::string without_blanks_and_case(std::string_view text) {
    std::string key = lower_case(text);
    std::erase_if(key, [](char c) { return c == ' ' || c == '_' || c == ':'; });
    return key;
}

/// The number with a unit at the beginning of a text such as "25.0 mm" or "1.000 [mm]", in `unit`.
std::optional<double> quantity_in(std::string_view text, const std::string& unit) {
    text = trim(text);
    const std::size_t end = std::min(text.find_first_not_of("0123456789.,+-eE"), text.size());
    const std::string number(text.substr(0, end));
    const CellNumber value = read_cell(number, number.find(',') != std::string::npos);
    const std::string from = normal_unit(text.substr(end));
    if (!value.value || from.empty()) {
        return std::nullopt;
    }
    try {
        const double converted = convert({*value.value}, from, unit).front();
        return std::isfinite(converted) ? std::optional(converted) : std::nullopt;
    } catch (const InputError&) {
        return std::nullopt;  // "Gap 1 N": not what the key promises
    }
}

std::string geometry_in(const std::string& words) {
    const auto has = [&](std::string_view part) { return words.find(part) != std::string::npos; };
    if (has("concentric") || has("cylinder") || has("zylinder") || has("couette") || words.starts_with("cc")) {
        return "concentric-cylinders";
    }
    if (has("cone") || has("kegel") || has("cône") || words.starts_with("cp")) {
        return "cone-plate";
    }
    return has("parallelplate") || has("plateplate") || has("platte") || words.starts_with("pp") ? "plate-plate" : "";
}

class Values {
public:
    void add(const MetadataEntry& entry) {
        const std::string key = without_blanks_and_case(entry.key);
        const std::string source = entry.key + " " + entry.value;
        const bool names_tool = std::find(tool_keys.begin(), tool_keys.end(), key) != tool_keys.end() ||
                                (key == "name" && lower_case(entry.group).starts_with("geometry"));
        if (names_tool) {
            add_tool(entry.value, source);
            return;
        }
        const auto* const found = std::find_if(keys.begin(), keys.end(), [&](const Key& each) { return each.key == key; });
        if (found != keys.end()) {
            const std::string unit(found->unit);
            if (const auto value = quantity_in(entry.value, unit); value) {
                put(std::string(found->name), *value * found->factor, unit, source,
                    key == "uppercompliance" || key == "lowercompliance");
            }
        }
    }

    /// Under a cone and below a bob the gap is not that of the shear.
    std::vector<InstrumentValue> take() {
        const bool plates = std::none_of(values_.begin(), values_.end(),
                                         [](const auto& each) { return each.name == "geometry" && each.text != "plate-plate"; });
        std::erase_if(values_, [&](const auto& each) { return each.name == "gap" && !plates; });
        return std::move(values_);
    }

private:
    /// The first value of a name counts, if it is above zero; `adds`: that of the upper and of the lower part of a tool are in
    /// series.
    void put(const std::string& name, double value, const std::string& unit, const std::string& source, bool adds = false) {
        const auto same = std::find_if(values_.begin(), values_.end(), [&](const auto& each) { return each.name == name; });
        if (!(value > 0 && std::isfinite(value))) {
            return;
        }
        if (same == values_.end()) {
            values_.push_back({name, value, unit, "", source});
        } else if (adds && same->source.find(source.substr(0, source.find(' '))) == std::string::npos) {
            same->value += value;
            same->source += ", " + source;
        }
    }

    void put_number_before(const std::string& words, std::string_view mark, double factor, const std::string& name,
                           const std::string& unit, const std::string& source) {
        const std::size_t end = words.find(mark);
        if (end == std::string::npos) {
            return;
        }
        const std::size_t before = words.find_last_not_of("0123456789.", end == 0 ? 0 : end - 1);
        const std::size_t begin = before == std::string::npos ? 0 : before + 1;
        if (const auto number = read_cell(words.substr(begin, end - std::min(begin, end)), false).value; number) {
            put(name, *number * factor, unit, source);
        }
    }

    /// Geometry and the numbers in the name: PP08 has 8 mm, CP50-1 50 mm and 1 degree, and so has "50mm 1° cone plate".
    void add_tool(const std::string& tool, const std::string& source) {
        const std::string words = without_blanks_and_case(tool);
        const std::string geometry = geometry_in(words);
        const bool known = std::any_of(values_.begin(), values_.end(), [](const auto& each) { return each.name == "geometry"; });
        if (!geometry.empty() && !known) {
            values_.push_back({"geometry", unset, "1", geometry, source});
        }
        const bool anton_paar = (words.starts_with("pp") || words.starts_with("cp")) && words.size() > 2 &&
                                std::isdigit(static_cast<unsigned char>(words[2])) != 0;
        if (!anton_paar) {
            if (geometry == "plate-plate" || geometry == "cone-plate") {
                put_number_before(words, "mm", 0.5e-3, "plate_radius", "m", source);
            }
            if (geometry == "cone-plate") {
                put_number_before(words, "°", std::numbers::pi / 180, "cone_angle", "rad", source);
            }
            return;
        }
        const std::size_t end = std::min(words.find_first_not_of("0123456789", 2), words.size());
        put("plate_radius", 0.5e-3 * read_cell(words.substr(2, end - 2), false).value.value_or(unset), "m", source);
        const std::size_t digits = end + 1;
        if (words.starts_with("cp") && end < words.size() && words[end] == '-') {
            const std::size_t stop = std::min(words.find_first_not_of("0123456789.", digits), words.size());
            if (const auto angle = quantity_in(words.substr(digits, stop - digits) + " degree", "rad")) {
                put("cone_angle", *angle, "rad", source);
            }
        }
    }

    std::vector<InstrumentValue> values_;
};

}  // namespace

std::vector<InstrumentValue> instrument_values(const MeasuredFile& file) {
    Values values;
    for (const MetadataEntry& entry : file.metadata) {
        values.add(entry);
    }
    return values.take();
}

}  // namespace coagula::io
