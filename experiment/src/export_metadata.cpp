// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/experiment/export_metadata.hpp>

#include <coagula/common/checks.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace coagula::experiment {

namespace {

using diagnose::Experiment;
using diagnose::Instrument;

/// The geometry first: it says which of the others make sense. Radii of cylinders go together.
constexpr std::array names = {"geometry",        "plate_radius",   "gap",          "cone_angle",         "inner_radius",
                              "outer_radius",    "bob_length",     "tool_inertia", "instrument_inertia", "tool_compliance",
                              "stress_constant", "strain_constant"};

/// Values that an instrument has together or not at all.
constexpr std::array pairs = {std::pair{"inner_radius", "outer_radius"}, std::pair{"stress_constant", "strain_constant"}};

std::string partner_of(const std::string& name) {
    for (const auto& [one, other] : pairs) {
        if (name == one || name == other) {
            return name == one ? other : one;
        }
    }
    return "";
}

/// Whether the experiment file gives a size of the tool: then the constants of an export may be those of another.
bool gives_size(const Instrument& instrument) {
    return std::isfinite(instrument.plate_radius) || std::isfinite(instrument.gap) || std::isfinite(instrument.cone_angle) ||
           std::isfinite(instrument.inner_radius) || std::isfinite(instrument.bob_length);
}

double& field(Instrument& instrument, const std::string& name) {
    static const std::map<std::string, double Instrument::*> fields = {
        {"plate_radius", &Instrument::plate_radius},       {"gap", &Instrument::gap},
        {"cone_angle", &Instrument::cone_angle},           {"inner_radius", &Instrument::inner_radius},
        {"outer_radius", &Instrument::outer_radius},       {"bob_length", &Instrument::bob_length},
        {"stress_constant", &Instrument::stress_constant}, {"strain_constant", &Instrument::strain_constant},
        {"tool_inertia", &Instrument::tool_inertia},       {"instrument_inertia", &Instrument::instrument_inertia},
        {"tool_compliance", &Instrument::tool_compliance}};
    return instrument.*fields.at(name);
}

bool same(const io::InstrumentValue& one, const io::InstrumentValue& other) {
    return one.name == "geometry" ? one.text == other.text : std::abs(one.value - other.value) <= 1e-6 * std::abs(one.value);
}

bool is_given(Instrument& instrument, const std::string& name) {
    return name == "geometry" ? instrument.geometry.has_value() : !std::isnan(field(instrument, name));
}

void set(Instrument& instrument, const io::InstrumentValue& value) {
    if (value.name == "geometry") {
        instrument.geometry = diagnose::geometry(value.text);
    } else {
        field(instrument, value.name) = value.value;
    }
}

/// Why an instrument is impossible; nothing where it is not.
std::optional<std::string> contradiction(const Instrument& instrument) {
    Experiment alone;
    alone.instrument = instrument;
    try {
        diagnose::check(alone);
    } catch (const InputError& error) {
        return error.what();
    }
    return std::nullopt;
}

TakenOver taken_over(const std::string& file, const io::InstrumentValue& value, std::string fate) {
    return {value.name, value.value, value.unit, value.text, file + ": " + value.source, std::move(fate)};
}

double median_temperature(const diagnose::Measurement& table) {
    const diagnose::Column* column = diagnose::find_column(table, "temperature");
    std::vector<double> values;
    for (std::size_t row = 0; column != nullptr && row < column->values.size(); ++row) {
        if (std::isfinite(column->values[row])) {
            values.push_back(column->values[row]);
        }
    }
    std::sort(values.begin(), values.end());
    return values.empty() ? unset : values[values.size() / 2];
}

/// The temperature of the sample is that of all tables that say it.
void give_temperature(Experiment& experiment, std::vector<TakenOver>& list) {
    constexpr double agree = 1;  // K
    double low = std::numeric_limits<double>::infinity();
    double high = 0;
    for (const diagnose::Measurement& table : experiment.measurements) {
        const double median = median_temperature(table);
        low = std::isnan(median) ? low : std::min(low, median);
        high = std::isnan(median) ? high : std::max(high, median);
    }
    if (!(high > 0) || !std::isnan(experiment.sample.temperature) || high - low > agree) {
        return;
    }
    experiment.sample.temperature = (low + high) / 2;
    list.push_back({"temperature", experiment.sample.temperature, "K", "", "the columns of the temperature", "taken over"});
}

}  // namespace

void ExportMetadata::add(const std::string& name, const io::MeasuredFile& file, std::size_t first, std::size_t end) {
    for (io::InstrumentValue& value : io::instrument_values(file)) {
        std::vector<Source>& sources = sources_[value.name];
        sources.push_back({name, std::move(value), first, end});
    }
}

/// Where all exports agree.
void ExportMetadata::give_value(const std::string& name, Experiment& experiment, std::vector<TakenOver>& list) const {
    const Source& source = sources_.at(name).front();
    TakenOver taken = taken_over(source.file, source.value, "taken over");
    Instrument candidate = experiment.instrument;
    if (is_given(candidate, name)) {
        taken.fate = "not taken over: [instrument] gives it";
    } else {
        set(candidate, source.value);
        const auto partner = sources_.find(partner_of(name));
        if (partner != sources_.end() && !is_given(candidate, partner->first)) {
            set(candidate, partner->second.front().value);
        }
        if (const auto why = contradiction(candidate)) {
            taken.fate = "not taken over: " + *why;
        } else {
            set(experiment.instrument, source.value);
        }
    }
    list.push_back(std::move(taken));
}

/// Where exports differ: plate radius and gap may be those of single tables, other values must be said.
void ExportMetadata::give_to_tables(const std::string& name, Experiment& experiment, std::vector<TakenOver>& list) const {
    const bool of_tables = (name == "plate_radius" || name == "gap") && !is_given(experiment.instrument, name);
    for (const Source& source : sources_.at(name)) {
        list.push_back(
            taken_over(source.file, source.value,
                       of_tables ? "taken over for its tables" : "not taken over: the exports differ; say it in [instrument]"));
        for (std::size_t i = source.first; of_tables && i < source.end; ++i) {
            diagnose::Measurement& table = experiment.measurements[i];
            if (diagnose::find_column(table, name) == nullptr) {
                table.columns.push_back({name, "m", std::vector<double>(table.rows(), source.value.value)});
            }
        }
    }
}

std::vector<TakenOver> ExportMetadata::give_to(Experiment& experiment) const {
    std::vector<TakenOver> list;
    const bool size_given = gives_size(experiment.instrument);
    for (const std::string name : names) {
        const auto found = sources_.find(name);
        if (found == sources_.end() || (size_given && name.ends_with("_constant"))) {
            continue;
        }
        const std::vector<Source>& sources = found->second;
        const bool agree = std::all_of(sources.begin(), sources.end(),
                                       [&](const Source& source) { return same(source.value, sources.front().value); });
        if (agree) {
            give_value(name, experiment, list);
        } else {
            give_to_tables(name, experiment, list);
        }
    }
    give_temperature(experiment, list);
    return list;
}

}  // namespace coagula::experiment
