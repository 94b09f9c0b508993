// SPDX-License-Identifier: GPL-3.0-or-later
// The structures behind a diagnosis, and what was simulated of them: each result has one key and is computed once.
#pragma once

#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>
#include <coagula/diagnose/structure_source.hpp>

#include <any>
#include <compare>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace coagula::diagnose {

/// Results by what was computed; a caller may keep it between diagnoses.
using SimulationCache = std::map<std::string, std::vector<double>>;

/// The key names what was computed and the values of its parameters.
struct ResultKey {
    std::string_view what;  ///< a literal
    std::size_t of = 0;     ///< number of the structure, or of the group of structures
    std::vector<double> at = {};
    // NOLINTNEXTLINE(modernize-use-nullptr): clang 14 takes the zero of a defaulted comparison for a pointer
    auto operator<=>(const ResultKey&) const = default;
};

/// Thrown where something would have to be simulated, and must not be.
struct NotSimulatedYet {};

/// The structures of one sample. Responses (src/responses) run them and keep their results here. Not for several threads at once
/// but in the work of `together`.
class Simulator {
public:
    using Run = std::function<std::vector<double>(const Packing& structure)>;

    /// @param names content hashes of the structures, for the cache. @param groups of each structure, from 1 (see Experiment), or
    /// empty.
    Simulator(std::vector<Packing> structures, std::vector<std::string> names, SimulationCache& cache,
              const Progress& progress = {}, std::vector<std::size_t> groups = {});

    /// Lets structures be made again and pores be measured by other stages.
    void use(OtherStages stages);

    /// The same sample with structures that have this changed. They are made when something is asked of them that the cache does
    /// not know. Throws std::invalid_argument where no recipe can make them.
    Simulator& remade(const StructureChange& change);

    std::size_t structures() const { return structures_.size(); }
    const Packing& structure(std::size_t number) const;
    /// Numbers of the structures of a group; group 0: of all.
    std::vector<std::size_t> members(std::size_t group) const;
    /// The groups that there are; 0 where there are none.
    const std::set<std::size_t>& groups() const { return distinct_groups_; }
    bool has_groups() const { return !groups_.empty(); }
    /// Mean number of particles of the structures of a group.
    double particles(std::size_t group = 0) const;
    /// Mean radius of the particles of the first structure [m].
    double radius() const { return radius_; }
    const Progress& progress() const { return progress_; }
    /// Throws std::invalid_argument where no stage measures pores.
    PoreCurve measured_pores(const Packing& packing) const;

    /// Calls work(0) ... work(count - 1), several at once. Where one asks for what was not simulated yet, it is left, and called
    /// again after all others, by itself: a simulation has all threads.
    void together(std::size_t count, const std::function<void(std::size_t)>& work);
    /// Throws NotSimulatedYet within the first calls of `together`.
    void require_simulations() const;

    /// Numbers that were simulated of structure `key.of`: those of the cache if it has `count` of them, else what `run` computes.
    const std::vector<double>& simulated(const ResultKey& key, std::size_t count, const Run& run);
    /// Their mean over the structures.
    std::vector<double> mean_over_structures(std::string_view what, std::size_t count, const std::vector<double>& at,
                                             const Run& run);
    /// Returns the numbers of the cache if it has `count` of them (for a count of 0: at least three), else null.
    const std::vector<double>* in_cache(const ResultKey& key, std::size_t count) const;
    const std::vector<double>& keep(const ResultKey& key, std::vector<double> values);

    /// Returns a value that follows from simulated numbers; it is computed when it is first asked for.
    template <class Compute>
    const auto& remembered(const ResultKey& key, const Compute& compute) {
        using Value = std::decay_t<decltype(compute())>;
        const std::any* found = in_memory(key);
        return *std::any_cast<Value>(found != nullptr ? found : &into_memory(key, compute()));
    }

private:
    Simulator(Structures structures, std::vector<std::string> names, SimulationCache& cache, Progress progress,
              std::vector<std::size_t> groups, double radius);
    std::string text_of(const ResultKey& key) const;
    const std::any* in_memory(const ResultKey& key) const;
    const std::any& into_memory(const ResultKey& key, std::any value);

    /// All threads share this, and so do the simulators of structures that are made again.
    struct Threads {
        std::mutex mutex;  ///< of memory_ and remade_
        bool simulate = true;
    };

    Structures structures_;
    std::vector<std::string> names_;
    std::vector<std::size_t> groups_;
    std::set<std::size_t> distinct_groups_;
    SimulationCache& cache_;
    std::map<ResultKey, std::any> memory_;
    Progress progress_;
    double radius_;
    OtherStages stages_;
    std::map<StructureChange, std::unique_ptr<Simulator>> remade_;
    std::shared_ptr<Threads> threads_ = std::make_shared<Threads>();
};

}  // namespace coagula::diagnose
