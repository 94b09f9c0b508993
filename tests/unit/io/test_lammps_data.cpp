// SPDX-License-Identifier: GPL-3.0-or-later
// Which columns of the section Atoms are what (LAMMPS manual, read_data). The lines of hybrid styles are those that LAMMPS itself
// writes.
#include <coagula/io/text_formats.hpp>

#include <gtest/gtest.h>

#include "example_packing.hpp"
#include "temporary_folder.hpp"

namespace coagula::io {
namespace {

class LammpsData : public TemporaryFolder {
protected:
    /// A file of these lines in the section Atoms, whose comment names the style unless `hint` is empty.
    std::string data_of(const std::string& hint, const std::vector<std::string>& atoms) const {
        std::string text = "title\n\n" + std::to_string(atoms.size()) + " atoms\n9 atom types\n\n" +
                           "0 10 xlo xhi\n0 10 ylo yhi\n0 10 zlo zhi\n\nAtoms" + (hint.empty() ? "" : " # " + hint) + "\n\n";
        for (const std::string& atom : atoms) {
            text += atom + '\n';
        }
        return write("a.data", text);
    }
    static ImportOptions in_micrometres(const std::string& style = "") {
        ImportOptions options;
        options.length_unit = 1e-6;
        options.atom_style = style;
        return options;
    }
    Packing read_atoms(const std::string& hint, const std::vector<std::string>& atoms, const ImportOptions& options) const {
        return read_text(data_of(hint, atoms), TextFormat::lammps_data, options);
    }
    std::string refusal(const std::string& hint, const std::vector<std::string>& atoms, const ImportOptions& options) const {
        const std::string path = data_of(hint, atoms);
        const std::string text = sentence<InputError>([&] { read_text(path, TextFormat::lammps_data, options); });
        EXPECT_TRUE(text.starts_with(path)) << text;
        return text.substr(path.size());
    }
};

struct Atom {
    std::string style;
    std::string line;
    double diameter;  ///< [um]; 0: the style has none
};

const std::vector<Atom> atoms_of_all_styles{
    {"amoeba", "1 7 2 -0.5 1.5 2.5 3.5", 0},
    {"angle", "1 7 2 1.5 2.5 3.5", 0},
    {"atomic", "1 2 1.5 2.5 3.5", 0},
    {"atomic/kk", "1 2 1.5 2.5 3.5", 0},
    {"bond", "1 7 2 1.5 2.5 3.5", 0},
    {"bpm/sphere", "1 7 2 0.75 0.4 1.5 2.5 3.5", 0.75},
    {"charge", "1 2 -0.5 1.5 2.5 3.5", 0},
    {"dipole", "1 2 -0.5 1.5 2.5 3.5 0.1 0.2 0.3", 0},
    {"dpd", "1 2 0.9 1.5 2.5 3.5", 0},
    {"edpd", "1 2 0.9 0.8 1.5 2.5 3.5", 0},
    {"full", "1 7 2 -0.5 1.5 2.5 3.5", 0},
    {"granular", "1 2 0.75 0.4 1.5 2.5 3.5", 0.75},
    {"mdpd", "1 2 0.9 1.5 2.5 3.5", 0},
    {"molecular", "1 0 2 1.5 2.5 3.5", 0},
    {"peri", "1 2 0.9 0.8 1.5 2.5 3.5", 0},
    {"rheo", "1 2 0 0.8 1.5 2.5 3.5", 0},
    {"rheo/thermal", "1 2 0 0.8 0.7 1.5 2.5 3.5", 0},
    {"sph", "1 2 0.9 0.8 0.7 1.5 2.5 3.5", 0},
    {"sphere", "1 2 0.75 0.4 1.5 2.5 3.5", 0.75},
    {"sphere", "1 C 0.75 0.4 1.5 2.5 3.5", 0.75},
    {"spin", "1 2 1.5 2.5 3.5 0 0 1 0.5", 0},
    {"template", "1 2 7 1 1 1.5 2.5 3.5", 0},
    {"hybrid sphere bond", "1 2 1.5 2.5 3.5 0.75 0.4 7", 0.75},
    {"hybrid bond sphere", "1 2 1.5 2.5 3.5 7 0.75 0.4", 0.75},
    {"hybrid full sphere", "1 2 1.5 2.5 3.5 5 0.25 0.75 0.33", 0.75},
    {"hybrid sphere full", "1 2 1.5 2.5 3.5 0.75 0.33 5 0.25", 0.75},
    {"hybrid charge dipole", "1 2 1.5 2.5 3.5 0.25 0.125 0.25 0.5", 0},
    {"hybrid bond sphere charge", "1 2 1.5 2.5 3.5 5 0.75 0.33 0.25", 0.75},
    {"hybrid sphere dipole", "1 2 1.5 2.5 3.5 0.75 0.33 0.25 0.125 0.25 0.5", 0.75},
};

TEST_F(LammpsData, EveryStyleByItsName) {
    for (const Atom& atom : atoms_of_all_styles) {
        SCOPED_TRACE(atom.style);
        ImportOptions options = in_micrometres();
        options.radius = atom.diameter > 0 ? std::nullopt : std::optional(0.5e-6);
        for (const std::string flags : {"", " 0 -1 2"}) {
            const Packing found = read_atoms(atom.style, {atom.line + flags}, options);
            EXPECT_TRUE(found.positions.isApprox(Eigen::Vector3d(1.5e-6, 2.5e-6, 3.5e-6), 1e-14)) << found.positions;
            EXPECT_NEAR(found.radii[0], atom.diameter > 0 ? atom.diameter * 0.5e-6 : 0.5e-6, 1e-20);
        }
        options.atom_style = atom.style;
        EXPECT_TRUE(read_atoms("", {atom.line}, options).positions.isApprox(Eigen::Vector3d(1.5e-6, 2.5e-6, 3.5e-6), 1e-14));
        if (atom.diameter == 0) {
            EXPECT_TRUE(refusal(atom.style, {atom.line}, in_micrometres()).starts_with(" names no radii"));
        }
    }
    ImportOptions options = in_micrometres();
    options.radius = 0.5e-6;
    EXPECT_EQ(read_atoms("tdpd", {"1 2 1.5 2.5 3.5 0.1 0.2"}, options).positions, Eigen::Vector3d(1.5, 2.5, 3.5) / 1e6);
}

TEST_F(LammpsData, StylesOfOtherParticlesAreRefusedByName) {
    for (const auto& [style, shape] : {std::pair{"ellipsoid", "ellipsoids"},
                                       {"line", "lines"},
                                       {"tri", "triangles"},
                                       {"body", "bodies"},
                                       {"electron", "electrons"},
                                       {"smd", "parts of deforming bodies"},
                                       {"mesont", "segments of nanotubes"},
                                       {"hybrid sphere ellipsoid", "ellipsoids"}}) {
        EXPECT_EQ(refusal(style, {"1 1 1 1 1 2 3"}, in_micrometres()),
                  ", line 10: atoms of the style '" + std::string(style) + "' are " + shape + ", but coagula reads spheres");
    }
    EXPECT_EQ(refusal("spheres", {"1 1 1 1 1 2 3"}, in_micrometres()),
              ", line 10: the atom style 'spheres' is none that coagula knows; if it is not that of the file, give --atom-style");
    EXPECT_EQ(refusal("hybrid", {"1 1 1 2 3 1 1 1"}, in_micrometres()),
              ", line 10: the style hybrid needs the names of its sub-styles: give them as in --atom-style 'hybrid sphere bond'");
    EXPECT_NE(refusal("hybrid sphere tdpd", {"1 1 1 2 3 1 1 1"}, in_micrometres()).find("none that coagula knows"),
              std::string::npos);
}

TEST_F(LammpsData, WithoutANameTheColumnsDecideWhereOneStyleHolds) {
    const ImportOptions options = in_micrometres();
    // A density below zero or a type with a fraction rules out one of sphere and full.
    EXPECT_TRUE(refusal("", {"1 1 2 -0.8 1 2 3", "2 1 1 0.8 4 5 6"}, options).starts_with(" names no radii"));
    EXPECT_TRUE(
        read_atoms("", {"1 1 0.75 0.4 1 2 3", "2 1 0.5 0.4 4 5 6"}, options).radii.isApprox(Eigen::Vector2d(0.375e-6, 0.25e-6)));
    EXPECT_EQ(read_atoms("", {"1 7 1 0.75 0.4 1.5 2 3"}, options).radii[0], 0.375e-6) << "bpm/sphere";
    // Styles that give the same spheres need no decision.
    ImportOptions with_radius = options;
    with_radius.radius = 1e-6;
    for (const std::string line :
         {"1 1 4.5 5 6", "1 1 4.5 5 6 0 0 1", "1 1 1 4.5 5 6", "1 2 -0.5 4.5 5 6 0 0 -1", "1 2 -0.5 4.5 5 6 0 0 0"}) {
        EXPECT_TRUE(read_atoms("", {line}, with_radius).positions.isApprox(Eigen::Vector3d(4.5e-6, 5e-6, 6e-6), 1e-14)) << line;
    }
}

TEST_F(LammpsData, WithoutANameDoubtIsRefused) {
    const ImportOptions options = in_micrometres();
    EXPECT_EQ(refusal("", {"1 1 2 0.8 1 2 3"}, options),
              ", line 10: the section Atoms names no atom style, and its columns can be those of full, sphere: give --atom-style");
    EXPECT_EQ(refusal("", {"1 1 1 0.8 1 2 3"}, options),
              ", line 10: the section Atoms names no atom style, and its columns can be those of body, ellipsoid, full, sphere: "
              "give --atom-style");
    EXPECT_EQ(read_atoms("", {"1 1 1 0.8 1 2 3"}, in_micrometres("sphere")).radii[0], 0.5e-6);
    for (const std::string line : {"1 1.5 4 5 6", "1 1 4.5 5 6 0.5 0 0", "1 1 x 4 5", "1 1 2", "1 0 -2 -3 4 5 6"}) {
        EXPECT_NE(refusal("", {line}, options)
                      .find("line 12: the section Atoms names no atom style, and its columns are those of none of"),
                  std::string::npos)
            << line;
    }
}

TEST_F(LammpsData, ANamedStyleMustHold) {
    const ImportOptions options = in_micrometres();
    EXPECT_EQ(refusal("sphere", {"1 1 1 -0.8 1 2 3"}, options), ", line 12: '-0.8' cannot be density of an atom of style sphere");
    EXPECT_EQ(refusal("full", {"1 1 0.5 2.5 1 2 3"}, options), ", line 12: '0.5' cannot be type of an atom of style full");
    EXPECT_EQ(refusal("atomic", {"1 1 1 2 3 0 0.5 0"}, options),
              ", line 12: '0.5' cannot be an image flag of an atom of style atomic");
    EXPECT_EQ(refusal("full", {"1 1 1 2 3"}, options),
              ", line 12: there are 5 columns, but atom style full has 7 (and three image flags)");
    EXPECT_EQ(refusal("full", {"1 1 1 0.8 1 2 3"}, in_micrometres("sphere")),
              ", line 10: the section Atoms has the style 'full', but --atom-style says 'sphere'");
    EXPECT_EQ(refusal("hybrid", {"1 1 1 2 3 1 1 1"}, in_micrometres("sphere")),
              ", line 10: the section Atoms has the style 'hybrid', but --atom-style says 'sphere'");
    EXPECT_EQ(read_atoms("id type diameter density", {"1 1 1 0.8 1 2 3"}, in_micrometres("sphere")).size(), 1);
}

TEST_F(LammpsData, OtherFormatsHaveNoAtomStyle) {
    const std::string path = write("a.csv", "x [um],y [um],z [um]\n1,2,3\n");
    EXPECT_EQ(sentence<InputError>([&] { read_text(path, TextFormat::csv, in_micrometres("full")); }),
              path + " is no LAMMPS data: --atom-style is for these");
}

TEST_F(LammpsData, WhatOtherProgramsWrote) {
    const std::filesystem::path data = std::filesystem::path(COAGULA_DATASETS) / "foreign_structures";
    const auto reading = [&](const char* name, const ImportOptions& options) {
        return read_text((data / name).string(), TextFormat::lammps_data, options);
    };
    ImportOptions metres = in_micrometres("hybrid sphere bond");
    metres.length_unit = 1;
    const Packing found = reading("rtb2.data", metres);
    EXPECT_EQ(found.size(), 108);
    EXPECT_TRUE(found.cell.lengths().isApprox(Eigen::Vector3d::Constant(3e-6)));
    EXPECT_TRUE(found.radii.isApprox(Eigen::VectorXd::Constant(108, 3.5355339e-7), 1e-8));
    metres.atom_style.clear();
    EXPECT_NE(sentence<InputError>([&] { reading("rtb2.data", metres); }).find("--atom-style 'hybrid sphere bond'"),
              std::string::npos);
    EXPECT_NE(sentence<InputError>([&] { reading("full_no_hint.data", in_micrometres()); }).find("names no radii"),
              std::string::npos);
}

}  // namespace
}  // namespace coagula::io
