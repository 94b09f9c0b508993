// SPDX-License-Identifier: GPL-3.0-or-later
// The complex stiffness matrix of a bonded network with losses and drag, its loads, and the sums that give the moduli. Reduced
// units as in stiffness.hpp, but stiffness in a complex reference k*.
#pragma once

#include "frequency_pairs.hpp"
#include "solvers/complex_factor.hpp"
#include "solvers/stiffness.hpp"

#include <Eigen/Core>

#include <vector>

namespace coagula::mechanics {

/// What the matrix depends on at one frequency: K* = springs S + normal A + shear X + drag D. S are the springs of the bonds, A and
/// X unit stiffness along and across every bond, D Stokes drag and films.
struct Ratios {
    Complex springs;  ///< real reference stiffness over the complex one, k*
    Complex normal;   ///< losses of a contact over k*
    Complex shear;
    Complex drag;  ///< i w eta r0 / k*; 0: no solvent
};

/// Quadratic forms of a solution, a tensor over the six strains: sums of deformation_a . stress_b.
struct Forms {
    using Tensor = Eigen::Matrix<Complex, 6, 6>;
    using Powers = Eigen::Matrix<double, 6, 1>;

    Tensor springs = Tensor::Zero();  ///< of S
    Tensor along = Tensor::Zero();    ///< of A
    Tensor across = Tensor::Zero();   ///< of X
    Tensor drag = Tensor::Zero();     ///< of D
    Tensor rough = Tensor::Zero();    ///< of the films that are as thin as they can be
    std::vector<Tensor> changes;      ///< of other springs in the place of S
    /// Sums of the squared amplitudes, for each strain: a deformation times its complex conjugate.
    Powers along_power = Powers::Zero();
    Powers across_power = Powers::Zero();
    Powers drag_power = Powers::Zero();
};

/// A complex matrix in the pattern of the network, both triangles, ready for multiplication.
struct ComplexBlocks {
    using Block = Eigen::Matrix<Complex, 6, 6>;
    std::vector<Block> block;  ///< in the order of FrequencyNetwork::pattern()
};

class FrequencyNetwork {
public:
    /// @param reference stiffness that counts as 1 in S [N/m].
    FrequencyNetwork(const Packing& packing, const FrequencyPairs& pairs, const LoadBearing& kept, double reference);

    Index particles() const { return springs_.particles(); }
    /// Upper triangle of the springs S with the free spins stiffened; its pattern is that of K*.
    const BlockMatrix& upper() const { return upper_; }

    /// How much the stiffnesses of K* have changed relative to each other: largest |log| of the ratios now over those then.
    double change(const Ratios& now, const Ratios& then) const;

    /// K*.
    ComplexBlocks matrix(const Ratios& ratios) const;

    /// Minus the force on every unknown when all particles follow the strain: Stokes drag does not load, because the solvent is
    /// affine too; films do.
    ComplexLoads loads(const Ratios& ratios) const;

    /// Size of loads that symmetry has not cancelled: the square root of the affine energy of each strain.
    Eigen::Array<double, 1, 6> load_scale() const { return load_scale_; }

    /// y = K* x; rows in parallel, the same bits for any number of threads.
    void multiply(const ComplexBlocks& matrix, const ComplexLoads& x, ComplexLoads& y) const;

    /// The pattern of the upper triangle as scalar rows and columns, and the values of K* + shift (I + free spins) in that order.
    void scalar_pattern(std::vector<int>& row, std::vector<int>& column) const;
    std::vector<Complex> scalar_values(const ComplexBlocks& matrix, double shift) const;

    /// @param changes springs [reduced] of every bond, for Forms::changes.
    Forms forms(const ComplexLoads& motion, const std::vector<std::vector<ContactTangent>>& changes) const;

private:
    void add_drag();

    /// Calls visit(row, entry) for every block of the upper triangle.
    template <class Visit>
    void for_each_upper(const Visit& visit) const;

    LinearNetwork springs_;
    std::vector<bool> bonded_;  ///< this and the next two by springs_.bonds()
    std::vector<double> film_;  ///< over r0
    std::vector<bool> rough_;
    BlockMatrix upper_;
    BlockMatrix spring_matrix_;  ///< both triangles of each, all with the same pattern
    BlockMatrix along_matrix_;
    BlockMatrix across_matrix_;
    BlockMatrix drag_matrix_;
    Loads spring_loads_;
    Loads along_loads_;
    Loads across_loads_;
    Loads drag_loads_;
    std::vector<Block> spin_;  ///< per particle: unit stiffness of a spin that no bond resists
    Eigen::VectorXd drag_;     ///< per unknown: 6 pi r / r0 or 8 pi (r / r0)^3
    Eigen::Array<double, 1, 6> load_scale_;
};

}  // namespace coagula::mechanics
