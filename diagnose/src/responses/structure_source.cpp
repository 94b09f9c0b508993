// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/structure_source.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace coagula::diagnose {

Settings as_stated(Settings settings) {
    settings.structures = {};
    return settings;
}

double PoreCurve::at(double radius) const {
    if (radius >= largest) {
        return 0;
    }
    const double place = std::max(radius, 0.0) / largest * static_cast<double>(probability.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    return std::lerp(probability[below], probability[below + 1], place - static_cast<double>(below));
}

Structures::Structures(std::vector<Packing> given) {
    for (Packing& packing : given) {
        particles_.push_back(static_cast<std::size_t>(packing.size()));
        packings_.emplace_back(std::move(packing));
    }
}

Structures::Structures(std::vector<std::size_t> particles, std::function<Packing(std::size_t structure)> make)
    : particles_(std::move(particles)), make_(std::move(make)), packings_(particles_.size()) {}

const Packing& Structures::operator[](std::size_t structure) const {
    std::optional<Packing>& packing = packings_[structure];
    if (!packing) {
        packing = make_(structure);
    }
    return *packing;
}

}  // namespace coagula::diagnose
