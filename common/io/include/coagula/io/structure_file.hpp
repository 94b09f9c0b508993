// SPDX-License-Identifier: GPL-3.0-or-later
// The HDF5 file of coagula: H5MD 1.1 structure, VTKHDF view, results with units, provenance. See docs/reference/file.md.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/dataset.hpp>
#include <coagula/common/packing.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace coagula::io {

using coagula::BondField;
using coagula::Dataset;
using coagula::ParticleField;
using dataset::columns;
using dataset::integer;
using dataset::integers;
using dataset::matrix;
using dataset::scalar;
using dataset::text;
using dataset::vector;

/// One stage of the history of a file.
struct Provenance {
    std::string stage;  ///< "generate vem", "characterize" ...
    std::string command_line;
    std::string options;           ///< JSON object of all options with their values
    std::int64_t seed = -1;        ///< -1: no randomness
    std::string version;           ///< version + git hash
    std::string time;              ///< UTC, ISO 8601
    double seconds = unset;        ///< taken by the stage
    std::string positions_sha256;  ///< of the positions that went in; empty for a generator
};

/// Positions at another time.
struct Frame {
    double time = unset;         ///< [s]
    Eigen::Matrix3Xd positions;  ///< 3 x N [m]
};

/// What a file holds beyond its results.
struct Structure {
    Packing packing;
    std::optional<ContactNetwork> bonds;
    std::vector<Frame> earlier = {};  ///< the trajectory that led to the packing; written, but not read back
    double time = 0;                  ///< of the packing [s]
};

/// Throws InputError when `path` cannot become an output: it exists (without `overwrite`), is no regular file or protected against
/// writing, or no file can be made in its folder. Asking before long work saves the wait.
void check_output(const std::string& path, bool overwrite);

/// The results that a stage adds to a file.
struct Addition {
    std::vector<std::string> replaced;    ///< groups that are removed before
    std::optional<ContactNetwork> bonds;  ///< those of the file when not given
    std::vector<ParticleField> fields;
    std::vector<Dataset> results;
    Provenance provenance;
    std::vector<BondField> bond_fields = {};  ///< of `bonds`
};

/// Writes a new file as write_file in atomic_file.hpp does, with what `later` stages added to it. Throws InputError when `path`
/// exists and `overwrite` is false, std::runtime_error (naming the file) when it cannot be written, e.g. on a full disk; nothing is
/// left behind then.
void write_structure(const std::string& path, const Structure& structure, const std::vector<ParticleField>& fields,
                     const std::vector<Dataset>& results, const Provenance& provenance, bool overwrite,
                     const std::vector<Addition>& later = {});

/// Reads structure and bonds. Throws InputError naming the file and the object when it is missing, truncated, foreign or
/// inconsistent.
Structure read_structure(const std::string& path);

/// What a file holds.
struct Contents {
    Structure structure;
    std::vector<Dataset> results;     ///< below /characterization, then those below /mechanics
    std::vector<Provenance> history;  ///< oldest first
};

/// read_structure, read_results and read_provenance at the cost of one of them.
Contents read_contents(const std::string& path);

/// Copies `source` to `target` (may be the same file) without the groups that are replaced, then adds what is new and a provenance
/// entry; by temporary file and rename. What coagula does not know in the source is kept.
/// With target != source an existing target needs `overwrite`; with target == source so do results that were found under other
/// conditions (check_conditions).
///
/// Several processes may add to one file: each waits for the one before and adds to what it wrote. When the provenance names the
/// positions that went in and `source` no longer holds them, std::runtime_error says so. Results below /mechanics that were found
/// with other bonds than those added keep theirs in a group "connectivity" of their own.
void add_results(const std::string& source, const std::string& target, const Addition& added, bool overwrite);

/// Throws InputError when `source` is damaged in such a way that add_results could not copy it. Asking before long work saves it.
void check_source(const std::string& source);

/// Writes a file of these datasets and nothing else, as write_structure does.
void write_datasets(const std::string& path, const std::vector<Dataset>& datasets, bool overwrite);

/// All datasets below a group ("/characterization"), sorted by path; empty when the group does not exist.
std::vector<Dataset> read_results(const std::string& path, const std::string& group);

/// The history, oldest first.
std::vector<Provenance> read_provenance(const std::string& path);

/// SHA-256 of the positions as stored (hexadecimal).
std::string positions_sha256(const Packing& packing);

/// SHA-256 of datasets, their paths and values (hexadecimal).
std::string datasets_sha256(const std::vector<Dataset>& datasets);

}  // namespace coagula::io
