// SPDX-License-Identifier: GPL-3.0-or-later
// The whole interaction of two spheres: a sum of pair laws, continued below a small gap by a linear elastic contact.
#pragma once

#include <coagula/generators/pair_laws.hpp>

#include <optional>
#include <vector>

namespace coagula::generators {

/// The elastic contact that replaces the laws at small gaps, where the van der Waals force diverges.
struct ElasticContact {
    double stiffness = unset;        ///< [N/m], > 0
    double equilibrium_gap = unset;  ///< gap at which two spheres in contact rest [m], > 0
};

/// An extreme of the energy.
struct Extreme {
    double gap = unset;     ///< [m]
    double energy = unset;  ///< [J], zero for spheres far apart
};

/// Sum of laws above a cut-off gap; below it the force continues as f(cut) + stiffness (cut - gap).
class PairPotential {
public:
    /// The cut-off is solved so that the force vanishes at the equilibrium gap; laws that repel there are cut at that gap.
    /// Throws std::invalid_argument when no law is given, or when no cut-off gap leads to the equilibrium wanted (the attraction is
    /// too strong for so soft a contact).
    PairPotential(std::vector<PairLaw> laws, const ElasticContact& contact);
    /// Laws that have a well of their own: they act down to a cut-off gap where they repel. The equilibrium gap is the first above
    /// it where the force vanishes. Throws std::invalid_argument when there is none.
    /// @param stiffness below the cut-off gap [N/m], > 0. @param farthest gap where the bottom of the well may be [m].
    PairPotential(std::vector<PairLaw> laws, double stiffness, double cut_gap, double farthest);

    double energy(double gap) const;
    double force(double gap) const;
    /// Below this gap the contact is elastic [m].
    double cut_gap() const { return cut_gap_; }
    const ElasticContact& contact() const { return contact_; }
    /// Whether the laws themselves make the well in which contacts rest.
    bool has_well() const { return cut_gap_ < contact_.equilibrium_gap; }

    /// The highest maximum of the energy outside the contact, which spheres must pass to touch; none if there is none.
    /// @param farthest gap that is searched [m].
    std::optional<Extreme> barrier(double farthest) const;
    /// The lowest minimum beyond the barrier; none when there is no maximum to separate it from the contact.
    std::optional<Extreme> secondary_minimum(double farthest) const;
    /// What spheres have to climb on their way to contact: from the secondary minimum, or from far apart where that is lower, to
    /// the barrier [J]; 0 without a barrier.
    double barrier_height(double farthest) const;
    /// The rest state of the contact itself.
    Extreme contact_minimum() const { return {contact_.equilibrium_gap, energy(contact_.equilibrium_gap)}; }

private:
    double sum_energy(double gap) const;
    double sum_force(double gap) const;
    double solve_cut_gap() const;
    double solve_rest(double farthest) const;
    void cut_off();
    std::vector<Extreme> extremes(double farthest, bool maxima) const;

    std::vector<PairLaw> laws_;
    ElasticContact contact_;
    double cut_gap_ = unset;
    double cut_force_ = unset;
    double cut_energy_ = unset;
};

}  // namespace coagula::generators
