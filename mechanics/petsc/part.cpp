// SPDX-License-Identifier: GPL-3.0-or-later
#include "part.hpp"

#include "bricks.hpp"

#include <algorithm>
#include <cstdint>

namespace coagula::mechanics {

namespace {

constexpr std::int32_t elsewhere = -1;

/// Numbers of particles when the processes count theirs in turn, for the particles that one process asks for.
class CountInTurn {
public:
    CountInTurn(const ProblemFile& problem, const Bricks& bricks, int processes)
        : owner_(static_cast<std::size_t>(problem.particles())), first_(static_cast<std::size_t>(processes) + 1, 0) {
        for (Index particle = 0; particle < problem.particles(); ++particle) {
            const int owner = bricks.owner(problem.fraction().col(particle));
            owner_[static_cast<std::size_t>(particle)] = owner;
            ++first_[static_cast<std::size_t>(owner) + 1];
        }
        for (std::size_t process = 1; process < first_.size(); ++process) {
            first_[process] += first_[process - 1];
        }
    }
    int owner(Index particle) const { return owner_[static_cast<std::size_t>(particle)]; }

    /// @param wanted ascending.
    std::vector<Index> numbers(const std::vector<Index>& wanted) const {
        std::vector<Index> next(first_.begin(), first_.end() - 1);
        std::vector<Index> numbers;
        Index particle = 0;
        for (const Index one : wanted) {
            for (; particle < one; ++particle) {
                ++next[static_cast<std::size_t>(owner(particle))];
            }
            numbers.push_back(next[static_cast<std::size_t>(owner(one))]);
        }
        return numbers;
    }

private:
    std::vector<std::int32_t> owner_;
    std::vector<Index> first_;
};

/// Gives numbers to the particles that a bond joins to those that have one.
void add_layer(const ProblemFile& problem, Part& part, std::vector<std::int32_t>& number) {
    std::vector<bool> reached(number.size(), false);
    const auto reach = [&](std::int64_t from, std::int64_t to) {
        if (from >= 0 && to >= 0 && number[static_cast<std::size_t>(from)] != elsewhere) {
            reached[static_cast<std::size_t>(to)] = true;
        }
    };
    for (const auto& [first, second] : problem.ends()) {
        reach(first, second);
        reach(second, first);
    }
    for (std::size_t particle = 0; particle < number.size(); ++particle) {
        if (reached[particle] && number[particle] == elsewhere) {
            number[particle] = 0;  // counted below, when all are known
            part.particle.push_back(static_cast<Index>(particle));
        }
    }
}

void add_bonds(const ProblemFile& problem, const std::vector<std::int32_t>& number, Part& part) {
    const auto local = [&](Index particle) -> Index { return particle < 0 ? -1 : number[static_cast<std::size_t>(particle)]; };
    for (std::size_t place = 0; place < problem.ends().size(); ++place) {
        const auto [first, second] = problem.ends()[place];
        if (local(first) != elsewhere || local(second) != elsewhere) {
            LinearBond bond = problem.bond(place);
            bond.first = local(first);
            bond.second = local(second);
            part.bonds.push_back(bond);
        }
    }
}

}  // namespace

Part part_of(const ProblemFile& problem, int process, int processes, int overlap) {
    const CountInTurn count(problem, Bricks(problem.lengths(), processes), processes);
    Part part;
    std::vector<std::int32_t> number(static_cast<std::size_t>(problem.particles()), elsewhere);
    for (Index particle = 0; particle < problem.particles(); ++particle) {
        if (count.owner(particle) == process) {
            number[static_cast<std::size_t>(particle)] = 0;
            part.particle.push_back(particle);
        }
    }
    part.own = static_cast<Index>(part.particle.size());
    for (int layer = 0; layer < overlap; ++layer) {
        add_layer(problem, part, number);
    }
    std::sort(part.particle.begin() + part.own, part.particle.end());
    part.neighbour = count.numbers({part.particle.begin() + part.own, part.particle.end()});
    part.fraction.resize(3, static_cast<Index>(part.particle.size()));
    for (std::size_t place = 0; place < part.particle.size(); ++place) {
        number[static_cast<std::size_t>(part.particle[place])] = static_cast<std::int32_t>(place);
        part.fraction.col(static_cast<Index>(place)) = problem.fraction().col(part.particle[place]);
    }
    add_bonds(problem, number, part);
    return part;
}

}  // namespace coagula::mechanics
