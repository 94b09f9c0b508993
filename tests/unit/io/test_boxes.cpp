// SPDX-License-Identifier: GPL-3.0-or-later
// Tilted and partly periodic boxes through every format.
#include <coagula/io/gsd_file.hpp>
#include <coagula/io/h5md_file.hpp>
#include <coagula/io/structure_file.hpp>
#include <coagula/io/text_formats.hpp>

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include "example_packing.hpp"
#include "temporary_folder.hpp"

namespace coagula::io {
namespace {

using Boxes = TemporaryFolder;

/// The example in a restricted triclinic box.
Packing tilted_packing(const std::array<bool, 3>& periodic) {
    Packing packing = example_packing(100, true);
    Eigen::Matrix3d edges = packing.cell.edges();
    edges(0, 1) = 1.1e-6;
    edges(0, 2) = -0.7e-6;
    edges(1, 2) = 0.4e-6;
    const Cell straight = packing.cell;
    packing.cell = Cell::of_edges(Eigen::Vector3d::Zero(), edges, periodic);
    for (auto position : packing.positions.colwise()) {
        position = packing.cell.wrap(packing.cell.place(straight.fraction(position)));
    }
    return packing;
}

ImportOptions in_metres(double radius = unset) {
    ImportOptions options;
    options.length_unit = 1.0;
    if (!std::isnan(radius)) {
        options.radius = radius;
    }
    return options;
}

void expect_same(const Packing& found, const Packing& packing, double tolerance, const std::string& name) {
    EXPECT_LT((found.cell.edges() - packing.cell.edges()).norm(), tolerance * packing.cell.edges().norm()) << name;
    EXPECT_EQ(found.cell.periodicity(), packing.cell.periodicity()) << name;
    ASSERT_EQ(found.size(), packing.size()) << name;
    for (Index i = 0; i < packing.size(); ++i) {
        const Eigen::Vector3d difference = packing.cell.minimum_image(found.positions.col(i) - packing.positions.col(i));
        EXPECT_LT(difference.norm(), tolerance * packing.cell.edges().norm()) << name;
    }
}

TEST_F(Boxes, ComeBackFromEveryFormat) {
    for (const std::array<bool, 3>& periodic : {std::array{true, true, true}, {true, false, true}, {false, false, true}}) {
        const Packing packing = tilted_packing(periodic);
        for (const char* name : {"a.xyz", "a.lmp", "a.dump"}) {
            const TextFormat format = format_from_name(name);
            write_text(file(name), format, {packing, std::nullopt}, true);
            expect_same(read_text(file(name), format, in_metres()), packing, 1e-14, name);
        }
        const Structure structure{packing, std::nullopt, {}, 0.0};
        write_gsd(file("a.gsd"), structure, true);
        expect_same(read_gsd(file("a.gsd"), {}).packing, packing, 1e-6, "GSD");
        write_structure(file("a.h5"), structure, {}, {}, {}, true);
        expect_same(read_structure(file("a.h5")).packing, packing, 1e-14, "HDF5");
        expect_same(read_h5md(file("a.h5"), {}).packing, packing, 1e-14, "H5MD");
    }
}

TEST_F(Boxes, OfAnyOrientationStandInExtendedXyzOnly) {
    Packing packing = tilted_packing({true, true, true});
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    packing.positions = turn * packing.positions;
    packing.cell = Cell::of_edges(Eigen::Vector3d::Zero(), turn * packing.cell.edges(), packing.cell.periodicity());
    write_text(file("a.xyz"), TextFormat::extended_xyz, {packing, std::nullopt}, true);
    expect_same(read_text(file("a.xyz"), TextFormat::extended_xyz, {}), packing, 1e-14, "extended XYZ");
    for (const char* name : {"a.lmp", "a.dump"}) {
        EXPECT_THROW(write_text(file(name), format_from_name(name), {packing, std::nullopt}, true), InputError);
    }
    EXPECT_THROW(write_gsd(file("a.gsd"), {packing, std::nullopt, {}, 0.0}, true), InputError);
    EXPECT_EQ(entries().size(), 1U);
}

TEST_F(Boxes, GeneralTriclinicOfLammpsIsReadAsItStands) {
    const Eigen::Matrix3d edges = (Eigen::Matrix3d() << 4, 1, 0, 0, 5, 1, 1, 0, 6).finished();
    const std::string data =
        write("a.data",
              "t, units = si\n\n1 atoms\n1 atom types\n4 0 1 avec\n1 5 0 bvec\n0 1 6 cvec\n-1 2 3 abc origin\n\n"
              "Atoms # atomic\n\n1 1 0 3 4\n");
    const std::string dump = write("a.dump",
                                   "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS abc origin pp pp ff\n4 0 1 -1\n"
                                   "1 5 0 2\n0 1 6 3\nITEM: ATOMS id x y z\n1 0 3 4\n");
    for (const auto& [path, format] : {std::pair(data, TextFormat::lammps_data), std::pair(dump, TextFormat::lammps_dump)}) {
        const Packing found = read_text(path, format, in_metres(0.1));
        EXPECT_EQ(found.cell.edges(), edges);
        EXPECT_EQ(found.positions.col(0), Eigen::Vector3d(1, 1, 1));
        EXPECT_EQ(found.cell.is_periodic(), format == TextFormat::lammps_data);
        EXPECT_TRUE(found.cell.is_periodic(0) && found.cell.is_periodic(1));
    }
}

TEST_F(Boxes, CalledPeriodicHaveACornerAtTheOrigin) {
    const std::string path =
        write("a.xyz", "1\nlength_unit=m pbc=\"F F F\" Origin=\"5 6 7\" Lattice=\"4 0 0 0 4 0 0 0 4\"\nX 6 8 10\n");
    for (const std::array<bool, 3>& periodic : {std::array{true, true, true}, {true, false, false}}) {
        ImportOptions options = in_metres(0.1);
        options.periodic = periodic;
        const Packing found = read_text(path, TextFormat::extended_xyz, options);
        EXPECT_EQ(found.cell.origin(), Eigen::Vector3d::Zero());
        EXPECT_EQ(found.cell.periodicity(), periodic);
        EXPECT_EQ(found.positions.col(0), Eigen::Vector3d(1, 2, 3));
        write_structure(file("a.h5"), {found, std::nullopt, {}, 0.0}, {}, {}, {}, true);
        EXPECT_LT((read_structure(file("a.h5")).packing.positions - found.positions).norm(), 1e-14);
    }
    EXPECT_EQ(read_text(path, TextFormat::extended_xyz, in_metres(0.1)).cell.origin(), Eigen::Vector3d(5, 6, 7));
}

TEST_F(Boxes, ParticlesOutsideATiltedOneAreNamed) {
    const std::string path = write("a.xyz", "2\nlength_unit=m Lattice=\"4 0 0 2 4 0 0 0 4\"\nX 1 1 1\nX 0.5 3 1\n");
    try {
        read_text(path, TextFormat::extended_xyz, in_metres(0.1));
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()),
                  path +
                      ", line 4: the centre lies at -0.25 of edge a, outside the periodic box from 0 to 1; give "
                      "--wrap to bring such particles back in");
    }
    ImportOptions wrapping = in_metres(0.1);
    wrapping.wrap = true;
    EXPECT_EQ(read_text(path, TextFormat::extended_xyz, wrapping).positions.col(1), Eigen::Vector3d(4.5, 3, 1));
}

}  // namespace
}  // namespace coagula::io
