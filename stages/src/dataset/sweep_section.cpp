// SPDX-License-Identifier: GPL-3.0-or-later
#include "sweep_section.hpp"

#include <coagula/common/checks.hpp>

namespace coagula::stages {

void fail_at(const std::string& where, const std::string& key, const std::string& rule) {
    throw InputError(where + ", key '" + key + "': " + rule);
}

Combinations::Combinations(const Section& generate, const std::optional<Section>& characterize, const std::optional<Section>& shear)
    : sections_{&generate, characterize ? &*characterize : nullptr, shear ? &*shear : nullptr} {
    for (std::size_t stage = 0; stage < sections_.size(); ++stage) {
        for (std::size_t k = 0; sections_[stage] != nullptr && k < sections_[stage]->axes.size(); ++k) {
            const Axis& axis = sections_[stage]->axes[k];
            if (axis.range || axis.values.size() > 1) {
                varied_.emplace_back(stage, k);
            }
        }
    }
}

std::size_t Combinations::count(const Design& design) const {
    const auto replicates = static_cast<std::size_t>(sections_[0]->replicates);
    std::size_t points = design.kind == Design::Kind::grid ? 1 : static_cast<std::size_t>(design.samples);
    if (design.kind == Design::Kind::grid) {
        for (const auto& [stage, axis] : varied_) {
            points = product(points, sections_[stage]->axes[axis].values.size());
        }
    }
    return product(points, replicates);
}

void Combinations::each(const Design& design, const std::function<void(const std::array<Values, 3>&)>& take) const {
    if (design.kind == Design::Kind::grid) {
        std::vector<std::size_t> place(varied_.size(), 0);
        do {
            replicate(values_at([&](const Axis& axis, std::size_t k) { return axis.values[place[k]]; }), take);
        } while (advance(place));
        return;
    }
    for (const std::vector<double>& point : space_filling_points(design, varied_.size())) {
        replicate(values_at([&](const Axis& axis, std::size_t k) { return axis.at(point[k]); }), take);
    }
}

std::size_t Combinations::product(std::size_t points, std::size_t factor) const {
    if (points > most_structures / factor) {
        throw InputError(sections_[0]->where + ": the sweep has more than " + std::to_string(most_structures) +
                         " structures; give fewer values, or a design with samples");
    }
    return points * factor;
}

std::array<Values, 3> Combinations::values_at(const std::function<Given(const Axis&, std::size_t)>& choose) const {
    std::array<Values, 3> values;
    for (std::size_t stage = 0; stage < sections_.size(); ++stage) {
        for (std::size_t k = 0; sections_[stage] != nullptr && k < sections_[stage]->axes.size(); ++k) {
            const Axis& axis = sections_[stage]->axes[k];
            if (!axis.range && axis.values.size() == 1) {
                values[stage][axis.option] = axis.values.front();
            }
        }
    }
    for (std::size_t k = 0; k < varied_.size(); ++k) {
        const Axis& axis = sections_[varied_[k].first]->axes[varied_[k].second];
        values[varied_[k].first][axis.option] = choose(axis, k);
    }
    return values;
}

/// The last axis runs fastest: those of the generator change slowest.
bool Combinations::advance(std::vector<std::size_t>& place) const {
    for (std::size_t k = varied_.size(); k-- > 0;) {
        if (++place[k] < sections_[varied_[k].first]->axes[varied_[k].second].values.size()) {
            return true;
        }
        place[k] = 0;
    }
    return false;
}

void Combinations::replicate(std::array<Values, 3> values, const std::function<void(const std::array<Values, 3>&)>& take) const {
    const std::int64_t replicates = sections_[0]->replicates;
    const auto given = values[0].find("seed");
    const auto* whole = given == values[0].end() ? nullptr : std::get_if<std::int64_t>(&given->second);
    const std::int64_t first = whole == nullptr ? 1 : *whole;
    for (std::int64_t k = 0; k < replicates; ++k) {
        if (replicates > 1) {
            values[0]["seed"] = first + k;
        }
        take(values);
    }
}

}  // namespace coagula::stages
