// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/measure_input.hpp>

#include <coagula/characterize/measure.hpp>

#include "geometry/voronoi_of_diagram.hpp"
#include "pores/pores_of_diagram.hpp"

#include <optional>

namespace coagula::characterize {

namespace {

/// The value, made when it is first asked for.
template <class T, class Make>
const T& once(std::optional<T>& value, const Make& make) {
    if (!value) {
        value.emplace(make());
    }
    return *value;
}

std::optional<double> fallback_of(const std::string& option) {
    for (const Measure& measure : measures()) {
        for (const MeasureOption& candidate : measure.options) {
            if (candidate.name == option) {
                return candidate.fallback;
            }
        }
    }
    return std::nullopt;
}

}  // namespace

struct MeasureInput::Shared {
    std::optional<ReducedDiagram> diagram;
    std::optional<std::vector<bool>> inner;
    std::optional<Blocks> blocks;
    std::optional<Coordination> coordination;
    std::optional<VoronoiCells> voronoi_cells;
    std::optional<VoronoiFaces> voronoi_faces;
    std::optional<PoreSizes> pores;
};

MeasureInput::MeasureInput(Packing packing, std::map<std::string, double> options, std::uint64_t seed, Progress progress)
    : packing_(std::move(packing)),
      r0_(unset),
      options_(std::move(options)),
      seed_(seed),
      progress_(std::move(progress)),
      shared_(std::make_unique<Shared>()) {
    check(packing_);
    r0_ = mean_radius(packing_);
}

MeasureInput::MeasureInput(MeasureInput&&) noexcept = default;
MeasureInput& MeasureInput::operator=(MeasureInput&&) noexcept = default;
MeasureInput::~MeasureInput() = default;

bool MeasureInput::has(const std::string& option) const {
    return given(option) || fallback_of(option).has_value();
}

double MeasureInput::number(const std::string& option) const {
    if (const auto found = options_.find(option); found != options_.end()) {
        return found->second;
    }
    const std::optional<double> fallback = fallback_of(option);
    require(fallback.has_value(), "the option " + option + " has no value");
    return *fallback;
}

Index MeasureInput::count(const std::string& option) const {
    return static_cast<Index>(number(option));
}

const ReducedDiagram& MeasureInput::diagram() const {
    return once(shared_->diagram, [this] {
        progress_.update("Voronoi cells", 0);
        return reduced_diagram(packing_);
    });
}

const std::vector<bool>& MeasureInput::inner() const {
    return once(shared_->inner, [this] {
        return packing_.cell.is_periodic() ? std::vector<bool>(static_cast<std::size_t>(packing_.size()), true) : diagram().inner();
    });
}

const Blocks& MeasureInput::blocks() const {
    return once(shared_->blocks, [this] { return make_blocks(packing_, inner()); });
}

const Coordination& MeasureInput::coordination() const {
    return once(shared_->coordination,
                [this] { return measure_coordination(packing_, {.contact_tolerance = number("contact-tolerance")}); });
}

const VoronoiCells& MeasureInput::voronoi_cells() const {
    return once(shared_->voronoi_cells, [this] { return measure_voronoi_cells(diagram()); });
}

const VoronoiFaces& MeasureInput::voronoi_faces() const {
    return once(shared_->voronoi_faces, [this] { return measure_voronoi_faces(diagram()); });
}

const PoreSizes& MeasureInput::pores() const {
    return once(shared_->pores, [this] {
        return measure_pores(diagram(), {.radii = count("radii"), .tolerance = number("pore-tolerance")}, blocks(), progress_);
    });
}

bool MeasureInput::has_pores() const {
    return shared_->pores.has_value();
}

}  // namespace coagula::characterize
