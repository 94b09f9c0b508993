// The complex stiffness matrix of a bonded network with losses and drag, its loads, and the sums that give the moduli. Reduced
// units as in stiffness.hpp, but stiffness in the complex normal contact stiffness k_n*.
#pragma once

#include "complex_factor.hpp"
#include "stiffness.hpp"

#include <Eigen/Core>

#include <vector>

namespace coagula::mechanics {

/// What the matrix depends on at one frequency: K* = K_along + shear K_across + drag D.
struct Ratios {
    Complex shear;  ///< k_s* / k_n*
    Complex drag;   ///< i w eta r0 / k_n*; 0: no solvent
};

/// Quadratic forms of a solution: e_a . e_b of the six strains' relative displacements, summed over the bonds, along and across the
/// bond, and of the motion relative to the solvent, weighted by the drag of each particle.
struct Forms {
    using Tensor = Eigen::Matrix<Complex, 6, 6>;
    using Powers = Eigen::Matrix<double, 6, 1>;

    Tensor along = Tensor::Zero();
    Tensor across = Tensor::Zero();
    Tensor drag = Tensor::Zero();
    /// The same with the complex conjugate, for each strain: squared amplitudes.
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
    FrequencyNetwork(const Packing& packing, const ContactNetwork& bonds, const LoadBearing& kept);

    Index particles() const { return along_.particles(); }
    /// Both triangles; the blocks are those of motion along the bonds.
    const BlockMatrix& pattern() const { return along_matrix_; }
    /// Upper triangle, for the order of elimination.
    const BlockMatrix& upper() const { return upper_; }

    /// K*.
    ComplexBlocks matrix(const Ratios& ratios) const;

    /// Minus the force on every unknown when all particles follow the strain: drag does not load, because the solvent is affine
    /// too.
    ComplexLoads loads(const Ratios& ratios) const;

    /// Size of loads that symmetry has not cancelled: the square root of the affine energy of each strain.
    Eigen::Array<double, 1, 6> load_scale() const { return load_scale_; }

    /// y = K* x; rows in parallel, the same bits for any number of threads.
    void multiply(const ComplexBlocks& matrix, const ComplexLoads& x, ComplexLoads& y) const;

    /// The pattern of the upper triangle as scalar rows and columns, and the values of K* + shift (I + free spins) in that order.
    void scalar_pattern(std::vector<int>& row, std::vector<int>& column) const;
    std::vector<Complex> scalar_values(const ComplexBlocks& matrix, double shift) const;

    Forms forms(const ComplexLoads& motion) const;

private:
    /// Calls visit(row, entry) for every block of the upper triangle.
    template <class Visit>
    void for_each_upper(const Visit& visit) const;

    LinearNetwork along_;
    LinearNetwork isotropic_;
    BlockMatrix upper_;
    BlockMatrix along_matrix_;
    BlockMatrix isotropic_matrix_;
    Loads along_loads_;
    Loads isotropic_loads_;
    std::vector<Block> spin_;  ///< per particle: unit stiffness of a spin that no bond resists
    Eigen::VectorXd drag_;     ///< per unknown: 6 pi r / r0 or 8 pi (r / r0)^3
    Eigen::Array<double, 1, 6> load_scale_;
};

}  // namespace coagula::mechanics
