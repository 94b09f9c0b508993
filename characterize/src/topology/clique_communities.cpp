// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/cliques.hpp>
#include <coagula/common/checks.hpp>
#include <coagula/common/image_sets.hpp>

#include <algorithm>
#include <map>

namespace coagula::characterize {

namespace {

using Triangles = std::vector<Index>;  ///< columns of Cliques::triangles

/// For each clique (column), a clique that stands for all that are joined with it by common facets (entries of the column).
template <class Facets>
std::vector<std::size_t> joined_cliques(const Facets& facets) {
    ImageSets sets(facets.cols());
    std::map<Index, std::size_t> first_with;
    for (Index clique = 0; clique < facets.cols(); ++clique) {
        for (const Index facet : facets.col(clique)) {
            const auto place = static_cast<std::size_t>(clique);
            sets.join(first_with.emplace(facet, place).first->second, place, ImageSets::Image::Zero());
        }
    }
    std::vector<std::size_t> joined(static_cast<std::size_t>(facets.cols()));
    for (std::size_t clique = 0; clique < joined.size(); ++clique) {
        joined[clique] = sets.find(clique).root;
    }
    return joined;
}

/// The triangles of each community.
std::vector<Triangles> triangles_of_communities(const Cliques& cliques, int size) {
    const std::vector<std::size_t> joined =
        size == 3 ? joined_cliques(cliques.triangle_contacts) : joined_cliques(cliques.tetrahedra);
    std::map<std::size_t, Triangles> by_root;
    for (std::size_t clique = 0; clique < joined.size(); ++clique) {
        const auto column = static_cast<Index>(clique);
        Triangles& triangles = by_root[joined[clique]];
        if (size == 3) {
            triangles.push_back(column);
        } else {
            triangles.insert(triangles.end(), cliques.tetrahedra.col(column).begin(), cliques.tetrahedra.col(column).end());
        }
    }
    std::vector<Triangles> communities;
    for (auto& [root, triangles] : by_root) {
        communities.push_back(std::move(triangles));
    }
    return communities;
}

template <class Number>
void sort_and_keep_one_of_each(std::vector<Number>& numbers) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

CliqueCommunity community_of(const Cliques& cliques, const Triangles& triangles) {
    CliqueCommunity community;
    for (const Index triangle : triangles) {
        for (int k = 0; k < 3; ++k) {
            community.particles.push_back(cliques.triangles(k, triangle));
            community.contacts.push_back(cliques.triangle_contacts(k, triangle));
        }
    }
    sort_and_keep_one_of_each(community.particles);
    sort_and_keep_one_of_each(community.contacts);
    return community;
}

bool is_before(const CliqueCommunity& a, const CliqueCommunity& b) {
    if (a.particles.size() != b.particles.size()) {
        return a.particles.size() > b.particles.size();
    }
    if (a.contacts.size() != b.contacts.size()) {
        return a.contacts.size() > b.contacts.size();
    }
    return a.particles != b.particles ? a.particles < b.particles : a.contacts < b.contacts;
}

}  // namespace

bool CliqueCommunities::share_one(Index first, Index second) const {
    const std::vector<int>& own = of_particle[static_cast<std::size_t>(first)];
    const std::vector<int>& other = of_particle[static_cast<std::size_t>(second)];
    return std::any_of(own.begin(), own.end(), [&](int one) { return std::binary_search(other.begin(), other.end(), one); });
}

CliqueCommunities find_clique_communities(const ContactNetwork& contacts, const Cliques& cliques, int size) {
    require(size == 3 || size == 4, "the cliques of a community must have 3 or 4 particles");
    CliqueCommunities result;
    for (const Triangles& triangles : triangles_of_communities(cliques, size)) {
        result.communities.push_back(community_of(cliques, triangles));
    }
    std::stable_sort(result.communities.begin(), result.communities.end(), is_before);
    result.of_particle.resize(static_cast<std::size_t>(contacts.particles));
    for (std::size_t place = 0; place < result.communities.size(); ++place) {
        for (const std::int32_t particle : result.communities[place].particles) {
            result.of_particle[static_cast<std::size_t>(particle)].push_back(static_cast<int>(place));
        }
    }
    return result;
}

}  // namespace coagula::characterize
