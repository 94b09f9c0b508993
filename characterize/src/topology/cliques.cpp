// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/cliques.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace coagula::characterize {

namespace {

/// A contact as one of its ends sees it: 2 k from the first particle of contact k to the second, 2 k + 1 back.
using Ray = Index;

Ray reversed(Ray ray) {
    return ray ^ Ray { 1 };
}

/// A clique as one of its corners sees it: the rays to the other corners, ascending.
template <std::size_t rays>
using View = std::array<Ray, rays>;

template <std::size_t rays>
View<rays> in_order(View<rays> view) {
    std::sort(view.begin(), view.end());
    return view;
}

/// The contacts as rays that leave each particle.
class RayNetwork {
public:
    explicit RayNetwork(const ContactNetwork& contacts)
        : contacts_(contacts), leaving_(static_cast<std::size_t>(contacts.particles)) {
        double shortest = std::numeric_limits<double>::infinity();
        for (Index contact = 0; contact < contacts.size(); ++contact) {
            for (const Ray ray : {2 * contact, 2 * contact + 1}) {
                leaving_[static_cast<std::size_t>(start(ray))].push_back(ray);
            }
            shortest = std::min(shortest, contacts.branch.col(contact).norm());
        }
        tolerance_ = 0.25 * shortest;
    }

    std::int32_t start(Ray ray) const { return contacts_.ends(ray % 2, ray / 2); }
    std::int32_t end(Ray ray) const { return contacts_.ends(1 - ray % 2, ray / 2); }
    const std::vector<Ray>& leaving(Index particle) const { return leaving_[static_cast<std::size_t>(particle)]; }

    /// The ray between the ends of two rays from one particle, or -1. Images of one particle lie farther apart than the centres
    /// of particles in contact.
    Ray between(Ray first, Ray second) const {
        const Eigen::Vector3d wanted = branch(second) - branch(first);
        for (const Ray ray : leaving(end(first))) {
            if (end(ray) == end(second) && (branch(ray) - wanted).squaredNorm() < tolerance_ * tolerance_) {
                return ray;
            }
        }
        return -1;
    }

private:
    Eigen::Vector3d branch(Ray ray) const { return (ray % 2 == 0 ? 1.0 : -1.0) * contacts_.branch.col(ray / 2); }

    const ContactNetwork& contacts_;
    std::vector<std::vector<Ray>> leaving_;
    double tolerance_ = 0;
};

/// The least of the views that the three corners of a triangle have. @param across from the end of `one` to that of `other`.
View<2> least_view(Ray one, Ray other, Ray across) {
    return std::min(
        {in_order<2>({one, other}), in_order<2>({reversed(one), across}), in_order<2>({reversed(other), reversed(across)})});
}

/// Whether no other corner of a tetrahedron has a lesser view. @param ab, ac, bc between the ends of the rays of the view.
bool is_least_view(const View<3>& view, Ray ab, Ray ac, Ray bc) {
    const auto& [a, b, c] = view;
    return view <= std::min({in_order<3>({reversed(a), ab, ac}), in_order<3>({reversed(b), reversed(ab), bc}),
                             in_order<3>({reversed(c), reversed(ac), reversed(bc)})});
}

/// Finds every triangle and tetrahedron from the corner with the least view, so that each is found once.
class CliqueSearch {
public:
    explicit CliqueSearch(const ContactNetwork& contacts) : contacts_(contacts), rays_(contacts) {}

    Cliques run() {
        for (Index corner = 0; corner < contacts_.particles; ++corner) {
            visit_pairs(corner, [&](Ray one, Ray other, Ray across) {
                if (in_order<2>({one, other}) == least_view(one, other, across)) {
                    triangles_.push_back({one, other});
                }
            });
        }
        std::sort(triangles_.begin(), triangles_.end());
        Cliques found;
        list_triangles(found);
        list_tetrahedra(found);
        return found;
    }

private:
    /// Calls visit(one, other, across) for all pairs of rays from a particle whose ends touch.
    template <class Visit>
    void visit_pairs(Index corner, Visit&& visit) const {
        const std::vector<Ray>& leaving = rays_.leaving(corner);
        for (auto one = leaving.begin(); one != leaving.end(); ++one) {
            for (auto other = std::next(one); other != leaving.end(); ++other) {
                const Ray across = rays_.between(*one, *other);
                if (across >= 0) {
                    visit(*one, *other, across);
                }
            }
        }
    }

    Index triangle_of(Ray one, Ray other, Ray across) const {
        return std::lower_bound(triangles_.begin(), triangles_.end(), least_view(one, other, across)) - triangles_.begin();
    }

    void list_triangles(Cliques& found) const {
        found.triangles.resize(3, std::ssize(triangles_));
        found.triangle_contacts.resize(3, std::ssize(triangles_));
        found.triangles_of_contact = Eigen::VectorXi::Zero(contacts_.size());
        found.triangles_of_particle = Eigen::VectorXi::Zero(contacts_.particles);
        Index place = 0;
        for (const auto& [one, other] : triangles_) {
            const Ray across = rays_.between(one, other);
            found.triangles.col(place) << rays_.start(one), rays_.end(one), rays_.end(other);
            found.triangle_contacts.col(place) << one / 2, other / 2, across / 2;
            for (int k = 0; k < 3; ++k) {
                ++found.triangles_of_contact[found.triangle_contacts(k, place)];
                ++found.triangles_of_particle[found.triangles(k, place)];
            }
            ++place;
        }
    }

    void list_tetrahedra(Cliques& found) const {
        std::vector<std::array<Index, 4>> faces;
        found.tetrahedra_of_particle = Eigen::VectorXi::Zero(contacts_.particles);
        for (Index corner = 0; corner < contacts_.particles; ++corner) {
            visit_pairs(corner, [&](Ray a, Ray b, Ray ab) {
                for (const Ray c : rays_.leaving(corner)) {
                    const Ray ac = c > b ? rays_.between(a, c) : -1;
                    const Ray bc = ac >= 0 ? rays_.between(b, c) : -1;
                    if (bc >= 0) {
                        ++found.tetrahedra_of_particle[corner];
                        if (is_least_view({a, b, c}, ab, ac, bc)) {
                            faces.push_back(
                                {triangle_of(a, b, ab), triangle_of(a, c, ac), triangle_of(b, c, bc), triangle_of(ab, ac, bc)});
                        }
                    }
                }
            });
        }
        found.tetrahedra.resize(4, std::ssize(faces));
        for (Index place = 0; place < found.tetrahedra.cols(); ++place) {
            const std::array<Index, 4>& four = faces[static_cast<std::size_t>(place)];
            found.tetrahedra.col(place) << four[0], four[1], four[2], four[3];
        }
    }

    const ContactNetwork& contacts_;
    RayNetwork rays_;
    std::vector<View<2>> triangles_;  ///< least views, ascending
};

}  // namespace

Cliques find_cliques(const ContactNetwork& contacts) {
    return CliqueSearch(contacts).run();
}

}  // namespace coagula::characterize
