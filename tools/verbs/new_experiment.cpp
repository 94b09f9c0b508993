#include "new_experiment.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/diagnose/check_data.hpp>
#include <coagula/experiment/measured_tables.hpp>
#include <coagula/report/printable.hpp>
#include <coagula/report/results.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>

namespace coagula::tools {

using namespace experiment;
using namespace coagula::report;

namespace {

namespace fs = std::filesystem;
using diagnose::Measurement;
using diagnose::MeasurementKind;

constexpr double varies_from = 1.2;      // largest over smallest value; set points that an instrument holds vary less
constexpr double ramp_from = 5;          // K
constexpr std::size_t long_table = 40;   // rows, from which on some can be left out
constexpr double gap_series_from = 1.5;  // a gap that follows the sample varies less

/// The numbers of a column in rows that have a storage modulus, or in all rows where none has.
std::vector<double> readable(const Measurement& table, std::string_view name) {
    const diagnose::Column* column = diagnose::find_column(table, name);
    const diagnose::Column* modulus = diagnose::find_column(table, "storage_modulus");
    const auto finite = [](double value) { return std::isfinite(value); };
    const bool moduli = modulus != nullptr && std::any_of(modulus->values.begin(), modulus->values.end(), finite);
    std::vector<double> values;
    for (std::size_t row = 0; column != nullptr && row < column->values.size(); ++row) {
        if (finite(column->values[row]) && (!moduli || finite(modulus->values[row]))) {
            values.push_back(column->values[row]);
        }
    }
    return values;
}

/// Largest over smallest magnitude; 1 for a column that is missing or zero somewhere.
double spread(const Measurement& table, std::string_view name) {
    double low = std::numeric_limits<double>::infinity();
    double high = 0;
    for (const double value : readable(table, name)) {
        low = std::min(low, std::abs(value));
        high = std::max(high, std::abs(value));
    }
    return low > 0 && high > 0 && std::isfinite(low) ? high / low : 1;
}

std::string range_of(const Measurement& table, std::string_view name) {
    const std::vector<double> values = readable(table, name);
    const std::string unit(diagnose::find_quantity(name)->unit);
    return std::string(name) + " goes from " + with_unit(values.front(), unit) + " to " + with_unit(values.back(), unit);
}

bool has(const Measurement& table, std::string_view name) {
    return !readable(table, name).empty();
}

RecognisedTable with_axis(MeasurementKind kind, const Measurement& table, std::string_view axis) {
    return {kind, range_of(table, axis)};
}

/// What cannot be a measurement of moduli.
std::string other_test(const io::PlainTable& table) {
    const auto numbers = [&](const char* quantity) {
        return std::any_of(table.columns.begin(), table.columns.end(), [&](const io::PlainColumn& column) {
            return column.quantity == quantity &&
                   std::any_of(column.values.begin(), column.values.end(), [](double value) { return std::isfinite(value); });
        });
    };
    if (!table.has_headings) {
        return "the file names no columns; write columns = [\"strain [%]\", \"G' [Pa]\", ...], one name per column, and a kind";
    }
    if (numbers("angular_frequency") || numbers("frequency")) {
        return "an oscillation, but no cell of the storage modulus has a value";
    }
    const std::string test = numbers("relaxation_modulus") ? "a relaxation"
                             : numbers("shear_rate")       ? "a flow curve, creep or step"
                                                           : "";
    return (test.empty() ? "" : test + ": ") + std::string("there is no storage modulus");
}

RecognisedTable by_columns(const io::PlainTable& plain, const Measurement& table) {
    if (has(table, "x") && has(table, "y") && has(table, "z")) {
        return {MeasurementKind::coordinates, "there are x, y and z"};
    }
    if (has(table, "pore_radius") && has(table, "exclusion_probability")) {
        return with_axis(MeasurementKind::pore_curve, table, "pore_radius");
    }
    if (has(table, "third_harmonic_storage") && has(table, "strain")) {
        return with_axis(MeasurementKind::harmonics, table, "strain");
    }
    if (!has(table, "storage_modulus")) {
        // In a creep the rate falls, but the stress stays.
        const bool flows = has(table, "viscosity") || has(table, "stress");
        const bool creeps = has(table, "stress") && spread(table, "stress") < varies_from;
        if (flows && !creeps && spread(table, "shear_rate") > varies_from) {
            return with_axis(MeasurementKind::flow_curve, table, "shear_rate");
        }
        return {std::nullopt, other_test(plain)};
    }
    for (const char* axis : {"heterogeneity", "coordination", "volume_fraction"}) {
        if (spread(table, axis) > 1) {
            return with_axis(MeasurementKind::structure_series, table, axis);
        }
    }
    const double frequency = spread(table, "angular_frequency");
    const double strain = spread(table, "strain");
    if (frequency > varies_from && frequency >= strain) {
        return with_axis(MeasurementKind::frequency_sweep, table, "angular_frequency");
    }
    if (strain > varies_from) {
        return with_axis(MeasurementKind::amplitude_sweep, table, "strain");
    }
    if (!has(table, "strain") && spread(table, has(table, "deflection") ? "deflection" : "stress") > varies_from) {
        return {std::nullopt, "a sweep of the amplitude without a column of the strain, which is the axis of an amplitude-sweep"};
    }
    if (spread(table, "gap") > gap_series_from) {
        return with_axis(MeasurementKind::gap_series, table, "gap");
    }
    const std::vector<double> temperature = readable(table, "temperature");
    const auto [coldest, warmest] = std::minmax_element(temperature.begin(), temperature.end());
    if (!temperature.empty() && *warmest - *coldest > ramp_from) {
        return {std::nullopt, "a ramp of the temperature, which is the axis of no kind"};
    }
    if (has(table, "time")) {
        return with_axis(MeasurementKind::time_sweep, table, "time");
    }
    return {std::nullopt, "no column varies that is the axis of a kind"};
}

/// A text of TOML.
std::string quoted(const std::string& text) {
    std::string quoted = "\"";
    for (const char c : printable(text)) {
        quoted += c == '"' || c == '\\' ? std::string{'\\', c} : std::string{c};
    }
    return quoted + '"';
}

std::string stem_of(const io::MeasuredFile& file) {
    return fs::path(file.path).stem().string();
}

std::string comment(const std::string& text) {
    return "# " + printable(text) + "\n";
}

std::string name_of_table(const io::PlainTable& table) {
    const std::string test = table.test.empty() ? "" : "test '" + table.test + "', ";
    const std::string title = table.title.empty() ? "" : "'" + table.title + "', ";
    return test + title + std::to_string(table.rows()) + " rows";
}

class Writer {
public:
    explicit Writer(const std::string& folder) : folder_(folder.empty() ? "." : folder) {}

    std::string write(const std::vector<RecognisedFile>& files) {
        text_ += comment("Made from the exports below by coagula diagnose --new. coagula diagnose --check says what is in it.");
        text_ += comment(
            "Lines that begin with # are suggestions: remove the # of those that hold. All keys: "
            "docs/reference/experiment-file.md.");
        text_ +=
            "\n[sample]\n# particle_radius = \"0.25 um\"    # these three are needed to simulate a network of particles\n"
            "# volume_fraction = 0.4\n# solvent_viscosity = \"1 mPa.s\"\n";
        write_material(files);
        every_ = thinned(files);
        text_ += "\n[instrument]\n";
        write_instrument(files);
        for (const RecognisedFile& file : files) {
            write_file(file);
        }
        if (runs_.empty()) {
            text_ += "\n" + comment("None of these tables can be diagnosed as it is.");
        }
        return text_;
    }

private:
    /// Two numbers a row: with every so many of the rows of long tables there are not too many.
    static std::size_t thinned(const std::vector<RecognisedFile>& files) {
        constexpr std::size_t most = 2500;
        std::size_t few = 0;
        std::size_t many = 0;
        for (const RecognisedFile& file : files) {
            std::size_t number = 0;
            for (const io::PlainTable& table : file.file.tables) {
                if (table.point == 0 && file.tables[number++].kind) {
                    (table.rows() > long_table ? many : few) += 2 * table.rows();
                }
            }
        }
        return few + many <= most || few >= most ? 1 : (many + most - few - 1) / (most - few);
    }

    /// No network flows; what only flows may be an oil.
    void write_material(const std::vector<RecognisedFile>& files) {
        bool flows = false;
        bool oscillates = false;
        for (const RecognisedFile& file : files) {
            for (const RecognisedTable& table : file.tables) {
                flows = flows || table.kind == MeasurementKind::flow_curve;
                oscillates = oscillates || (table.kind && *table.kind != MeasurementKind::flow_curve);
            }
        }
        const auto mark = [](bool active) { return active ? "" : "# "; };
        text_ += "\n[material]\n";
        text_ += std::string(mark(flows && !oscillates)) +
                 "kind = \"newtonian\"    # an oil, of viscosity = \"1 Pa.s\" where it is known; no structures\n";
        text_ += std::string(mark(flows && oscillates)) +
                 "kind = \"smooth\"    # any sample: what the instrument does to it is diagnosed, no structures\n";
        text_ += flows && oscillates ? "# kind = \"network\"    # of particles: without the flow curves\n" : "";
        if (oscillates) {
            text_ +=
                "\n# [structures]    # that a network of particles is simulated with\n"
                "# generator = \"vem\"    # or files = [\"packing.h5\"], structures of your own, in place of these three lines\n"
                "# particles = 1000\n"
                "# seeds = [1, 2, 3, 4]    # one structure each\n";
        }
    }

    /// What the exports say is taken over by itself; the lines are there to be seen and changed.
    void write_instrument(const std::vector<RecognisedFile>& files) {
        std::map<std::string, std::string> lines;
        for (const RecognisedFile& recognised : files) {
            for (const io::InstrumentValue& value : io::instrument_values(recognised.file)) {
                const std::string what = value.name == "geometry" ? value.text : to_text(value.value) + " " + value.unit;
                lines[value.name] += "# " + value.name + " = " + quoted(what) + "    # taken over from " +
                                     printable(stem_of(recognised.file) + ": " + value.source) + "\n";
            }
        }
        for (const auto& [name, line] : lines) {
            text_ += line;
        }
        for (const char* name : {"geometry = \"plate-plate\"", "plate_radius = \"12.5 mm\"", "gap = \"1 mm\""}) {
            if (const std::string key(name, std::string_view(name).find(' ')); !lines.contains(key)) {
                text_ += std::string("# ") + name + "    # no export says it\n";
            }
        }
    }

    void write_file(const RecognisedFile& recognised) {
        const io::MeasuredFile& file = recognised.file;
        text_ += "\n" + comment(file.path + ": " + std::string(io::name_of(file.format)) + ", " +
                                std::to_string(recognised.tables.size()) + (recognised.tables.size() == 1 ? " table" : " tables"));
        std::size_t number = 0;
        for (const io::PlainTable& table : file.tables) {
            if (table.point == 0) {
                write_table(file, table, recognised.tables[number++], recognised.tables.size() > 1);
            }
        }
    }

    void write_table(const io::MeasuredFile& file, const io::PlainTable& table, const RecognisedTable& what, bool several) {
        if (!what.kind) {
            text_ += "\n" + comment("table " + std::to_string(table.number) + ", " + name_of_table(table) +
                                    ", is not used: " + what.reason);
            return;
        }
        const std::string sample = table.test.empty() ? stem_of(file) : table.test;
        text_ += "\n[[measurement]]\nkind = \"" + std::string(diagnose::name_of(*what.kind)) + "\"    # " + printable(what.reason) +
                 "\n";
        text_ += "file = " + quoted(fs::proximate(file.path, folder_).string()) + "\n";
        text_ += (several ? "table = " + std::to_string(table.number) + "    " : "") + comment(name_of_table(table));
        text_ += "sample = " + quoted(sample) + "    # tables of one sample share its name\n";
        if (every_ > 1 && table.rows() > long_table) {
            text_ += "rows = [1, " + std::to_string(table.rows()) + ", " + std::to_string(every_) +
                     "]    # every so many: a diagnosis takes 3000 numbers at most\n";
        }
        const int order = ++runs_[sample];
        text_ += order > 1 ? "run_order = " + std::to_string(order - 1) + "    # it follows those above\n" : "";
        const std::string known = list_of(understood(table));
        text_ += comment("columns: " + known);
        const bool oscillates = *what.kind == MeasurementKind::amplitude_sweep || *what.kind == MeasurementKind::time_sweep;
        if (oscillates && known.find("frequency") == std::string::npos) {
            text_ += "# values = { angular_frequency = \"6.283 rad/s\" }    # the export does not say it\n";
        }
        if (const std::string unknown = list_of(not_understood(table, {})); !unknown.empty()) {
            text_ += comment("not understood: " + unknown + "; if one is needed: columns = { quantity = \"heading\" }");
        }
    }

    std::string folder_;
    std::string text_;
    std::map<std::string, int> runs_;  // of a sample so far
    std::size_t every_ = 1;            // row of a long table is used
};

}  // namespace

RecognisedTable recognise(const io::PlainTable& table, const std::string& label) {
    try {
        Measurement measurement = to_measurement(table, MeasurementKind::frequency_sweep, label, {});
        RecognisedTable recognised = by_columns(table, measurement);
        if (recognised.kind) {
            measurement.kind = *recognised.kind;
            const diagnose::CheckedMeasurement checked = diagnose::check_data(measurement);
            if (!checked.problems.empty()) {
                recognised = {std::nullopt, std::string(diagnose::name_of(*recognised.kind)) + ", but " + checked.problems.front()};
            }
        }
        return recognised;
    } catch (const InputError& error) {
        return {std::nullopt, error.what()};
    }
}

std::vector<std::string> understood(const io::PlainTable& table) {
    std::vector<std::string> quantities;
    for (const io::PlainColumn& column : table.columns) {
        const bool numbers =
            std::any_of(column.values.begin(), column.values.end(), [](double value) { return std::isfinite(value); });
        if (numbers && !column.quantity.empty() &&
            std::find(quantities.begin(), quantities.end(), column.quantity) == quantities.end()) {
            quantities.push_back(column.quantity);
        }
    }
    return quantities;
}

RecognisedFile recognise(const std::string& path) {
    RecognisedFile recognised{io::read_measured_file(path), {}};
    for (const io::PlainTable& table : recognised.file.tables) {
        if (table.point == 0) {
            recognised.tables.push_back(recognise(table, "table " + std::to_string(table.number)));
        }
    }
    return recognised;
}

std::string new_experiment(const std::vector<RecognisedFile>& files, const std::string& folder) {
    return Writer(folder).write(files);
}

}  // namespace coagula::tools
