// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/experiment/new_experiment.hpp>

#include <coagula/common/checks.hpp>
#include <coagula/common/readable.hpp>
#include <coagula/experiment/measured_tables.hpp>
#include <coagula/io/printable.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string_view>

namespace coagula::experiment {

namespace {

namespace fs = std::filesystem;
using diagnose::MeasurementKind;

constexpr std::size_t long_table = 40;  // rows, from which on some can be left out

/// A text of TOML that stands for the same characters: JSON writes the control characters as TOML does, but for the last two kinds.
std::string quoted(const std::string& text) {
    const std::string json = nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    std::string quoted;
    for (std::size_t place = 0; place < json.size(); ++place) {
        const auto byte = static_cast<unsigned char>(json[place]);
        const bool delete_character = byte == 0x7f;
        const bool second_control = byte == 0xc2 && static_cast<unsigned char>(json[place + 1]) < 0xa0;  // U+0080 to U+009F
        if (delete_character || second_control) {
            constexpr std::string_view digits = "0123456789abcdef";
            const auto code = static_cast<unsigned char>(json[place += second_control ? 1 : 0]);
            quoted += std::string("\\u00") + digits[code >> 4U] + digits[code & 15U];
        } else {
            quoted += json[place];
        }
    }
    return quoted;
}

std::string stem_of(const io::MeasuredFile& file) {
    return fs::path(file.path).stem().string();
}

std::string comment(const std::string& text) {
    return "# " + io::printable(text) + "\n";
}

std::string name_of_table(const io::PlainTable& table, const RecognisedTable& what) {
    const std::string test = table.test.empty() ? "" : "test '" + table.test + "', ";
    const std::string title = table.title.empty() ? "" : "'" + table.title + "', ";
    const std::string rows = what.first == 0 ? std::to_string(table.rows()) + " rows"
                                             : "rows " + std::to_string(what.first) + " to " + std::to_string(what.last) + " of " +
                                                   std::to_string(table.rows());
    return test + title + rows;
}

std::string sample_of(const io::MeasuredFile& file, const io::PlainTable& table) {
    return table.test.empty() ? stem_of(file) : table.test;
}

class Writer {
public:
    explicit Writer(const std::string& folder) : folder_(folder.empty() ? "." : folder) {}

    std::string write(const std::vector<RecognisedFile>& files) {
        text_ += comment("Made from the exports below by coagula diagnose new. coagula diagnose check says what is in it.");
        text_ += comment(
            "Lines that begin with # are suggestions: remove the # of those that hold. All keys: "
            "docs/reference/experiment-file.md.");
        text_ +=
            "\n[sample]\n# particle_radius = \"0.25 um\"    # these three are needed to simulate a network of particles\n"
            "# volume_fraction = 0.4\n# solvent_viscosity = \"1 mPa.s\"\n";
        write_material(files);
        every_ = thinned(files);
        find_dated_samples(files);
        text_ += "\n[instrument]\n";
        write_instrument(files);
        for (const RecognisedFile& file : files) {
            write_file(file);
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
            for (const RecognisedTable& what : file.tables) {
                const bool compared = what.kind && !diagnose::is_step_test(*what.kind);  // of a step test, a few frequencies
                const std::size_t rows = compared ? rows_of(file.file.tables[what.place], what) : 0;
                (rows > long_table ? many : few) += 2 * rows;
            }
        }
        return few + many <= most || few >= most ? 1 : (many + most - few - 1) / (most - few);
    }

    /// Samples all of whose runs begin at a time that the export says, which then gives their order.
    void find_dated_samples(const std::vector<RecognisedFile>& files) {
        for (const RecognisedFile& file : files) {
            for (const RecognisedTable& what : file.tables) {
                const io::PlainTable& table = file.file.tables[what.place];
                const bool dated = std::isfinite(table.date) && what.first <= 1;
                bool& all = dated_.try_emplace(sample_of(file.file, table), true).first->second;
                all = all && (dated || !what.kind);
            }
        }
    }

    /// No network flows; what only flows may be an oil. A sample that yields in oscillations is one of any kind: as a network
    /// without a law of yielding it would leave no cause but a rim that has failed.
    void write_material(const std::vector<RecognisedFile>& files) {
        bool flows = false;
        bool thins = false;
        bool oscillates = false;
        bool yields = false;
        bool steps = false;
        for (const RecognisedFile& file : files) {
            for (const RecognisedTable& table : file.tables) {
                const bool flow = table.kind && diagnose::is_flow(*table.kind);
                flows = flows || flow;
                thins = thins || (flow && table.yields);
                oscillates = oscillates || (table.kind && !flow);
                yields = yields || (table.kind && !flow && table.yields);
                steps = steps || (table.kind && diagnose::is_step_test(*table.kind));
            }
        }
        const bool smooth = yields || steps || (flows && oscillates);
        const auto mark = [](bool active) { return active ? "" : "# "; };
        text_ += "\n[material]\n";
        text_ += thins && !oscillates
                     ? comment("The viscosity falls with the rate: this sample is no oil, which a diagnosis will say.")
                     : "";
        text_ += std::string(mark(flows && !oscillates)) +
                 "kind = \"newtonian\"    # an oil, of viscosity = \"1 Pa.s\" where it is known; no structures\n";
        text_ += std::string(mark(smooth)) +
                 "kind = \"smooth\"    # any sample: what the instrument does to it is diagnosed, no structures\n";
        if (smooth) {
            text_ += "# kind = \"network\"    # of particles, with structures";
            text_ += flows ? ", without the flow curves\n" : "\n";
        }
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
                                     io::printable(stem_of(recognised.file) + ": " + value.source) + "\n";
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
        const auto tables =
            std::count_if(file.tables.begin(), file.tables.end(), [](const io::PlainTable& table) { return table.point == 0; });
        text_ += "\n" + comment(file.path + ": " + std::string(io::name_of(file.format)) + ", " + std::to_string(tables) +
                                (tables == 1 ? " table" : " tables"));
        for (const RecognisedTable& what : recognised.tables) {
            write_table(file, file.tables[what.place], what, tables > 1);
        }
    }

    void write_table(const io::MeasuredFile& file, const io::PlainTable& table, const RecognisedTable& what, bool several) {
        if (!what.kind) {
            text_ += "\n" + comment("table " + std::to_string(table.number) + ", " + name_of_table(table, what) +
                                    ", is not used: " + what.reason);
            return;
        }
        const std::string sample = sample_of(file, table);
        text_ += "\n[[measurement]]\nkind = \"" + std::string(diagnose::name_of(*what.kind)) + "\"    # " +
                 io::printable(what.reason) + "\n";
        text_ += "file = " + quoted(fs::proximate(file.path, folder_).string()) + "\n";
        text_ += (several ? "table = " + std::to_string(table.number) + "    " : "") + comment(name_of_table(table, what));
        text_ += "sample = " + quoted(sample) + "    # tables of one sample share its name\n";
        write_rows(table, what);
        write_step(what);
        write_order(sample);
        write_units(what);
        const std::string known = list_of(understood(table));
        text_ += comment("columns: " + known);
        const bool oscillates = *what.kind == MeasurementKind::amplitude_sweep || *what.kind == MeasurementKind::time_sweep;
        if (oscillates && known.find("frequency") == std::string::npos) {
            text_ += "# values = { angular_frequency = \"6.283 rad/s\" }    # the export does not say it\n";
        }
        if (const std::string ignored = list_of(ignored_columns(table, *what.kind, what.rules)); !ignored.empty()) {
            text_ += comment("without a unit, and not used: " + ignored);
        }
        if (const std::string unknown = list_of(not_understood(table, {})); !unknown.empty()) {
            text_ += comment("not understood: " + unknown + "; if one is needed: columns = { quantity = \"heading\" }");
        }
    }

    void write_rows(const io::PlainTable& table, const RecognisedTable& what) {
        const bool thin = every_ > 1 && !diagnose::is_step_test(*what.kind) && rows_of(table, what) > long_table;
        if (!thin && what.first == 0) {
            return;
        }
        text_ += "rows = [" + std::to_string(what.first == 0 ? 1 : what.first) + ", " +
                 std::to_string(what.first == 0 ? table.rows() : what.last);
        const bool one_rate = *what.kind == MeasurementKind::start_up || *what.kind == MeasurementKind::steady_shear;
        text_ += thin ? ", " + std::to_string(every_) + "]    # every so many: a diagnosis takes 3000 numbers at most\n"
                      : std::string("]    # one of the ") + (one_rate ? "rates" : "sweeps") + " that the table holds\n";
    }

    void write_step(const RecognisedTable& what) {
        if (!what.step) {
            return;
        }
        if (what.step->rate_before != 0) {
            text_ += "rate_before = " + quoted(with_unit(what.step->rate_before, "1/s")) +
                     "\nstress_before = " + quoted(with_unit(what.step->stress_before, "Pa")) +
                     "    # the mean of the last rows at that rate; the flow must have been steady\n";
        }
        if (what.step->time_zero != 0) {
            text_ += "time_zero = " + quoted(to_text(what.step->time_zero) + " s") + "    # the last row at the rate before\n";
        }
    }

    void write_order(const std::string& sample) {
        const int order = ++runs_[sample];
        if (order > 1 && dated_.at(sample)) {
            text_ += "# the export says when this run began, from which the order of the runs on the sample follows\n";
        } else if (order > 1) {
            text_ += "run_order = " + std::to_string(order - 1) + "    # it follows those above\n";
        }
    }

    void write_units(const RecognisedTable& what) {
        std::string list;
        for (const auto& [quantity, heading] : what.rules.headings) {
            list += (list.empty() ? "" : ", ") + quantity + " = " + quoted(heading);
        }
        if (!list.empty()) {
            text_ += "columns = { " + list + " }    # the file names no units: CHECK these, which are assumed\n";
        }
    }

    std::string folder_;
    std::string text_;
    std::map<std::string, int> runs_;    // of a sample so far
    std::map<std::string, bool> dated_;  // samples all of whose runs have a start
    std::size_t every_ = 1;              // row of a long table is used
};

}  // namespace

std::string new_experiment(const std::vector<RecognisedFile>& files, const std::string& folder) {
    return Writer(folder).write(files);
}

}  // namespace coagula::experiment
