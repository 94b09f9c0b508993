// SPDX-License-Identifier: GPL-3.0-or-later
// Turns the raw columns of a file into packings and checks them.
#include <algorithm>
#include <array>
#include <numeric>

#include "text_reader.hpp"

namespace coagula::io {

namespace {

constexpr std::array<bool, 3> everywhere = {true, true, true};

Eigen::VectorXd radii_of(const std::string& path, const RawPacking& raw, const ImportOptions& options) {
    const auto particles = static_cast<Index>(raw.size());
    if (options.radius) {
        return Eigen::VectorXd::Constant(particles, require_positive(*options.radius, "the radius", "m"));
    }
    if (raw.radii.empty()) {
        throw InputError(path + " names no radii: give --radius (or a column 'radius' or 'diameter')");
    }
    for (std::size_t particle = 0; particle < raw.radii.size(); ++particle) {
        if (!(raw.radii[particle] > 0)) {
            throw InputError(raw.place(path, particle) + "the radius is " + to_text(raw.radii[particle]) +
                             " m, but must be positive");
        }
    }
    return Eigen::VectorXd::Map(raw.radii.data(), particles);
}

/// The box around the spheres; a given size is centred on them.
Cell open_cell(const Eigen::Matrix3Xd& positions, const Eigen::VectorXd& radii, const std::optional<Eigen::Matrix3d>& box) {
    const Eigen::Vector3d lower = (positions.rowwise() - radii.transpose()).rowwise().minCoeff();
    const Eigen::Vector3d upper = (positions.rowwise() + radii.transpose()).rowwise().maxCoeff();
    if (box) {
        const Eigen::Vector3d size = box->diagonal();
        return Cell::open(0.5 * (lower + upper - size), size);
    }
    return Cell::open(lower, upper - lower);
}

Cell cell_of(const std::string& path, const RawPacking& raw, const Packing& packing, const ImportOptions& options) {
    if (options.open) {
        const bool sized_by_file = !options.box && raw.cell && raw.cell->is_open();
        return sized_by_file ? *raw.cell : open_cell(packing.positions, packing.radii, options.box);
    }
    if (options.box) {
        const Eigen::Vector3d corner = raw.cell && !raw.cell->is_open() ? raw.cell->origin() : Eigen::Vector3d::Zero();
        return Cell::of_edges(corner, *options.box, options.periodic.value_or(everywhere));
    }
    if (!raw.cell) {
        throw InputError(path + " names no box: give --box for a periodic one or --open for a set with a free surface");
    }
    return Cell::of_edges(raw.cell->origin(), raw.cell->edges(), options.periodic.value_or(raw.cell->periodicity()));
}

/// "x is 3e-06 m, outside the periodic box from 0 to 2e-06 m".
std::string sentence_outside(const Cell& cell, int axis, const Eigen::Vector3d& position) {
    if (cell.is_rectangular()) {
        return std::string(1, "xyz"[axis]) + " is " + to_text(position[axis]) + " m, outside the periodic box from 0 to " +
               to_text(cell.edges()(axis, axis)) + " m";
    }
    return "the centre lies at " + to_text(cell.fraction(position)[axis]) + " of edge " + "abc"[axis] +
           ", outside the periodic box from 0 to 1";
}

/// Brings positions into the box along its periodic edges; more than a rounding outside is an error unless asked for.
void wrap_positions(const std::string& path, const RawPacking& raw, Packing& packing, bool wrap) {
    for (Index particle = 0; particle < packing.size(); ++particle) {
        const Eigen::Vector3d position = packing.positions.col(particle);
        const Eigen::Vector3d place = packing.cell.fraction(position);
        for (int axis = 0; axis < 3 && !wrap; ++axis) {
            if (packing.cell.is_periodic(axis) && !(place[axis] >= -raw.slack && place[axis] <= 1 + raw.slack)) {
                throw InputError(raw.place(path, static_cast<std::size_t>(particle)) +
                                 sentence_outside(packing.cell, axis, position) + "; give --wrap to bring such particles back in");
            }
        }
        packing.positions.col(particle) = packing.cell.wrap(position);
    }
}

Packing packing_of(const std::string& path, const RawPacking& raw, const ImportOptions& options) {
    if (raw.coordinates.empty()) {
        throw InputError(path + " has no particles");
    }
    Packing packing;
    packing.positions = Eigen::Matrix3Xd::Map(raw.coordinates.data(), 3, static_cast<Index>(raw.size()));
    packing.radii = radii_of(path, raw, options);
    packing.cell = cell_of(path, raw, packing, options);
    if (!packing.cell.is_open()) {  // such boxes have a corner at the origin
        packing.positions.colwise() -= packing.cell.origin();
        packing.cell = Cell::of_edges(Eigen::Vector3d::Zero(), packing.cell.edges(), packing.cell.periodicity());
        wrap_positions(path, raw, packing, options.wrap);
    }
    check(packing, path);
    if (const double fraction = volume_fraction(packing); fraction > 1) {
        throw InputError(path + " is overfull: its spheres take " + to_text(fraction) + " of the volume of the box");
    }
    return packing;
}

std::string frame_sentence(const std::string& path, std::size_t frame, const std::string& what) {
    return path + ": frame " + std::to_string(frame) + " has " + what + " than the last one; take one of them with --frame N";
}

}  // namespace

std::string RawPacking::place(const std::string& path, std::size_t particle) const {
    return path + (lines.empty() ? ", particle " + std::to_string(particle) : ", line " + std::to_string(lines[particle])) + ": ";
}

void refuse_options_of_other_formats(const std::string& path, const ImportOptions& options, std::optional<TextFormat> format) {
    if (format != TextFormat::csv && (options.axis_units || !options.columns.empty())) {
        throw InputError(path + " is no CSV file: --columns and units of single axes are for these");
    }
    if (format != TextFormat::lammps_data && !options.atom_style.empty()) {
        throw InputError(path + " is no LAMMPS data: --atom-style is for these");
    }
}

void sort_by_number(const std::string& path, const std::vector<std::size_t>& numbers, RawPacking& raw) {
    std::vector<std::size_t> order(numbers.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return numbers[a] < numbers[b]; });
    RawPacking sorted;
    sorted.cell = raw.cell;
    sorted.time = raw.time;
    sorted.slack = raw.slack;
    for (std::size_t rank = 0; rank < order.size(); ++rank) {
        const std::size_t i = order[rank];
        if (rank > 0 && numbers[i] == numbers[order[rank - 1]]) {
            throw InputError(raw.place(path, i) + "atom " + std::to_string(numbers[i]) + " occurs twice");
        }
        sorted.coordinates.insert(sorted.coordinates.end(),
                                  {raw.coordinates[3 * i], raw.coordinates[3 * i + 1], raw.coordinates[3 * i + 2]});
        if (!raw.radii.empty()) {
            sorted.radii.push_back(raw.radii[i]);
        }
        if (!raw.lines.empty()) {
            sorted.lines.push_back(raw.lines[i]);
        }
    }
    raw = std::move(sorted);
}

void FrameCollector::add(RawPacking&& raw, std::int64_t number) {
    pass_over(number);
    const bool wanted = choice_.kind == FrameChoice::Kind::all || choice_.kind == FrameChoice::Kind::last ||
                        (choice_.kind == FrameChoice::Kind::first && count_ == 1) ||
                        (choice_.kind == FrameChoice::Kind::number && choice_.number == number);
    if (!wanted) {
        return;
    }
    if (choice_.kind != FrameChoice::Kind::all) {
        kept_.clear();
    }
    kept_.push_back(std::move(raw));
}

bool FrameCollector::wants(std::int64_t number, std::int64_t count) const {
    switch (choice_.kind) {
        case FrameChoice::Kind::all:
            return true;
        case FrameChoice::Kind::first:
            return number == 0;
        case FrameChoice::Kind::number:
            return number == choice_.number;
        case FrameChoice::Kind::last:
            break;
    }
    return number == count - 1;
}

void FrameCollector::pass_over(std::int64_t number) {
    first_ = count_ == 0 ? number : first_;
    last_ = number;
    ++count_;
}

std::vector<RawPacking> FrameCollector::take(const std::string& path) {
    if (kept_.empty() && count_ > 0) {
        throw InputError(path + " has no frame " + std::to_string(choice_.number) + ": its " + std::to_string(count_) +
                         " frames are numbered from " + std::to_string(first_) + " to " + std::to_string(last_));
    }
    return std::move(kept_);
}

Structure finish(const std::string& path, const std::vector<RawPacking>& frames, const ImportOptions& options) {
    if (frames.empty()) {
        throw InputError(path + " has no particles");
    }
    const bool timed = std::isfinite(frames.back().time);
    Structure structure{packing_of(path, frames.back(), options), std::nullopt, {}, timed ? frames.back().time : 0.0};
    const Packing& last = structure.packing;
    for (std::size_t k = 0; k + 1 < frames.size(); ++k) {
        if (frames[k].size() != frames.back().size()) {
            throw InputError(frame_sentence(path, k, "another number of particles"));
        }
        Packing packing = packing_of(path, frames[k], options);
        const bool same_box = packing.cell.periodicity() == last.cell.periodicity() &&
                              (last.cell.is_open() || packing.cell.edges() == last.cell.edges());
        if (!same_box) {
            throw InputError(frame_sentence(path, k, "another box"));
        }
        if (packing.radii != last.radii) {
            throw InputError(frame_sentence(path, k, "other radii"));
        }
        if (std::isfinite(frames[k].time) != timed) {
            throw InputError(path + ": some frames have a time and others have none");
        }
        structure.earlier.push_back({timed ? frames[k].time : static_cast<double>(k), std::move(packing.positions)});
    }
    if (!timed && frames.size() > 1) {
        structure.time = static_cast<double>(frames.size() - 1);
    }
    return structure;
}

}  // namespace coagula::io
