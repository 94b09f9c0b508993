#include <coagula/common/packing.hpp>

#include <coagula/common/checks.hpp>
#include <coagula/common/contact_network.hpp>

#include <numbers>
#include <stdexcept>

namespace coagula {

namespace {

std::string particle_name(const std::string& name, Index particle) {
    return name + ": particle " + std::to_string(particle);
}

void check_one(const Packing& packing, Index particle, const std::string& name) {
    const Eigen::Vector3d position = packing.positions.col(particle);
    const double radius = packing.radii[particle];
    require(position.allFinite(), particle_name(name, particle) + " has a coordinate that is not a finite number");
    require(std::isfinite(radius) && radius > 0,
            particle_name(name, particle) + " has radius " + to_text(radius) + " m, but a radius must be finite and positive");
    if (!packing.cell.is_periodic()) {
        return;
    }
    for (int axis = 0; axis < 3; ++axis) {
        const double low = packing.cell.origin()[axis];
        const double high = low + packing.cell.edges()(axis, axis);
        const double slack = 1e-9 * (high - low);
        require(position[axis] >= low - slack && position[axis] <= high + slack,
                particle_name(name, particle) + " lies outside the box: its " + "xyz"[axis] + " is " + to_text(position[axis]) +
                    " m, the box goes from " + to_text(low) + " to " + to_text(high) + " m");
    }
}

void check_distinct_centres(const Packing& packing, const std::string& name) {
    const ContactNetwork coincident = find_pairs(packing, 1e-6 * packing.radii.minCoeff());
    if (coincident.size() > 0) {
        throw std::invalid_argument(name + ": particles " + std::to_string(coincident.ends(0, 0)) + " and " +
                                    std::to_string(coincident.ends(1, 0)) + " have the same centre");
    }
}

}  // namespace

void check(const Packing& packing, const std::string& name) {
    require(packing.size() > 0, name + " has no particles");
    require(packing.radii.size() == packing.size(),
            name + " has " + std::to_string(packing.size()) + " positions but " + std::to_string(packing.radii.size()) + " radii");
    for (Index particle = 0; particle < packing.size(); ++particle) {
        check_one(packing, particle, name);
    }
    check_distinct_centres(packing, name);
}

double solid_volume(const Packing& packing) {
    return 4 * std::numbers::pi / 3 * packing.radii.array().cube().sum();
}

double volume_fraction(const Packing& packing) {
    return solid_volume(packing) / packing.cell.volume();
}

bool is_monodisperse(const Packing& packing) {
    return packing.radii.maxCoeff() - packing.radii.minCoeff() <= 1e-12 * packing.radii.maxCoeff();
}

double mean_radius(const Packing& packing) {
    return packing.radii.mean();
}

}  // namespace coagula
