// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/experiment/experiment_file.hpp>

#include <coagula/experiment/measured_tables.hpp>
#include "material_keys.hpp"
#include "planned_table.hpp"
#include "table_selection.hpp"
#include "table_setting.hpp"
#include "toml_keys.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/diagnose/step_test.hpp>
#include <coagula/diagnose/tool_constants.hpp>
#include <coagula/io/measured_file.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>

namespace coagula::experiment {

namespace {

namespace fs = std::filesystem;

constexpr double largest_radius = 0.1;  // of particles [m]; more is a unit forgotten

/// Reads an experiment file part by part.
class ExperimentReader {
public:
    explicit ExperimentReader(const std::string& path) : path_(path), root_(parse_toml(path)) {}

    ExperimentFile run() {
        TomlKeys keys(root_, path_);
        result_.experiment.title = keys.text("title").value_or("");
        for (const char* table : {"sample", "material", "instrument", "structures", "noise", "expected", "measurement"}) {
            keys.ignore(table);
        }
        keys.refuse_other_keys();
        read_sample();
        TomlKeys material(part("material"), where("material"));
        result_.experiment.material = read_material(material);
        read_instrument();
        read_structures();
        read_noise();
        read_expectation();
        read_measurements();
        result_.taken_over = metadata_.give_to(result_.experiment);
        result_.facts.resize(result_.experiment.measurements.size());
        naming(path_, [&] { derive_moduli(); });
        naming(path_, [&] { diagnose::check(result_.experiment); });
        return std::move(result_);
    }

private:
    /// The table of this name, empty where there is none.
    const toml::table& part(const std::string& name) const {
        static const toml::table none;
        const toml::node* node = root_.get(name);
        if (node != nullptr && !node->is_table()) {
            throw InputError(path_ + ", key '" + name + "': must be a table, [" + name + "]");
        }
        return node == nullptr ? none : *node->as_table();
    }

    std::string where(const std::string& name) const { return path_ + ", [" + name + "]"; }
    /// The path of a file that the experiment names.
    std::string resolved(const std::string& file) {
        result_.files.push_back((fs::path(path_).parent_path() / file).string());
        return result_.files.back();
    }

    /// Many tables may stand in one export, which is read once.
    const io::MeasuredFile& measured_file(const std::string& name) {
        const std::string path = resolved(name);
        const auto known = exports_.find(path);
        return known != exports_.end() ? known->second : exports_.emplace(path, io::read_measured_file(path)).first->second;
    }

    void read_sample();
    void read_instrument();
    void read_structures();
    void read_noise();
    void read_expectation();
    void read_measurements();
    void derive_moduli();
    void read_measurement(const toml::table& table, std::size_t number);
    static ColumnRules column_rules(TomlKeys& keys);

    std::string path_;
    toml::table root_;
    ExperimentFile result_;
    ExportMetadata metadata_;
    std::map<std::size_t, ColumnsToDrop> without_;     ///< columns of measurements that are not to be used
    std::vector<std::size_t> raw_moduli_;              ///< measurements whose moduli are to be those of torque and raw phase
    std::map<std::string, io::MeasuredFile> exports_;  ///< by resolved name
};

void ExperimentReader::read_sample() {
    TomlKeys keys(part("sample"), where("sample"));
    diagnose::Sample& sample = result_.experiment.sample;
    sample.name = keys.text("name").value_or("");
    sample.particle_radius = keys.quantity("particle_radius", "m").value_or(unset);
    if (sample.particle_radius > largest_radius) {
        keys.fail("particle_radius", "is " + to_text(sample.particle_radius) + " m, but may be " + to_text(largest_radius) +
                                         " m at most: give it with its unit, such as \"0.25 um\"");
    }
    sample.density = keys.quantity("density", "kg/m3").value_or(unset);
    sample.volume_fraction = keys.quantity("volume_fraction", "1").value_or(unset);
    sample.solvent_viscosity = keys.quantity("solvent_viscosity", "Pa.s").value_or(unset);
    sample.temperature = keys.quantity("temperature", "K").value_or(unset);
    sample.normal_stiffness = keys.quantity("normal_stiffness", "N/m").value_or(unset);
    sample.normal_stiffness_error = keys.quantity("normal_stiffness_error", "1").value_or(unset);
    sample.sheared_before = keys.flag("sheared_before");
    keys.refuse_other_keys();
}

void ExperimentReader::read_instrument() {
    TomlKeys keys(part("instrument"), where("instrument"));
    diagnose::Instrument& instrument = result_.experiment.instrument;
    if (const auto name = keys.text("geometry")) {
        instrument.geometry = diagnose::geometry(*name);
        if (!instrument.geometry) {
            keys.fail("geometry", "'" + *name + "' is not one of plate-plate, cone-plate, concentric-cylinders");
        }
    }
    instrument.plate_radius = keys.quantity("plate_radius", "m").value_or(unset);
    instrument.gap = keys.quantity("gap", "m").value_or(unset);
    instrument.cone_angle = keys.quantity("cone_angle", "rad").value_or(unset);
    instrument.inner_radius = keys.quantity("inner_radius", "m").value_or(unset);
    instrument.outer_radius = keys.quantity("outer_radius", "m").value_or(unset);
    instrument.bob_length = keys.quantity("bob_length", "m").value_or(unset);
    instrument.end_correction = keys.quantity("end_correction", "1").value_or(1);
    instrument.stress_constant = keys.quantity("stress_constant", "Pa/(N.m)").value_or(unset);
    instrument.strain_constant = keys.quantity("strain_constant", "1/rad").value_or(unset);
    instrument.tool_inertia = keys.quantity("tool_inertia", "kg.m2").value_or(unset);
    instrument.instrument_inertia = keys.quantity("instrument_inertia", "kg.m2").value_or(unset);
    instrument.tool_compliance = keys.quantity("tool_compliance", "rad/(N.m)").value_or(unset);
    keys.refuse_other_keys();
}

void ExperimentReader::read_structures() {
    TomlKeys keys(part("structures"), where("structures"));
    for (const std::string& file : keys.texts("files")) {
        const std::string path = resolved(file);
        if (!fs::is_regular_file(path)) {
            keys.fail("files", path + (fs::exists(path) ? " is not a file" : " does not exist"));
        }
        result_.experiment.structures.push_back(path);
    }
    for (const std::int64_t group : keys.wholes("groups")) {
        if (group < 1) {
            keys.fail("groups", "must be 1 or more");
        }
        result_.experiment.structure_groups.push_back(static_cast<std::size_t>(group));
    }
    if (const auto generator = keys.text("generator")) {
        if (*generator != "vem" && *generator != "brownian") {
            keys.fail("generator", "'" + *generator + "' is neither vem nor brownian");
        }
        diagnose::StructureRecipe recipe{*generator, keys.small_count("particles", 1), 0, unset, unset, {}};
        recipe.voids = *generator == "vem" ? keys.small_count("voids", 0) : 0;
        if (*generator == "brownian") {
            recipe.surface_potential = keys.quantity("surface_potential", "V").value_or(unset);
        }
        recipe.target_coordination = keys.quantity("target_coordination", "1").value_or(unset);
        for (const std::int64_t seed : keys.wholes("seeds")) {
            if (seed < 0) {
                keys.fail("seeds", "must not be negative");
            }
            if (std::find(recipe.seeds.begin(), recipe.seeds.end(), static_cast<std::size_t>(seed)) != recipe.seeds.end()) {
                keys.fail("seeds", "holds " + std::to_string(seed) + " twice, which would be one structure, not two");
            }
            recipe.seeds.push_back(static_cast<std::size_t>(seed));
        }
        result_.experiment.recipe = recipe;
    }
    keys.refuse_other_keys();
}

void ExperimentReader::read_noise() {
    TomlKeys keys(part("noise"), where("noise"));
    const auto positive = [&](const std::string& key, double& target) {
        if (const auto value = keys.quantity(key, "1")) {
            if (!(*value > 0 && *value < 1)) {
                keys.fail(key, "must lie between 0 and 1");
            }
            target = *value;
        }
    };
    positive("stated_relative", result_.noise.relative);
    positive("stated_sample", result_.noise.sample);
    if (const auto value = keys.quantity("stated_floor", "Pa")) {
        if (!(*value >= 0)) {
            keys.fail("stated_floor", "must be >= 0 Pa");
        }
        result_.noise.floor = *value;
    }
    if (const auto value = keys.quantity("stated_phase", "rad")) {
        if (!(*value > 0 && *value < 1)) {
            keys.fail("stated_phase", "must lie between 0 and 1 rad");
        }
        result_.noise.phase = *value;
    }
    if (const auto value = keys.quantity("stated_correlation", "1")) {
        if (!(*value >= 0 && *value < 1)) {
            keys.fail("stated_correlation", "must be 0 or more and below 1");
        }
        result_.noise.correlation = *value;
    }
    keys.refuse_other_keys();
}

void ExperimentReader::read_expectation() {
    TomlKeys keys(part("expected"), where("expected"));
    if (const auto value = keys.quantity("storage_modulus", "Pa")) {
        if (!(*value > 0)) {
            keys.fail("storage_modulus", "must be > 0 Pa");
        }
        result_.expected_storage_modulus = *value;
    }
    keys.refuse_other_keys();
}

void ExperimentReader::read_measurements() {
    const toml::node* list = root_.get("measurement");
    if (list == nullptr || !list->is_array_of_tables()) {
        throw InputError(path_ + ": there is no measurement; each needs a table [[measurement]]");
    }
    std::size_t number = 0;
    for (const toml::node& table : *list->as_array()) {
        read_measurement(*table.as_table(), ++number);
    }
}

const diagnose::Quantity& known_quantity(TomlKeys& keys, const std::string& key, const std::string& name) {
    const diagnose::Quantity* quantity = diagnose::find_quantity(name);
    if (quantity == nullptr) {
        keys.fail(key, "'" + name + "' is not a quantity (see docs/reference/experiment-file.md)");
    }
    return *quantity;
}

/// Quantity names on the left.
std::map<std::string, std::string> headings_by_quantity(TomlKeys& keys, const std::string& key) {
    std::map<std::string, std::string> headings;
    for (const auto& [name, node] : keys.entries(key)) {
        headings[std::string(known_quantity(keys, key, name).name)] = keys.text_of(*node, key);
    }
    return headings;
}

ColumnRules ExperimentReader::column_rules(TomlKeys& keys) {
    ColumnRules rules;
    if (keys.holds_list("columns")) {
        rules.names = keys.texts("columns");
    } else {
        rules.headings = headings_by_quantity(keys, "columns");
    }
    rules.standard_errors = headings_by_quantity(keys, "standard_errors");
    for (const auto& [name, node] : keys.entries("values")) {
        const diagnose::Quantity& quantity = known_quantity(keys, "values", name);
        const double value = keys.quantity_of(*node, "values." + name, std::string(quantity.unit));
        if (value < quantity.low || value > quantity.high || (quantity.low_excluded && value == quantity.low)) {
            keys.fail("values." + name, "is " + to_text(value) + " " + std::string(quantity.unit) + ", but must be " +
                                            (quantity.low_excluded ? "> " : ">= ") + to_text(quantity.low));
        }
        rules.constants[name] = value;
    }
    return rules;
}

/// Once the tool is known, to which exports may contribute.
void ExperimentReader::derive_moduli() {
    std::vector<diagnose::Measurement>& tables = result_.experiment.measurements;
    for (std::size_t i = 0; i < tables.size(); ++i) {
        const bool raw = std::find(raw_moduli_.begin(), raw_moduli_.end(), i) != raw_moduli_.end();
        if (!tables[i].label.ends_with("(planned)")) {
            if (diagnose::is_step_test(tables[i].kind)) {
                diagnose::derive_step_response(tables[i], result_.experiment.instrument, raw);
            } else {
                diagnose::derive_moduli(tables[i], result_.experiment.instrument, raw);
                diagnose::derive_viscosity(tables[i]);
            }
            drop_derived_columns(tables[i], without_[i]);
        }
    }
}

/// The table, its columns named by the list `columns` where the file has no headings.
io::PlainTable with_names(TomlKeys& keys, io::PlainTable table, const ColumnRules& rules, const std::string& label) {
    if (table.has_headings && !rules.names.empty()) {
        keys.fail("columns", label + " has headings: write columns = { quantity = \"heading\" }");
    }
    if (!table.has_headings && rules.names.empty()) {
        throw InputError(
            label + ": there are no headings; name its " + std::to_string(table.columns.size()) +
            " columns in the experiment file, columns = [\"strain [%]\", \"G' [Pa]\", ...], with \"\" for one that is not "
            "meant");
    }
    if (!table.has_headings) {
        try {
            io::name_columns(table, rules.names);
        } catch (const InputError& error) {
            keys.fail("columns", label + ": " + error.what());
        }
    }
    return table;
}

/// Whether moduli are to be those of torque, deflection and raw phase.
bool moduli_are_raw(TomlKeys& keys) {
    const std::string moduli = keys.text("moduli").value_or("as-given");
    if (moduli != "raw" && moduli != "as-given") {
        keys.fail("moduli", "'" + moduli + "' is neither raw nor as-given");
    }
    return moduli == "raw";
}

void ExperimentReader::read_measurement(const toml::table& table, std::size_t number) {
    TomlKeys keys(table, path_ + ", measurement " + std::to_string(number));
    const std::string kind_name = keys.required_text("kind");
    const auto kind = diagnose::measurement_kind(kind_name);
    if (!kind) {
        std::string names;
        for (const diagnose::MeasurementKind known : diagnose::all_measurement_kinds()) {
            names += (names.empty() ? "" : ", ") + std::string(diagnose::name_of(known));
        }
        keys.fail("kind", "'" + kind_name + "' is not one of " + names);
    }
    const diagnose::Measurement setting = read_setting(keys, number);
    if (table.contains("rate_before") && *kind != diagnose::MeasurementKind::start_up) {
        keys.fail("rate_before", "only a table of kind start-up begins from a rate");
    }
    if (table.contains("planned")) {
        diagnose::Measurement measurement = planned_table(keys, *kind, number, column_rules(keys).constants);
        keys.refuse_other_keys();
        result_.experiment.measurements.push_back(in_setting(setting, std::move(measurement)));
        return;
    }
    const std::string name = keys.required_text("file");
    const io::MeasuredFile& file = measured_file(name);
    const std::vector<const io::PlainTable*> tables = chosen_tables(keys, file, *kind);
    const ColumnRules rules = column_rules(keys);
    const TableSelection selection = read_selection(keys);
    const bool raw = moduli_are_raw(keys);
    keys.refuse_other_keys();
    const std::size_t first = result_.experiment.measurements.size();
    for (const io::PlainTable* chosen : tables) {
        const std::string label = label_of(file, *chosen, name);
        const io::PlainTable named = with_names(keys, *chosen, rules, label);
        diagnose::Measurement measurement = in_setting(setting, to_measurement(named, *kind, label, rules));
        place_in_range(measurement, *chosen, *tables.front(), selection.first == 1);
        without_[result_.experiment.measurements.size()] = drop_given_columns(measurement, selection.without);
        select(measurement, selection);
        if (chosen->announced_points > 0 && chosen->rows() != static_cast<std::size_t>(chosen->announced_points)) {
            result_.notes.push_back(label + ": the file announces " + std::to_string(chosen->announced_points) +
                                    " points, but has " + std::to_string(chosen->rows()));
        }
        for (const std::string& heading : ignored_columns(named, *kind, rules)) {
            result_.notes.push_back(label + ": the column " + heading + " names no unit and is not used");
        }
        if (raw) {
            raw_moduli_.push_back(result_.experiment.measurements.size());
        }
        result_.experiment.measurements.push_back(std::move(measurement));
        result_.facts.resize(result_.experiment.measurements.size());
        result_.facts.back() = {not_understood(named, rules), named.flags};
    }
    metadata_.add(name, file, first, result_.experiment.measurements.size());
}

}  // namespace

ExperimentFile read_experiment(const std::string& path) {
    return ExperimentReader(path).run();
}

}  // namespace coagula::experiment
