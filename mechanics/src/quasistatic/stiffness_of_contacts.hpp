// SPDX-License-Identifier: GPL-3.0-or-later
// The tangent of a sheared network: products with it contact by contact, and its symmetric part as a block matrix.
#pragma once

#include "sheared_network.hpp"

#include <functional>
#include <vector>

namespace coagula::mechanics {

class StiffnessOfContacts {
public:
    StiffnessOfContacts(const ShearedNetwork& network, const Trial& trial);

    /// Minus the change of all forces and moments by a small motion.
    Motion operator*(const Motion& motion) const;

    /// Change of all forces and moments per strain when all particles follow it affinely.
    Motion strain_load() const;

    /// The contacts from which the directions of negative stiffness are taken out, so that the symmetric part is convex (projected
    /// Newton: Teran, Sifakis, Irving, Fedkiw, Symp. Computer Animation 2005, 181). Slip and compression cause such directions.
    enum class Convex { contacts_without_bond, all };

    /// Symmetric part, upper triangle.
    BlockMatrix symmetric_part(Convex convex) const;
    /// Calls with every contact that has any stiffness and what it adds to that.
    void for_each_part(Convex convex, const std::function<void(Index contact, const Slope& part)>& visit) const;

private:
    struct Link {
        Index contact;
        bool bonded;
        Index first;
        Index second;
        Slope slope;
        Eigen::Vector3d strain_rate;  ///< affine change of the branch per strain, reduced
    };

    static Slope part_of(const Link& link, Convex convex);
    template <class Change>
    Motion gather(const Change& change_of) const;

    Index particles_;
    std::vector<Link> links_;
    ContactsByParticle groups_;
};

}  // namespace coagula::mechanics
