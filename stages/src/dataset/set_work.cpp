// SPDX-License-Identifier: GPL-3.0-or-later
#include "set_work.hpp"

#include <coagula/common/failures.hpp>
#include <coagula/io/atomic_file.hpp>
#include <coagula/io/input_file.hpp>
#include <coagula/io/set_file.hpp>
#include <coagula/io/structure_file.hpp>
#include <coagula/stages/characterize.hpp>
#include <coagula/stages/generate.hpp>
#include <coagula/stages/provenance.hpp>
#include <coagula/stages/shear.hpp>

#include <new>
#include <span>

namespace coagula::stages {

namespace {

/// An entry of the history without times: equal sets have equal bytes.
io::Provenance timeless_call(const Arguments& arguments, const Packing* input, const std::string& engine = {}) {
    io::Provenance entry = describe_call(arguments, input, Stopwatch(), engine);
    entry.time = "";
    entry.seconds = 0;
    return entry;
}

Generated made_structure(const Arguments& arguments, Trajectory& trajectory) {
    return arguments.verb() == generate_vem_verb().name ? generate(vem_run(arguments), {})
                                                        : trajectory.next(brownian_run(arguments), {});
}

/// What the stages after the generator find.
struct Found {
    std::vector<io::Addition> additions = {};
    std::vector<Findings> findings = {};
};

/// Measures one packing; rows that differ in their shear alone share what is found.
class Measured {
public:
    const Findings& operator()(const Arguments& arguments, const Packing& packing, const std::optional<BondPotential>& bonds) {
        std::string options = arguments.to_json().dump();
        if (!findings_ || options != options_) {
            findings_ = measure(characterize_run(arguments, bonds), packing, {});
            options_ = std::move(options);
        }
        return *findings_;
    }

private:
    std::string options_;
    std::optional<Findings> findings_;
};

Found find(const SetRow& row, const Packing& packing, const std::optional<BondPotential>& bonds, Measured& measured) {
    Found found;
    if (row.characterize) {
        found.findings.push_back(measured(*row.characterize, packing, bonds));
        found.additions.push_back(addition_of(found.findings.back(), std::nullopt, timeless_call(*row.characterize, &packing)));
    }
    if (row.shear) {
        Sheared sheared = shear(shear_run(*row.shear, {"the structure", bonds}), packing, {});
        found.additions.push_back(
            addition_of(sheared.findings, sheared.bonds, timeless_call(*row.shear, &packing, sheared.findings.engine)));
        found.findings.push_back(std::move(sheared.findings));
    }
    return found;
}

/// Runs the work; what goes wrong becomes the message of the record.
template <class Work>
bool succeeds(SetRecord& record, const Work& work) {
    try {
        work();
        return true;
    } catch (const std::exception& error) {
        record.message = failure_sentence(error);
        return false;
    }
}

/// @return its checksum.
std::string write_row(const std::string& path, const SetRow& row, const Generated& made, const std::vector<io::Addition>& found) {
    const io::Provenance entry = timeless_call(row.generate, nullptr, made.findings.engine);
    if (row.whole) {
        return io::write_part(path, made.structure, kept_results(made.findings), entry, found);
    }
    return io::write_part(path, {.packing = made.structure.packing, .bonds = {}, .time = made.structure.time}, {}, entry, {});
}

/// Rows that share a generated structure. @return how long it took to generate it [s].
double compute_structure(std::span<const SetRow* const> rows, Trajectory& trajectory, const SetParts& parts, bool with_structures) {
    std::optional<Generated> made;
    std::optional<BondPotential> bonds;
    std::optional<Packing> packing;  // as a file holds it: what is found is what a call for that file would find
    SetRecord common{.id = {}, .version = version_text()};
    const Stopwatch clock;
    succeeds(common, [&] {
        made = made_structure(rows.front()->generate, trajectory);
        packing = io::packing_as_stored(made->structure.packing);
        bonds = bond_potential_in(made->findings.results);
    });
    const double generating = clock.seconds();
    Measured measured;
    for (const SetRow* row : rows) {
        SetRecord record = common;
        record.id = row->id;
        Found found;
        record.done = made && succeeds(record, [&] { found = find(*row, *packing, bonds, measured); });
        if (record.done) {
            append_results(record, made->findings);
            for (const Findings& findings : found.findings) {
                append_results(record, findings);
            }
        }
        if (record.done && with_structures) {
            record.sha256 = write_row(parts.structure(row->id), *row, *made, found.additions);
        }
        parts.keep(record);
    }
    return generating;
}

}  // namespace

std::optional<SetRecord> SetParts::record(const std::string& id) const {
    const std::filesystem::path path = folder_ / (id + ".json");
    if (!std::filesystem::exists(path)) {
        return std::nullopt;
    }
    std::optional<SetRecord> record = record_from(io::read_file(path.string()));
    return record && record->id == id ? record : std::nullopt;
}

void SetParts::keep(const SetRecord& record) const {
    io::write_file((folder_ / (record.id + ".json")).string(), record_text(record), true);
}

double compute_rows(const std::vector<const SetRow*>& rows, const SetParts& parts, bool with_structures) {
    Trajectory trajectory;
    double generating = 0;
    for (std::size_t first = 0; first < rows.size();) {
        std::size_t end = first + 1;
        while (end < rows.size() && rows[end]->made_of == rows[first]->made_of) {
            ++end;
        }
        generating += compute_structure(std::span(rows).subspan(first, end - first), trajectory, parts, with_structures);
        first = end;
    }
    return generating;
}

}  // namespace coagula::stages
