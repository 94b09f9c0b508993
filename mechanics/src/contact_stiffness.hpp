// The tangent of a sheared network: products with it contact by contact, and its symmetric part as a block matrix.
#pragma once

#include "sheared_network.hpp"

#include <vector>

namespace coagula::mechanics {

class ContactStiffness {
public:
    ContactStiffness(const ShearedNetwork& network, const Trial& trial);

    /// Minus the change of all forces and moments by a small motion.
    Motion operator*(const Motion& motion) const;

    /// Change of all forces and moments per strain when all particles follow it affinely.
    Motion strain_load() const;

    /// Symmetric part, upper triangle.
    BlockMatrix symmetric_part() const;

private:
    struct Link {
        Index first;
        Index second;
        Eigen::Matrix<double, 9, 9> slope;
        Eigen::Vector3d strain_rate;  ///< affine change of the branch per strain, reduced
    };

    template <class Change>
    Motion gather(const Change& change_of) const;

    Index particles_;
    std::vector<Link> links_;
    ContactsByParticle groups_;
};

}  // namespace coagula::mechanics
