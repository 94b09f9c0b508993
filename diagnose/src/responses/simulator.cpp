// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/simulator.hpp>

#include <coagula/common/checks.hpp>
#include <coagula/common/parallel.hpp>

#include <sstream>

namespace coagula::diagnose {

Simulator::Simulator(std::vector<Packing> structures, std::vector<std::string> names, SimulationCache& cache,
                     const Progress& progress, std::vector<std::size_t> groups)
    : Simulator(Structures(std::move(structures)), std::move(names), cache, progress, std::move(groups), 0) {
    require(structures_.size() == names_.size(), "every structure must have a name");
    require(groups_.empty() || groups_.size() == structures_.size(), "every structure must belong to a group, or none");
    radius_ = structures_.size() > 0 ? mean_radius(structures_[0]) : 0;
}

Simulator::Simulator(Structures structures, std::vector<std::string> names, SimulationCache& cache, Progress progress,
                     std::vector<std::size_t> groups, double radius)
    : structures_(std::move(structures)),
      names_(std::move(names)),
      groups_(std::move(groups)),
      distinct_groups_(groups_.empty() ? std::set<std::size_t>{0} : std::set(groups_.begin(), groups_.end())),
      cache_(cache),
      progress_(std::move(progress)),
      radius_(radius) {}

std::vector<std::size_t> Simulator::members(std::size_t group) const {
    std::vector<std::size_t> found;
    for (std::size_t k = 0; k < structures_.size(); ++k) {
        if (group == 0 || (!groups_.empty() && groups_[k] == group)) {
            found.push_back(k);
        }
    }
    require(!found.empty(), "no structure belongs to group " + std::to_string(group));
    return found;
}

double Simulator::particles(std::size_t group) const {
    const std::vector<std::size_t> structures = members(group);
    double sum = 0;
    for (const std::size_t k : structures) {
        sum += static_cast<double>(structures_.particles(k));
    }
    return sum / static_cast<double>(structures.size());
}

void Simulator::use(OtherStages stages) {
    stages_ = std::move(stages);
}

Simulator& Simulator::remade(const StructureChange& change) {
    if (change == StructureChange{}) {
        return *this;
    }
    const std::lock_guard lock(threads_->mutex);
    std::unique_ptr<Simulator>& other = remade_[change];
    if (other) {
        return *other;
    }
    require(stages_.make && stages_.name, "only structures that a recipe made can be made again");
    std::vector<std::string> names;
    std::vector<std::size_t> particles;
    for (std::size_t k = 0; k < structures_.size(); ++k) {
        names.push_back(names_[k] + " remade: " + stages_.name(k, change));
        particles.push_back(structures_.particles(k));
    }
    const auto make = [this, change](std::size_t structure) {
        progress_.update("simulating", 0.0, "structures made again");
        return stages_.make(structure, change);
    };
    // NOLINTNEXTLINE(cppcoreguidelines-owning-memory): std::make_unique cannot call a private constructor
    other.reset(new Simulator(Structures(std::move(particles), make), std::move(names), cache_, progress_, groups_, radius_));
    other->stages_.measure_pores = stages_.measure_pores;
    other->threads_ = threads_;
    return *other;
}

const Packing& Simulator::structure(std::size_t number) const {
    if (!structures_.is_made(number)) {
        require_simulations();
    }
    return structures_[number];
}

void Simulator::require_simulations() const {
    if (!threads_->simulate) {
        throw NotSimulatedYet{};
    }
}

void Simulator::together(std::size_t count, const std::function<void(std::size_t)>& work) {
    std::vector<char> left(count, 1);  // no bits: threads write beside each other
    if (threads_->simulate && count > 1) {
        const std::unique_ptr<bool, void (*)(bool*)> until_end(&threads_->simulate, [](bool* simulate) { *simulate = true; });
        threads_->simulate = false;
        run_together(count, [&](std::size_t k) {
            try {
                work(k);
                left[k] = 0;
            } catch (const NotSimulatedYet&) {
            }
        });
    }
    for (std::size_t k = 0; k < count; ++k) {
        if (left[k] != 0) {
            work(k);
        }
    }
}

const std::any* Simulator::in_memory(const ResultKey& key) const {
    const std::lock_guard lock(threads_->mutex);
    const auto found = memory_.find(key);
    return found == memory_.end() ? nullptr : &found->second;
}

/// Another thread may have been faster: its value is the same and stays, because it may be in use.
const std::any& Simulator::into_memory(const ResultKey& key, std::any value) {
    const std::lock_guard lock(threads_->mutex);
    return memory_.emplace(key, std::move(value)).first->second;
}

PoreCurve Simulator::measured_pores(const Packing& packing) const {
    require(static_cast<bool>(stages_.measure_pores), "nothing measures the pores of the structures");
    return stages_.measure_pores(packing);
}

std::string Simulator::text_of(const ResultKey& key) const {
    std::ostringstream text;
    text << key.what << ' ' << names_[key.of];
    text.precision(17);
    for (const double value : key.at) {
        text << ' ' << value;
    }
    return text.str();
}

const std::vector<double>* Simulator::in_cache(const ResultKey& key, std::size_t count) const {
    constexpr std::size_t fewest = 3;
    const auto found = cache_.find(text_of(key));
    const bool whole = found != cache_.end() && (count > 0 ? found->second.size() == count : found->second.size() >= fewest);
    return whole ? &found->second : nullptr;
}

const std::vector<double>& Simulator::keep(const ResultKey& key, std::vector<double> values) {
    return cache_.insert_or_assign(text_of(key), std::move(values)).first->second;
}

const std::vector<double>& Simulator::simulated(const ResultKey& key, std::size_t count, const Run& run) {
    const std::vector<double>* known = in_cache(key, count);
    if (known != nullptr) {
        return *known;
    }
    require_simulations();
    return keep(key, run(structures_[key.of]));
}

std::vector<double> Simulator::mean_over_structures(std::string_view what, std::size_t count, const std::vector<double>& at,
                                                    const Run& run) {
    std::vector<double> mean(count, 0.0);
    for (std::size_t k = 0; k < structures_.size(); ++k) {
        const std::vector<double>& one = simulated({what, k, at}, count, run);
        for (std::size_t entry = 0; entry < count; ++entry) {
            mean[entry] += one[entry] / static_cast<double>(structures_.size());
        }
    }
    return mean;
}

}  // namespace coagula::diagnose
