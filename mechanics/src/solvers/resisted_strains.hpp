// SPDX-License-Identifier: GPL-3.0-or-later
// Strains that cost a network nothing, whose moduli are zero and not what rounding leaves of them.
#pragma once

#include <coagula/common/contact_network.hpp>
#include <coagula/common/packing.hpp>

#include <Eigen/Core>

#include <array>

namespace coagula::mechanics {

/// The modulus that rounding leaves where there is none, over the affine one.
inline constexpr double rounding_modulus = 1e-8;

/// Whether the bonds of a periodic cell can resist each of the six unit strains, Voigt order. It takes a cluster whose ways around
/// the box change their lengths or angles under the strain: the particles of any other cluster follow the strain and a rotation
/// that leave its bonds as they are.
std::array<bool, 6> resisted_strains(const Packing& packing, const ContactNetwork& bonds);

/// Sets the rows and columns of the other strains to zero.
template <class Tensor>
void clear_others(const std::array<bool, 6>& resisted, Tensor& tensor) {
    for (int strain = 0; strain < 6; ++strain) {
        if (!resisted.at(static_cast<std::size_t>(strain))) {
            tensor.row(strain).setZero();
            tensor.col(strain).setZero();
        }
    }
}

}  // namespace coagula::mechanics
