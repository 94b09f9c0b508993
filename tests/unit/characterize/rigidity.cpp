// SPDX-License-Identifier: GPL-3.0-or-later
// Floppy modes, self-stress and local redundancy: closed forms, and a dense singular value decomposition.
#include <coagula/characterize/rigidity.hpp>

#include "support/lattices.hpp"
#include "test_packings.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <gtest/gtest.h>

#include <omp.h>

namespace coagula::characterize {
namespace {

using test::face_centred;
using test::simple_cubic;

Packing open_packing(const Eigen::Matrix3Xd& positions) {
    Packing packing;
    packing.cell = Cell::open({-10, -10, -10}, {20, 20, 20});
    packing.positions = positions;
    packing.radii = Eigen::VectorXd::Constant(positions.cols(), 1);
    return packing;
}

Rigidity rigidity_of(const Packing& packing, Bonds bonds = Bonds::normal_and_shear) {
    return measure_rigidity(packing, find_contacts(packing, 0.01), {.bonds = bonds});
}

/// Compiles in a third of the time of Eigen::BDCSVD.
using Decomposition = Eigen::JacobiSVD<Eigen::MatrixXd, Eigen::FullPivHouseholderQRPreconditioner>;

struct Counts {
    Index rank, rigid, floppy, self;
    bool operator==(const Counts&) const = default;
};
std::ostream& operator<<(std::ostream& out, const Counts& c) {
    return out << "rank " << c.rank << ", rigid " << c.rigid << ", floppy " << c.floppy << ", self-stress " << c.self;
}
Counts counts(const Packing& packing, Bonds bonds) {
    const Rigidity r = rigidity_of(packing, bonds);
    EXPECT_EQ(r.self_stresses - (r.floppy_modes + r.rigid_motions), r.constraints - r.unknowns);
    EXPECT_LT(r.trace_defect, 1e-9);
    EXPECT_NEAR(r.particle_freedom.sum(), static_cast<double>(r.floppy_modes + r.rigid_motions), 1e-8);
    return {r.rank, r.rigid_motions, r.floppy_modes, r.self_stresses};
}

Eigen::Matrix3Xd chain(int count) {
    Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, count);
    points.row(0).setLinSpaced(count, 0, 2.0 * (count - 1));
    return points;
}
Eigen::Matrix3Xd tetrahedron() {
    return (Eigen::Matrix3Xd(3, 4) << 1, 1, -1, -1, 1, -1, 1, -1, 1, -1, -1, 1).finished() / std::sqrt(2.0);
}
Eigen::Matrix3Xd octahedron() {
    return (Eigen::Matrix3Xd(3, 6) << 1, -1, 0, 0, 0, 0, 0, 0, 1, -1, 0, 0, 0, 0, 0, 0, 1, -1).finished() * std::sqrt(2.0);
}

TEST(Rigidity, OfSmallAssemblies) {
    const auto central = Bonds::central;
    const auto shear = Bonds::normal_and_shear;
    // A chain of n: every joint leaves three rotations. Points on a line have five motions of the whole.
    EXPECT_EQ(counts(open_packing(chain(2)), shear), (Counts{3, 6, 3, 0}));
    EXPECT_EQ(counts(open_packing(chain(5)), shear), (Counts{12, 6, 12, 0}));
    EXPECT_EQ(counts(open_packing(chain(2)), central), (Counts{1, 5, 0, 0}));
    EXPECT_EQ(counts(open_packing(chain(5)), central), (Counts{4, 5, 6, 0}));
    // A triangle: each particle spins about the line through its two contact points.
    const Eigen::Matrix3Xd triangle = tetrahedron().leftCols(3);
    EXPECT_EQ(counts(open_packing(triangle), shear), (Counts{9, 6, 3, 0}));
    EXPECT_EQ(counts(open_packing(triangle), central), (Counts{3, 6, 0, 0}));
    // A tetrahedron is isostatic either way: its contact points are an octahedron of twelve bars.
    EXPECT_EQ(counts(open_packing(tetrahedron()), shear), (Counts{18, 6, 0, 0}));
    EXPECT_EQ(counts(open_packing(tetrahedron()), central), (Counts{6, 6, 0, 0}));
    // An octahedron of points is isostatic; of bodies it has as many constraints as unknowns and still six rigid motions.
    EXPECT_EQ(counts(open_packing(octahedron()), central), (Counts{12, 6, 0, 0}));
    EXPECT_EQ(counts(open_packing(octahedron()), shear), (Counts{30, 6, 0, 6}));
}

TEST(Rigidity, OfALoneParticleAndOfNoContacts) {
    const Rigidity lone = rigidity_of(open_packing(Eigen::Matrix3Xd::Zero(3, 1)));
    EXPECT_EQ(lone.floppy_modes, 0);
    EXPECT_EQ(lone.rigid_motions, 6);
    EXPECT_EQ(lone.rank, 0);
    EXPECT_TRUE(lone.rigid.clusters.empty());
    const Packing gas = test::lattice({{0, 0, 0}}, 4, {2, 2, 2}, 1);
    const Rigidity apart = rigidity_of(gas);
    EXPECT_EQ(apart.floppy_modes, 45);
    EXPECT_EQ(apart.rattlers, 8);
    EXPECT_EQ(apart.rattler_modes, 48);
    EXPECT_EQ(apart.self_stresses, 0);
}

TEST(Rigidity, OfCrystals) {
    // Central forces on a simple cubic lattice of L^3 points: each of its 3 L^2 lines slides, and carries one self-stress.
    for (const int length : {2, 3, 4}) {
        const Index lines = Index{3} * length * length;
        EXPECT_EQ(counts(simple_cubic({length, length, length}, 1), Bonds::central),
                  (Counts{lines * (length - 1), 3, lines - 3, lines}));
    }
    // Face-centred cubic: no soft phonon, central or not.
    const Index n = 108;
    EXPECT_EQ(counts(face_centred({3, 3, 3}, 1), Bonds::central), (Counts{3 * n - 3, 3, 0, 3 * n + 3}));
    EXPECT_EQ(counts(face_centred({3, 3, 3}, 1), Bonds::normal_and_shear), (Counts{6 * n - 3, 3, 0, 12 * n + 3}));
    // Neighbours in a simple cubic lattice are cog wheels: with an even number along the axes they turn against each other.
    EXPECT_EQ(counts(simple_cubic({4, 4, 4}, 1), Bonds::normal_and_shear).floppy % 3, 0);
    EXPECT_GE(counts(simple_cubic({4, 4, 4}, 1), Bonds::normal_and_shear).floppy, 3);
}

TEST(Rigidity, IsSharedEquallyInACrystal) {
    const Rigidity r = rigidity_of(face_centred({3, 3, 3}, 1));
    const double each = static_cast<double>(r.self_stresses) / static_cast<double>(r.contact_redundancy.size());
    EXPECT_LT((r.contact_redundancy.array() - each).abs().maxCoeff(), 1e-10);
    EXPECT_NEAR(r.particle_redundancy.sum(), static_cast<double>(r.self_stresses), 1e-8);
    ASSERT_EQ(r.rigid.clusters.size(), 1);
    EXPECT_EQ(r.rigid.clusters[0].particles, 108);
    EXPECT_EQ(r.rigid.clusters[0].windings.size(), 3);
    EXPECT_NEAR(r.rigid.self_stress[0], static_cast<double>(r.self_stresses), 1e-8);
}

/// A loose random packing with overlaps, so that contact numbers spread from 0 to 8 or so, of two sizes.
Packing random_packing(Index particles, std::uint64_t seed, bool periodic) {
    Packing packing;
    const double edge = std::cbrt(7.0 * static_cast<double>(particles));
    packing.cell = periodic ? Cell::periodic(Eigen::Vector3d::Constant(edge))
                            : Cell::open(Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(edge));
    packing.positions.resize(3, particles);
    packing.radii.resize(particles);
    for (Index k = 0; k < particles; ++k) {
        packing.positions.col(k) = edge * random_uniform(seed, RandomPurpose::test, 0, static_cast<std::uint64_t>(k));
        packing.radii[k] = k % 3 == 0 ? 1.2 : 1.0;
    }
    return packing;
}

/// Relative velocity at the contact points from those of the bodies, one contact and one unknown at a time.
Eigen::MatrixXd dense_matrix(const Packing& packing, const ContactNetwork& contacts, Bonds bonds) {
    const Index freedoms = bonds == Bonds::central ? 3 : 6;
    const Index rows = bonds == Bonds::central ? 1 : 3;
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(rows * contacts.size(), freedoms * packing.size());
    for (Index c = 0; c < contacts.size(); ++c) {
        const Eigen::Vector3d branch = contacts.branch.col(c);
        const double share =
            packing.radii[contacts.ends(0, c)] / (packing.radii[contacts.ends(0, c)] + packing.radii[contacts.ends(1, c)]);
        const std::array<Eigen::Vector3d, 2> to_contact{share * branch, -(1 - share) * branch};
        for (std::size_t end = 0; end < 2; ++end) {
            for (Index k = 0; k < freedoms; ++k) {
                const Eigen::Vector3d unit = Eigen::Vector3d::Unit(k % 3);
                const Eigen::Vector3d velocity = k < 3 ? unit : unit.cross(to_contact.at(end));
                const Eigen::Vector3d moved = (end == 0 ? -1 : 1) * velocity;
                auto entry = a.block(rows * c, freedoms * contacts.ends(static_cast<Index>(end), c) + k, rows, 1);
                if (rows == 1) {
                    entry(0, 0) += moved.dot(branch.normalized());
                } else {
                    entry += moved;
                }
            }
        }
    }
    return a;
}

void expect_agreement_with_svd(const Packing& packing, Bonds bonds) {
    const ContactNetwork contacts = find_contacts(packing, 0.01);
    const Rigidity r = measure_rigidity(packing, contacts, {.bonds = bonds});
    const Decomposition svd(dense_matrix(packing, contacts, bonds), Eigen::ComputeFullU);
    const Index rank = (svd.singularValues().array() > 1e-9).count();
    EXPECT_EQ(r.rank, rank);
    EXPECT_LT(r.largest_zero, 1e-13);
    EXPECT_GT(r.smallest_nonzero, 1e-7);
    EXPECT_LT(r.trace_defect, 1e-6);
    const Eigen::MatrixXd self_stress = svd.matrixU().rightCols(r.constraints - rank);
    const Eigen::VectorXd row_redundancy = self_stress.rowwise().squaredNorm();
    const Index rows = r.constraints / contacts.size();
    for (Index c = 0; c < contacts.size(); ++c) {
        EXPECT_NEAR(r.contact_redundancy[c], row_redundancy.segment(rows * c, rows).sum(), 1e-7);
        const Eigen::Vector3d n = contacts.branch.col(c).normalized();
        const double normal = rows == 1 ? row_redundancy[c] : (n.transpose() * self_stress.middleRows(3 * c, 3)).squaredNorm();
        EXPECT_NEAR(r.normal_redundancy[c], normal, 1e-7);
    }
}

TEST(Rigidity, AgreesWithADenseSingularValueDecomposition) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        for (const Bonds bonds : {Bonds::normal_and_shear, Bonds::central}) {
            expect_agreement_with_svd(random_packing(40, seed, true), bonds);
        }
    }
    expect_agreement_with_svd(random_packing(40, 4, false), Bonds::normal_and_shear);
}

TEST(Rigidity, ClustersMoveAsOneInEveryFloppyMode) {
    const Packing packing = random_packing(50, 5, false);
    const ContactNetwork contacts = find_contacts(packing, 0.01);
    const Rigidity r = measure_rigidity(packing, contacts);
    ASSERT_GT(r.rigid.clusters.size(), 0);
    EXPECT_LT(r.rigid.largest_rigid, 1e-9);
    EXPECT_GT(r.rigid.smallest_loose, 1e-5);
    const Decomposition svd(dense_matrix(packing, contacts, Bonds::normal_and_shear), Eigen::ComputeFullV);
    const Eigen::MatrixXd null = svd.matrixV().rightCols(r.unknowns - r.rank);
    for (Index i = 0; i < packing.size(); ++i) {
        for (Index j = 0; j < i; ++j) {
            const Eigen::Vector3d branch = packing.positions.col(j) - packing.positions.col(i);
            double motion = 0;
            for (Index k = 0; k < null.cols(); ++k) {
                const Eigen::Vector3d turn = null.block<3, 1>(6 * i + 3, k);
                motion = std::max({motion, (null.block<3, 1>(6 * j + 3, k) - turn).norm(),
                                   (null.block<3, 1>(6 * j, k) - null.block<3, 1>(6 * i, k) - turn.cross(branch)).norm()});
            }
            const bool together = r.rigid.of_particle[i] >= 0 && r.rigid.of_particle[i] == r.rigid.of_particle[j];
            EXPECT_EQ(together, motion < 1e-9) << i << " and " << j << ": " << motion;
        }
    }
}

TEST(Rigidity, OfTwoTetrahedraThatShareAContact) {
    // Two rigid clusters of four on a ball joint: three floppy modes.
    Eigen::Matrix3Xd points(3, 8);
    points.leftCols(4) = tetrahedron();
    const Eigen::Vector3d out = tetrahedron().col(0).normalized();
    const Eigen::Vector3d joint = tetrahedron().col(0) + out;
    points.rightCols(4) = (2 * joint).replicate(1, 4) - tetrahedron();
    const Rigidity r = rigidity_of(open_packing(points));
    EXPECT_EQ(r.floppy_modes, 3);
    EXPECT_EQ(r.self_stresses, 0);
    ASSERT_EQ(r.rigid.clusters.size(), 2);
    EXPECT_EQ(r.rigid.of_particle, (Eigen::VectorXi(8) << 0, 0, 0, 0, 1, 1, 1, 1).finished());
}

TEST(Rigidity, RattlersHaveTheModesOfTheirOwn) {
    // A tetrahedron with a chain of two hanging on it, and a particle alone.
    Eigen::Matrix3Xd points(3, 7);
    points.leftCols(4) = tetrahedron();
    const Eigen::Vector3d out = tetrahedron().col(0).normalized();
    points.col(4) = tetrahedron().col(0) + 2 * out;
    points.col(5) = tetrahedron().col(0) + 4 * out;
    points.col(6) << -7, -7, -7;
    const Rigidity r = rigidity_of(open_packing(points));
    EXPECT_EQ(r.rattlers, 3);
    EXPECT_EQ(r.rattler_modes, 3 + 3 + 6);
    EXPECT_EQ(r.floppy_modes, 12);
}

TEST(Rigidity, DoesNotDependOnThreads) {
    const Packing packing = random_packing(300, 6, true);
    const int before = omp_get_max_threads();
    omp_set_num_threads(1);
    const Rigidity one = rigidity_of(packing);
    omp_set_num_threads(3);
    const Rigidity three = rigidity_of(packing);
    omp_set_num_threads(before);
    EXPECT_EQ(one.contact_redundancy, three.contact_redundancy);
    EXPECT_EQ(one.smallest_nonzero, three.smallest_nonzero);
    EXPECT_EQ(one.rigid.of_particle, three.rigid.of_particle);
}

TEST(Rigidity, DoesNotDependOnTheRandomMotions) {
    const Packing packing = random_packing(200, 7, true);
    const ContactNetwork contacts = find_contacts(packing, 0.01);
    const Rigidity one = measure_rigidity(packing, contacts, {.seed = 1});
    const Rigidity other = measure_rigidity(packing, contacts, {.random_motions = 3, .seed = 2});
    EXPECT_EQ(one.rank, other.rank);
    EXPECT_LT((one.contact_redundancy - other.contact_redundancy).cwiseAbs().maxCoeff(), 1e-7);
    EXPECT_EQ(one.rigid.of_particle, other.rigid.of_particle);
}

TEST(Rigidity, RefusesWhatItCannotDo) {
    const Packing packing = simple_cubic({3, 3, 3}, 1);
    const ContactNetwork contacts = find_contacts(packing, 0.01);
    EXPECT_THROW(measure_rigidity(packing, contacts, {.memory_limit = 1000}), TooLarge);
    EXPECT_THROW(measure_rigidity(packing, contacts, {.random_motions = 0}), std::invalid_argument);
    EXPECT_THROW(measure_rigidity(packing, contacts, {.tolerance = 0}), std::invalid_argument);
    EXPECT_THROW(measure_rigidity(simple_cubic({2, 2, 2}, 1), contacts), std::invalid_argument);
}

}  // namespace
}  // namespace coagula::characterize
