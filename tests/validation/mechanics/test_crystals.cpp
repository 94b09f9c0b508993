// SPDX-License-Identifier: GPL-3.0-or-later
// Crystals: every particle is a centre of inversion and the fabric is isotropic, so the deformation is affine and
// C_ijkl = (d^2 / V) sum over bonds of [(k_n - k_s) n_i n_j n_k n_l + k_s (delta_ik n_j n_l + ...) / 4] in closed form.
#include <coagula/mechanics/linear.hpp>

#include "support/lattices.hpp"

#include <gtest/gtest.h>

namespace coagula::mechanics {
namespace {

using namespace coagula::testing;

constexpr double radius = 0.25e-6;
constexpr double d = 2 * radius;
constexpr double kn = 50;  // contact values for the default particle stiffnesses 100 and 10 N/m
constexpr double ks = 5;

struct CubicConstants {
    double c11, c12, c44;
};

void expect_cubic(const Packing& packing, const CubicConstants& expected, Index floppy_modes) {
    const auto response = solve_linear(packing, find_contacts(packing, 0.01));
    Eigen::Matrix<double, 6, 6> tensor = Eigen::Matrix<double, 6, 6>::Zero();
    tensor.topLeftCorner<3, 3>().setConstant(expected.c12);
    tensor.diagonal() << expected.c11, expected.c11, expected.c11, expected.c44, expected.c44, expected.c44;
    EXPECT_LT((response.elastic_tensor - tensor).cwiseAbs().maxCoeff(), 1e-9 * expected.c11) << response.elastic_tensor;
    EXPECT_LT(response.non_affinity.maxCoeff(), 1e-9);
    EXPECT_EQ(response.rattlers, 0);
    EXPECT_EQ(response.floppy_modes, floppy_modes);
}

// Neighbours that turn like gears do not slide: along each axis every layer of an even simple cubic crystal may do so by itself.
// With an odd number of layers the pattern does not close.
TEST(Crystals, SimpleCubic) {
    expect_cubic(make_lattice(simple_cubic(), 4, 4, 4, radius), {kn / d, 0, ks / (2 * d)}, 12);
    expect_cubic(make_lattice(simple_cubic(), 3, 3, 3, radius), {kn / d, 0, ks / (2 * d)}, 0);
}

// Corners against centres: one pattern of gears for each axis of rotation.
TEST(Crystals, BodyCentredCubic) {
    const double s = std::sqrt(3.0) / (3 * d);
    expect_cubic(make_lattice(body_centred_cubic(), 4, 4, 4, radius), {s * (kn + 2 * ks), s * (kn - ks), s * (kn + ks / 2)}, 3);
}

TEST(Crystals, FaceCentredCubicInABoxThatIsNoCube) {
    const double s = std::sqrt(2.0) / d;
    expect_cubic(make_lattice(face_centred_cubic(), 2, 3, 5, radius), {s * (kn + ks), s * (kn - ks) / 2, s * (kn + ks) / 2}, 0);
}

TEST(Crystals, OneCellMeetsItsOwnImages) {
    const double s = std::sqrt(2.0) / d;
    expect_cubic(make_lattice(face_centred_cubic(), 1, 1, 1, radius), {s * (kn + ks), s * (kn - ks) / 2, s * (kn + ks) / 2}, 0);
    expect_cubic(make_lattice(simple_cubic(), 1, 1, 1, radius), {kn / d, 0, ks / (2 * d)}, 0);
}

TEST(Crystals, IterativeSolver) {
    LinearOptions options;
    options.solver = LinearSolver::iterative;
    const Packing packing = make_lattice(face_centred_cubic(), 6, 6, 6, radius);
    const auto response = solve_linear(packing, find_contacts(packing, 0.01), options);
    EXPECT_NEAR(response.shear_modulus(0, 1), std::sqrt(2.0) / d * (kn + ks) / 2, 1e-6 * kn / d);
}

// The inside of a crystal with a free surface has the constants of the bulk when its surface follows the strain.
TEST(Crystals, FreeSurfaceHeld) {
    Packing packing = make_lattice(face_centred_cubic(), 5, 5, 5, radius);
    const double edge = packing.cell.lengths()[0];
    packing.cell = Cell::open(Eigen::Vector3d::Zero(), packing.cell.lengths());
    LinearOptions options;
    Index inside = 0;
    for (Index i = 0; i < packing.size(); ++i) {
        const Eigen::Vector3d x = packing.positions.col(i);
        const bool held = x.minCoeff() < 1.1 * d || x.maxCoeff() > edge - 2.1 * d;
        options.held.push_back(held);
        inside += held ? 0 : 1;
    }
    ASSERT_GT(inside, 20);
    options.volume = static_cast<double>(inside) * d * d * d / std::sqrt(2.0);
    const auto response = solve_linear(packing, find_contacts(packing, 0.01), options);
    EXPECT_NEAR(response.elastic_tensor(0, 0), std::sqrt(2.0) / d * (kn + ks), 1e-9 * kn / d);
    EXPECT_NEAR(response.elastic_tensor(0, 1), std::sqrt(2.0) / d * (kn - ks) / 2, 1e-9 * kn / d);
    EXPECT_NEAR(response.shear_modulus(1, 2), std::sqrt(2.0) / d * (kn + ks) / 2, 1e-9 * kn / d);
}

// A gap at one boundary cuts every chain along x; along y and z whole columns still act.
TEST(Crystals, LayersWithoutContactCarryNothingAcross) {
    Packing packing = make_lattice(simple_cubic(), 4, 4, 4, radius);
    packing.cell = Cell::periodic(packing.cell.lengths() + Eigen::Vector3d(0.5 * radius, 0, 0));  // a gap at the x boundary
    const auto response = solve_linear(packing, find_contacts(packing, 0.01));
    const double volume = packing.cell.volume();
    EXPECT_NEAR(response.elastic_tensor(0, 0), 0, 1e-9 * kn / d);
    EXPECT_NEAR(response.shear_modulus(0, 1), 0, 1e-9 * kn / d);
    // Along y the 16 columns still act: 4 springs in series each.
    EXPECT_NEAR(response.elastic_tensor(1, 1), 16 * (kn / 4) * (4 * d) * (4 * d) / volume, 1e-9 * kn / d);
}

}  // namespace
}  // namespace coagula::mechanics
