// SPDX-License-Identifier: GPL-3.0-or-later
#include "results.hpp"

#include <coagula/io/atomic_file.hpp>

#include <array>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "child_process.hpp"
#include "layout.hpp"
#include "packed.hpp"

namespace coagula::io {

namespace {

using hdf5::Content;
using hdf5::File;

/// A template so that strings, which are no arrays, are told apart by overload.
template <class T>
void write_values(File& file, const Dataset& dataset, const std::vector<T>& values) {
    require(File::count(dataset.shape) == values.size(), dataset.path + " has " + std::to_string(values.size()) +
                                                             " values, but its shape asks for " +
                                                             std::to_string(File::count(dataset.shape)));
    file.write(dataset.path, dataset.shape, values.data());
}

void write_values(File& file, const Dataset& dataset, const std::string& text) {
    require(dataset.shape.empty(), dataset.path + " is a text and cannot have a shape");
    file.write_text(dataset.path, text);
}

/// The next number and the stage with underscores: "0002_characterize".
std::string provenance_name(const File& file, std::string stage) {
    for (char& c : stage) {
        c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    }
    const std::vector<std::string> entries = file.children(layout::provenance);
    const int last = entries.empty() ? 0 : std::atoi(entries.back().c_str());
    std::array<char, 16> number{};
    std::snprintf(number.data(), number.size(), "%04d_", last + 1);
    return number.data() + stage;
}

/// Sets the field of an entry of the history that a dataset holds, if there is one of this name and type.
void set_field(Provenance& entry, const std::string& name, const Dataset& dataset) {
    const std::map<std::string, std::string*> texts = {{"stage", &entry.stage},     {"command_line", &entry.command_line},
                                                       {"options", &entry.options}, {"version", &entry.version},
                                                       {"time", &entry.time},       {"positions_sha256", &entry.positions_sha256}};
    if (const auto* text = std::get_if<std::string>(&dataset.values); text != nullptr && texts.contains(name)) {
        *texts.at(name) = *text;
    } else if (const auto* whole = std::get_if<std::vector<std::int64_t>>(&dataset.values); whole != nullptr && name == "seed") {
        entry.seed = whole->size() == 1 ? whole->front() : entry.seed;
    } else if (const auto* real = std::get_if<std::vector<double>>(&dataset.values); real != nullptr && name == "seconds") {
        entry.seconds = real->size() == 1 ? real->front() : entry.seconds;
    }
}

}  // namespace

void write_dataset(File& file, const Dataset& dataset) {
    require(dataset.path.size() > 1 && dataset.path.starts_with('/') && !dataset.path.ends_with('/'),
            "'" + dataset.path + "' is not the path of a dataset");
    std::visit([&](const auto& values) { write_values(file, dataset, values); }, dataset.values);
    file.describe(dataset.path, dataset.unit, dataset.description);
}

void write_provenance(File& file, const Provenance& entry) {
    const std::string group = std::string(layout::provenance) + "/" + provenance_name(file, entry.stage) + "/";
    write_dataset(file, text(group + "stage", entry.stage, "stage of the work, such as characterize"));
    write_dataset(file, text(group + "command_line", entry.command_line, "the command as it was given"));
    write_dataset(file, text(group + "options", entry.options, "values of all options, a JSON object"));
    write_dataset(file, integer(group + "seed", entry.seed, "seed of the random numbers; -1: there were none"));
    write_dataset(file, text(group + "version", entry.version, "version of coagula"));
    write_dataset(file, text(group + "time", entry.time, "date and time of the call (UTC, ISO 8601)"));
    write_dataset(file, scalar(group + "seconds", entry.seconds, "s", "wall-clock time of the call"));
    write_dataset(file, text(group + "positions_sha256", entry.positions_sha256,
                             "SHA-256 of the positions that went in (nm, little-endian doubles); empty for a generator"));
}

void write_datasets(const std::string& path, const std::vector<Dataset>& datasets, bool overwrite) {
    File file = File::create(path);
    for (const Dataset& dataset : datasets) {
        write_dataset(file, dataset);
    }
    write_file(path, file.close(), overwrite);
}

std::vector<Dataset> values_in(const File& file, const std::string& group) {
    std::vector<Dataset> results;
    file.for_each_dataset(group, [&](const std::string& name) {
        Dataset dataset{name, file.shape(name), {}, {}, {}};
        const Content content = file.content(name);
        if (content == Content::real) {
            dataset.values = file.read<double>(name);
        } else if (content == Content::integer) {
            dataset.values = file.read<std::int64_t>(name);
        } else if (content == Content::text && dataset.shape.empty()) {
            dataset.values = file.read_text(name);
        } else {
            return;  // not one of ours
        }
        results.push_back(std::move(dataset));
    });
    return results;
}

std::vector<Dataset> results_in(const File& file, const std::string& group) {
    std::vector<Dataset> results = values_in(file, group);
    for (Dataset& dataset : results) {
        dataset.unit = file.attribute(dataset.path, "unit");
        dataset.description = file.attribute(dataset.path, "description");
    }
    return results;
}

std::vector<Dataset> read_results(const std::string& path, const std::string& group) {
    return Unpacker(run_in_child(path,
                                 [&](ReadingLimits& /*limits*/) {
                                     Packer packer;
                                     packer(results_in(File::open(path), group));
                                     return packer.take();
                                 }))
        .take<std::vector<Dataset>>();
}

std::vector<Provenance> history_of(const std::vector<Dataset>& datasets) {
    std::map<std::string, Provenance> history;  // by the name of the entry, which begins with its number
    const std::string prefix = std::string(layout::provenance) + "/";
    for (const Dataset& dataset : datasets) {
        const std::size_t slash = dataset.path.find('/', prefix.size());
        if (slash != std::string::npos) {
            set_field(history[dataset.path.substr(prefix.size(), slash - prefix.size())], dataset.path.substr(slash + 1), dataset);
        }
    }
    std::vector<Provenance> entries;
    entries.reserve(history.size());
    for (auto& [name, entry] : history) {
        entries.push_back(std::move(entry));
    }
    return entries;
}

std::vector<Provenance> read_provenance(const std::string& path) {
    return history_of(read_results(path, layout::provenance));
}

}  // namespace coagula::io
