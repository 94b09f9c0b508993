// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/checks.hpp>
#include <coagula/io/atomic_file.hpp>
#include <coagula/io/checksums.hpp>
#include <coagula/io/set_file.hpp>

#include <algorithm>
#include <iterator>
#include <map>

#include "child_process.hpp"
#include "hdf5_file.hpp"
#include "layout.hpp"
#include "packed.hpp"
#include "results.hpp"
#include "write_structure.hpp"

namespace coagula::io {

namespace {

using hdf5::Content;
using hdf5::File;

const std::string index_group = "/index";
const std::string structures_group = "/structures";
const std::string sweep_text = "/sweep";

void write_column(File& file, const SetColumn& column) {
    const std::string path = index_group + "/" + column.name;
    if (const auto* texts = std::get_if<std::vector<std::string>>(&column.values)) {
        file.write_text_list(path, *texts);
    } else if (const auto* numbers = std::get_if<std::vector<double>>(&column.values)) {
        file.write(path, {numbers->size()}, numbers->data());
    } else {
        const auto& wholes = std::get<std::vector<std::int64_t>>(column.values);
        file.write(path, {wholes.size()}, wholes.data());
    }
    file.describe(path, column.unit, column.description);
}

SetColumn read_column(const File& file, const std::string& name) {
    const std::string path = index_group + "/" + name;
    if (file.shape(path).size() != 1) {
        file.fail(path, "is no column: it has not one dimension");
    }
    SetColumn column{name, file.attribute(path, "unit"), file.attribute(path, "description")};
    switch (file.content(path)) {
        case Content::text:
            column.values = file.read_text_list(path);
            break;
        case Content::real:
            column.values = file.read<double>(path);
            break;
        case Content::integer:
            column.values = file.read<std::int64_t>(path);
            break;
        case Content::other:
            file.fail(path, "holds neither numbers nor texts");
    }
    return column;
}

bool has_index(const File& file) {
    return file.is_group(index_group) && file.has(index_group + "/id") && file.attribute("/", "format") == layout::format_of_sets;
}

void require_set(const File& file) {
    if (!has_index(file)) {
        throw InputError(file.path() + " is no data set of coagula: it lacks " + index_group + "/id or the attribute format");
    }
}

SetHead head_in(const File& file) {
    require_set(file);
    SetHead head;
    for (const std::string& name : file.attribute_names("/")) {
        if (name != "format") {
            head.card.emplace_back(name, file.attribute("/", name));
        }
    }
    head.sweep = file.read_text(sweep_text);
    for (const std::string& name : file.children(layout::provenance)) {
        head.provenance.emplace_back(name, file.read_text(std::string(layout::provenance) + "/" + name));
    }
    for (const std::string& name : file.texts_attribute(index_group, "columns")) {
        head.index.push_back(read_column(file, name));
        if (head.index.back().size() != head.index.front().size()) {
            file.fail(index_group + "/" + name, "has another length than the other columns");
        }
    }
    return head;
}

std::string packed(const SetHead& head) {
    Packer packer;
    packer(head.sweep, head.card.size(), head.provenance.size(), head.index.size());
    for (const auto* pairs : {&head.card, &head.provenance}) {
        for (const auto& [name, text] : *pairs) {
            packer(name, text);
        }
    }
    for (const SetColumn& column : head.index) {
        packer(column.name, column.unit, column.description, column.values);
    }
    return packer.take();
}

SetHead unpacked(const std::string& bytes) {
    Unpacker unpacker(bytes);
    SetHead head;
    std::size_t card = 0;
    std::size_t provenance = 0;
    std::size_t columns = 0;
    unpacker(head.sweep, card, provenance, columns);
    head.card.resize(card);
    head.provenance.resize(provenance);
    head.index.resize(columns);
    for (auto* pairs : {&head.card, &head.provenance}) {
        for (auto& [name, text] : *pairs) {
            unpacker(name, text);
        }
    }
    for (SetColumn& column : head.index) {
        unpacker(column.name, column.unit, column.description, column.values);
    }
    return head;
}

std::string sum_of(const File& file, const std::string& group) {
    std::vector<Dataset> all = values_in(file, group);
    const std::size_t prefix = group == "/" ? 0 : group.size();
    std::erase_if(all, [&](const Dataset& dataset) { return dataset.path.substr(prefix).starts_with(layout::provenance); });
    for (Dataset& dataset : all) {
        dataset.path = dataset.path.substr(prefix);
    }
    return datasets_sha256(all);
}

/// Card, sweep, index and structures.
void fill(File& file, const SetHead& head, const std::vector<SetStructure>& structures) {
    file.set_attribute("/", "format", layout::format_of_sets);
    for (const auto& [name, text] : head.card) {
        file.set_attribute("/", name, text);
    }
    file.write_text(sweep_text, head.sweep);
    file.describe(sweep_text, "1", "the sweep file from which the set was made");
    file.create_group(layout::provenance);
    for (const auto& [name, text] : head.provenance) {
        file.write_text(std::string(layout::provenance) + "/" + name, text);
    }
    file.create_group(index_group);
    for (const SetColumn& column : head.index) {
        write_column(file, column);
    }
    std::vector<std::string> names;
    std::transform(head.index.begin(), head.index.end(), std::back_inserter(names), [](const auto& column) { return column.name; });
    file.set_attribute(index_group, "columns", names);
    file.create_group(structures_group);
    std::map<std::string, File> sets;  // which stay open; files of one structure do not
    for (const SetStructure& structure : structures) {
        file.require_room();
        if (structure.group == "/") {
            file.copy_group_from(File::open_own(structure.file), "/", group_of_structure(structure.id));
            continue;
        }
        const auto opened = sets.find(structure.file);
        const File& set =
            opened != sets.end() ? opened->second : sets.emplace(structure.file, File::open(structure.file)).first->second;
        file.copy_group_from(set, structure.group, group_of_structure(structure.id));
    }
}

}  // namespace

std::size_t SetColumn::size() const {
    return std::visit([](const auto& held) { return held.size(); }, values);
}

const SetColumn* SetHead::column(const std::string& name) const {
    const auto found = std::find_if(index.begin(), index.end(), [&](const SetColumn& entry) { return entry.name == name; });
    return found == index.end() ? nullptr : &*found;
}

Packing packing_as_stored(const Packing& packing) {
    const auto rounded = [](const auto& lengths) { return ((lengths * layout::nanometres) / layout::nanometres).eval(); };
    const Cell cell = Cell::of_edges(rounded(packing.cell.origin()), rounded(packing.cell.edges()), packing.cell.periodicity());
    return {cell, layout::stored_positions(packing) / layout::nanometres, rounded(packing.radii)};
}

std::string group_of_structure(const std::string& id) {
    return structures_group + "/" + id;
}

void write_set(const std::string& path, const SetHead& head, const std::vector<SetStructure>& structures, bool overwrite) {
    OutputFile output(path, overwrite);
    File file = File::create(path, output.open_in_place());
    fill(file, head, structures);
    output.publish_in_place(file.close().size());
}

bool is_set(const std::string& path) {
    return run_in_child(path, [&](ReadingLimits& /*limits*/) { return std::string(has_index(File::open(path)) ? "set" : ""); }) ==
           "set";
}

SetHead read_set(const std::string& path) {
    return unpacked(run_in_child(path, [&](ReadingLimits& /*limits*/) { return packed(head_in(File::open(path))); }));
}

std::vector<std::string> structures_in_set(const std::string& path) {
    return Unpacker(run_in_child(path,
                                 [&](ReadingLimits& /*limits*/) {
                                     const File file = File::open(path);
                                     require_set(file);
                                     Packer packer;
                                     packer(file.children(structures_group));
                                     return packer.take();
                                 }))
        .take<std::vector<std::string>>();
}

void extract_structure(const std::string& set, const std::string& id, const std::string& path, bool overwrite) {
    const std::string bytes = run_in_child(set, [&](ReadingLimits& /*limits*/) {
        const File source = File::open(set);
        require_set(source);
        if (!source.is_group(group_of_structure(id))) {
            throw InputError(set + " holds no structure " + id);
        }
        File file = File::create(path);
        file.copy_all_from(source, group_of_structure(id));
        const auto span = file.close();
        return std::string(span.begin(), span.end());
    });
    write_file(path, bytes, overwrite);
}

std::string write_part(const std::string& path, const Structure& structure, const std::vector<Dataset>& results,
                       const Provenance& provenance, const std::vector<Addition>& later) {
    File file = built_structure(path, structure, {}, results, provenance, later);
    std::string sum = sum_of(file, "/");
    write_file(path, file.close(), true);
    return sum;
}

std::vector<std::pair<std::string, std::string>> structure_sums(const std::string& set) {
    Unpacker unpacker(run_in_child(set, [&](ReadingLimits& limits) {
        const File file = File::open(set);
        limits.lift();  // all values of all structures are read
        require_set(file);
        const std::vector<std::string> ids = file.children(structures_group);
        std::vector<std::string> sums;
        std::transform(ids.begin(), ids.end(), std::back_inserter(sums),
                       [&](const std::string& id) { return sum_of(file, group_of_structure(id)); });
        Packer packer;
        packer(ids, sums);
        return packer.take();
    }));
    const auto ids = unpacker.take<std::vector<std::string>>();
    const auto sums = unpacker.take<std::vector<std::string>>();
    std::vector<std::pair<std::string, std::string>> pairs;
    std::transform(ids.begin(), ids.end(), sums.begin(), std::back_inserter(pairs),
                   [](const std::string& id, const std::string& sum) {
                       return std::pair{id, sum};
                   });
    return pairs;
}

}  // namespace coagula::io
