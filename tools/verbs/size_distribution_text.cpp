#include "size_distribution_text.hpp"

#include "cli/arguments.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/io/input_file.hpp>
#include <coagula/io/units.hpp>

#include <algorithm>
#include <sstream>

namespace coagula::tools {

namespace {

using generators::SizeDistribution;
using generators::SizeKind;

std::string trim(const std::string& text) {
    const auto first = text.find_first_not_of(" \t\r");
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

struct Columns {
    std::size_t radius = 0;
    std::size_t fraction = 0;
    std::string unit;  ///< of the radius
    std::size_t count = 0;
};

Columns read_header(const std::string& line, const std::string& path) {
    const std::vector<std::string> names = split(line);
    Columns columns;
    columns.count = names.size();
    bool has_fraction = false;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string name = trim(names[i]);
        if (name.starts_with("radius") && name.ends_with(']') && name.find('[') != std::string::npos) {
            columns.radius = i;
            columns.unit = name.substr(name.find('[') + 1, name.size() - name.find('[') - 2);
        } else if (name == "fraction") {
            columns.fraction = i;
            has_fraction = true;
        }
    }
    if (columns.unit.empty() || !has_fraction) {
        throw InputError(path + ": the first line must name the columns 'radius [unit]' and 'fraction'");
    }
    return columns;
}

double positive_number(const std::string& text, const std::string& unit, const std::string& place) {
    try {
        return unit == "1" ? parse_quantity(text, "1", within(1e-12, 1e12))
                           : parse_quantity(text + " " + unit, "m", physical::length);
    } catch (const InputError& error) {
        throw InputError(place + ": " + error.what());
    }
}

SizeDistribution parse_spread(SizeKind kind, const std::string& text, std::size_t colon) {
    SizeDistribution sizes;
    sizes.kind = kind;
    try {
        sizes.relative_deviation = io::parse_quantity(colon == std::string::npos ? "" : text.substr(colon + 1), "1");
    } catch (const InputError&) {
        throw InputError("--size-distribution: '" + text + "' needs the standard deviation over the mean, as in " +
                         text.substr(0, colon) + ":0.1");
    }
    return sizes;
}

std::string table_text(const std::string& path) {
    try {
        return io::read_file(path);
    } catch (const InputError& error) {
        throw InputError(std::string("--size-distribution: ") + error.what() +
                         "; give monodisperse, normal:S, lognormal:S or a CSV file");
    }
}

}  // namespace

SizeDistribution read_size_table(const std::string& path) {
    std::istringstream file(table_text(path));
    std::string line;
    std::getline(file, line);
    const Columns columns = read_header(line, path);
    std::vector<double> radius;
    std::vector<double> fraction;
    for (int number = 2; std::getline(file, line); ++number) {
        if (trim(line).empty()) {
            continue;
        }
        const std::string place = path + ", line " + std::to_string(number);
        const std::vector<std::string> cells = split(line);
        if (cells.size() != columns.count) {
            throw InputError(place + ": there are " + std::to_string(cells.size()) + " values, but " +
                             std::to_string(columns.count) + " columns");
        }
        radius.push_back(positive_number(trim(cells[columns.radius]), columns.unit, place));
        fraction.push_back(positive_number(trim(cells[columns.fraction]), "1", place));
    }
    SizeDistribution sizes;
    sizes.kind = SizeKind::table;
    sizes.table_radius = Eigen::VectorXd::Map(radius.data(), static_cast<Index>(radius.size()));
    sizes.table_fraction = Eigen::VectorXd::Map(fraction.data(), static_cast<Index>(fraction.size()));
    return sizes;
}

SizeDistribution parse_size_distribution(const std::string& text, std::optional<double> mean_radius) {
    const std::size_t colon = text.find(':');
    const std::string name = text.substr(0, colon);
    SizeDistribution sizes;
    if (name == "normal" || name == "lognormal") {
        sizes = parse_spread(name == "normal" ? SizeKind::normal : SizeKind::lognormal, text, colon);
    } else if (text != "monodisperse") {
        return read_size_table(text);
    }
    if (!mean_radius) {
        throw InputError("--radius is missing: it is the mean radius of the particles (see 'coagula generate vem --help')");
    }
    sizes.mean_radius = *mean_radius;
    return sizes;
}

}  // namespace coagula::tools
