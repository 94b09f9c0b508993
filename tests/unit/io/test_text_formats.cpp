// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/structure_file.hpp>
#include <coagula/io/text_formats.hpp>

#include <gtest/gtest.h>

#include <clocale>

#include "example_packing.hpp"
#include "temporary_folder.hpp"

namespace coagula::io {
namespace {

using TextFormats = TemporaryFolder;

const Eigen::Matrix3d box = Eigen::Matrix3d::Identity() * 1e-5;

ImportOptions in_box() {
    ImportOptions options;
    options.box = box;
    options.radius = 1e-7;
    return options;
}

TEST_F(TextFormats, FormatFromName) {
    EXPECT_EQ(format_from_name("dir.x/a.csv"), TextFormat::csv);
    EXPECT_EQ(format_from_name("a.CSV"), TextFormat::csv);
    EXPECT_EQ(format_from_name("a.xyz"), TextFormat::extended_xyz);
    EXPECT_EQ(format_from_name("a.extxyz"), TextFormat::extended_xyz);
    EXPECT_EQ(format_from_name("a.data"), TextFormat::lammps_data);
    EXPECT_EQ(format_from_name("a.lmp"), TextFormat::lammps_data);
    EXPECT_EQ(format_from_name("a.lammps"), TextFormat::lammps_data);
    EXPECT_THROW(format_from_name("a.h5"), InputError);
    EXPECT_THROW(format_from_name("csv"), InputError);
}

TEST_F(TextFormats, RoundTripIsExact) {
    for (const bool periodic : {true, false}) {
        for (const char* name : {"a.csv", "a.xyz", "a.lmp"}) {
            const Packing packing = example_packing(200, periodic);
            const TextFormat format = format_from_name(name);
            write_text(file(name), format, {packing, find_contacts(packing, 0.1)}, true);
            ImportOptions options;
            if (format == TextFormat::csv) {
                options.open = !periodic;
                options.box = periodic ? std::optional(packing.cell.edges()) : std::nullopt;
            }
            const Packing found = read_text(file(name), format, options);
            EXPECT_EQ(found.positions, packing.positions) << name;
            EXPECT_EQ(found.radii, packing.radii) << name;
            EXPECT_EQ(found.cell.is_periodic(), periodic);
            if (periodic || format == TextFormat::extended_xyz) {
                EXPECT_EQ(found.cell.lengths(), packing.cell.lengths()) << name;
                EXPECT_EQ(found.cell.origin(), packing.cell.origin()) << name;
            }
        }
    }
    EXPECT_EQ(entries().size(), 3U);
}

TEST_F(TextFormats, WritersKeepOldFiles) {
    write("a.csv", "old");
    EXPECT_THROW(write_text(file("a.csv"), TextFormat::csv, {example_packing(3, true), std::nullopt}, false), InputError);
    EXPECT_EQ(read(file("a.csv")), "old");
}

TEST_F(TextFormats, CsvUnitsQuotesAndLineEnds) {
    const std::string path = write("a.csv",
                                   "\xef\xbb\xbf# measured\r\n"
                                   "id,\"x [um]\", Y (nm) ,z [m],\"a, b\",radius [um]\r\n"
                                   "7,1.5,+2500,3e-6,\"p,q\",0.25\r\n"
                                   "8,\"2.5\",3500,4e-6,,0.125\r\n\r\n  \r\n");
    ImportOptions options;
    options.box = box;
    const Packing found = read_text(path, TextFormat::csv, options);
    EXPECT_EQ(found.positions, (Eigen::Matrix3Xd(3, 2) << 1.5e-6, 2.5e-6, 2.5e-6, 3.5e-6, 3e-6, 4e-6).finished());
    EXPECT_EQ(found.radii, Eigen::Vector2d(2.5e-7, 1.25e-7));
    options.radius = 3e-7;
    EXPECT_EQ(read_text(path, TextFormat::csv, options).radii, Eigen::Vector2d::Constant(3e-7));
}

TEST_F(TextFormats, CsvWithSemicolonsInALocaleWithCommas) {
    const char* locale = std::setlocale(LC_ALL, "de_DE.UTF-8");
    const std::string path = write("a.csv", "x [um];y [um];z [um]\n1.5;2.5;3.5\n");
    EXPECT_EQ(read_text(path, TextFormat::csv, in_box()).positions, Eigen::Vector3d(1.5e-6, 2.5e-6, 3.5e-6));
    if (locale != nullptr) {
        std::setlocale(LC_ALL, "C");
    }
}

TEST_F(TextFormats, ColumnsOfOtherPrograms) {
    const Eigen::Matrix3Xd expected = (Eigen::Matrix3Xd(3, 2) << 1.5, 4.5, 2.5, 5.5, 3.5, 6.5).finished() * 1e-6;
    ImportOptions options;
    options.box = box;
    options.length_unit = 1e-6;
    for (const std::string text :
         {"x y z radius\n1.5 2.5 3.5 0.5\n4.5 5.5 6.5 0.5\n", "x\ty\tz\tr\n1.5\t2.5\t3.5\t0.5\n4.5\t5.5\t6.5\t0.5\n",
          "  x   y \t z   r \n  1.5   2.5  3.5 \t 0.5\n  4.5   5.5 6.5 0.5\n", "# x y z r\n1.5 2.5 3.5 0.5\n4.5 5.5 6.5 0.5\n",
          "#x_y_z_r\n1.5\t2.5\t3.5\t0.5\n4.5\t5.5\t6.5\t0.5\n", "#format x_y_z_r\n# of today\n1.5 2.5 3.5 0.5\n4.5 5.5 6.5 0.5\n",
          "# x, y, z, r\n1.5,2.5,3.5,0.5\n4.5,5.5,6.5,0.5\n", "# x y z r\n1.5,2.5,3.5,0.5\n4.5,5.5,6.5,0.5\n",
          "###\n#\n# x (um) y (um) z (um) r (um)\n1.5 2.5 3.5 0.5\n4.5 5.5 6.5 0.5\n",
          "x [um] y [um] z [um] r [nm]\n1.5 2.5 3.5 500\n4.5 5.5 6.5 500\n", "x;y;z;r\n1,5;2,5;3,5;0,5\n4,5;5,5;6,5;0,5\n",
          "x [um];y [um];z [um];r [um]\n1,5;2,5;3,5;5E-1\n4,5;5,5;6,5;0,5\n",
          "x\ty\tz\tr\n1,5\t2,5\t3,5\t0,5\n4,5\t5,5\t6,5\t0,5\n", "x y z r\n1,5 2,5 3,5 0,5\n4,5 5,5 6,5 0,5\n",
          "# x;y;z;r\n1,5;2,5;3,5;0,5\n4,5;5,5;6,5;0,5\n", "x,y,z,r\n1.5D+00,0.25d1,3.5D0,5D-1\n4.5,5.5,6.5,0.5\n",
          "x;y;z;r\n1,5D+00;2,5;3,5;0,5\n4,5;5,5;6,5;0,5\n"}) {
        const Packing found = read_text(write("a.csv", text), TextFormat::csv, options);
        EXPECT_TRUE(found.positions.isApprox(expected, 1e-14)) << text;
        EXPECT_TRUE(found.radii.isApprox(Eigen::Vector2d::Constant(5e-7), 1e-14)) << text;
    }
}

TEST_F(TextFormats, DecimalCommasAndPointsAreNotMixed) {
    for (const std::string text :
         {"x;y;z\n1,5;2,5;3.5\n", "x;y;z\n1.5;2.5;3\n1,5;2;3\n", "x;y;z\n1.234,5;2;3\n", "x y z\n1,5 2.5 3\n"}) {
        ImportOptions options = in_box();
        options.length_unit = 1e-6;
        EXPECT_NE(sentence<InputError>([&] {
                      read_text(write("a.csv", text), TextFormat::csv, options);
                  }).find("but the file has decimal commas and decimal points"),
                  std::string::npos)
            << text;
    }
}

TEST_F(TextFormats, CommentsWithoutAHeaderStayComments) {
    const std::string path = write("a.csv", "# measured on Monday\n# by us\n1 2 3 4\n");
    EXPECT_EQ(sentence<InputError>([&] { read_text(path, TextFormat::csv, in_box()); }),
              path +
                  ", line 3: there is no column x among 1, 2, 3, 4; the first line must be a header that names x, y and z, or give "
                  "--columns x=HEADING");
}

TEST_F(TextFormats, LengthUnitForColumnsWithout) {
    const std::string path = write("a.csv", "x,y,z [nm],r\n1,2,3000,0.5\n");
    ImportOptions options;
    options.box = box;
    EXPECT_EQ(sentence<InputError>([&] { read_text(path, TextFormat::csv, options); }),
              path + ", line 1: column x names no unit: give --length-unit");
    options.length_unit = 1e-6;
    const Packing found = read_text(path, TextFormat::csv, options);
    EXPECT_TRUE(found.positions.isApprox(Eigen::Vector3d(1e-6, 2e-6, 3e-6), 1e-15));
    EXPECT_NEAR(found.radii[0], 5e-7, 1e-21);
}

TEST_F(TextFormats, OpenSetsGetTheBoxAroundTheirSpheres) {
    const std::string path = write("a.csv", "x [m],y [m],z [m],radius [m]\n-1,0,2,1\n3,0.5,2,0.5\n");
    ImportOptions options;
    options.open = true;
    const Packing found = read_text(path, TextFormat::csv, options);
    EXPECT_FALSE(found.cell.is_periodic());
    EXPECT_EQ(found.cell.origin(), Eigen::Vector3d(-2, -1, 1));
    EXPECT_EQ(found.cell.lengths(), Eigen::Vector3d(5.5, 2, 2));
    options.box = Eigen::Matrix3d(Eigen::Vector3d(7.5, 4, 4).asDiagonal());
    EXPECT_EQ(read_text(path, TextFormat::csv, options).cell.origin(), Eigen::Vector3d(-3, -2, 0));
}

TEST_F(TextFormats, OutsideTheBoxIsAnErrorUnlessWrapped) {
    const std::string path = write("a.csv", "x [um],y [um],z [um]\n1,1,1\n-1,2,12\n");
    EXPECT_EQ(
        sentence<InputError>([&] { read_text(path, TextFormat::csv, in_box()); }),
        path + ", line 3: x is -1e-06 m, outside the periodic box from 0 to 1e-05 m; give --wrap to bring such particles back in");
    ImportOptions options = in_box();
    options.wrap = true;
    EXPECT_TRUE(read_text(path, TextFormat::csv, options).positions.col(1).isApprox(Eigen::Vector3d(9e-6, 2e-6, 2e-6), 1e-14));
    const std::string edge = write("edge.csv", "x [um],y [um],z [um]\n10,0,10.000000001\n");
    EXPECT_LT(read_text(edge, TextFormat::csv, in_box()).positions.norm(), 2e-15) << "a rounding outside";
}

struct BadText {
    TextFormat format;
    std::string contents;
    std::string rule;
};

TEST_F(TextFormats, BadFilesNameLineAndRule) {
    const std::string header = "x [um],y [um],z [um]\n";
    const std::vector<BadText> files{
        {TextFormat::csv, "", " has no header"},
        {TextFormat::csv, header, " has no particles"},
        {TextFormat::csv, "1,2,3\n",
         ", line 1: there is no column x among 1, 2, 3; the first line must be a header that names x, y and z, or give --columns "
         "x=HEADING"},
        {TextFormat::csv, "x [um],y [um]\n1,2\n",
         ", line 1: there is no column z among x, y; the first line must be a header that names x, y and z, or give --columns "
         "z=HEADING"},
        {TextFormat::csv, "x [s],y [um],z [um]\n1,2,3\n", ", line 1: column x has the unit 's', which is not a length"},
        {TextFormat::csv, "x [mm,y [um],z [um]\n1,2,3\n",
         ", line 1: there is no column x among x [mm, y, z; the first line must be a header that names x, y and z, or give "
         "--columns x=HEADING"},
        {TextFormat::csv, header + "1,2,3\n1,2\n", ", line 3: there are 2 fields, but the header names 3"},
        {TextFormat::csv, header + "1,2,3,4\n", ", line 2: there are 4 fields, but the header names 3"},
        {TextFormat::csv, header + "1,2,abc\n", ", line 2: z is 'abc', which is not a number"},
        {TextFormat::csv, header + "1,,3\n", ", line 2: y is '', which is not a number"},
        {TextFormat::csv, header + "1,2,3 4\n", ", line 2: z is '3 4', which is not a number"},
        {TextFormat::csv, header + "1,2,nan\n", ", line 2: z is 'nan', but must be finite"},
        {TextFormat::csv, header + "1,2,1e999\n", ", line 2: z is '1e999', which is not a number"},
        {TextFormat::csv, header + "1,2,3\n1,2,3\n", ": particles 0 and 1 have the same centre"},
        {TextFormat::extended_xyz, "", " has no particles"},
        {TextFormat::extended_xyz, "x\n", ", line 1: the number of particles is 'x', which is not a whole number"},
        {TextFormat::extended_xyz, "1\n", ", line 1: the comment line is missing"},
        {TextFormat::extended_xyz, "1\nno unit\nX 1 2 3\n", ", line 2: the comment line names no unit: give --length-unit"},
        {TextFormat::extended_xyz, "2\nlength_unit=um\nX 1 2 3\n", ", line 3: the file ends after 1 of 2 particles"},
        {TextFormat::extended_xyz, "1\nlength_unit=um\nX 1 2\n", ", line 3: there are 3 columns, but 4 are expected"},
        {TextFormat::extended_xyz, "1\nlength_unit=um Properties=pos:R\nX 1 2\n",
         ", line 2: Properties must be triples name:type:columns"},
        {TextFormat::extended_xyz, "1\nlength_unit=um Properties=id:I:1\n1\n", ", line 2: Properties name no pos:R:3"},
        {TextFormat::extended_xyz, "1\nlength_unit=um Properties=a:R:18446744073709551615:pos:R:3\nX 1 2 3\n",
         ", line 2: the number of columns of a is 18446744073709551615, but must be at most 1000"},
        {TextFormat::extended_xyz, "1\nlength_unit=um Lattice=\"1 2\"\nX 1 2 3\n", ", line 2: Lattice must have nine numbers"},
        {TextFormat::extended_xyz, "1\nlength_unit=um Lattice=\"9 1 0 9 1 0 0 0 9\"\nX 1 2 3\n",
         ", line 2: the edges of the box lie in one plane: it has no volume"},
        {TextFormat::extended_xyz, "1\nlength_unit=um Lattice=\"9 0 0 0 -9 0 0 0 9\"\nX 1 2 3\n",
         ", line 2: the edge length of the box is -9e-06 m, but must be finite and positive"},
        {TextFormat::extended_xyz, "1\nlength_unit=um pbc=\"T T X\" Lattice=\"9 0 0 0 9 0 0 0 9\"\nX 1 2 3\n",
         ", line 2: pbc must be one flag for each edge of the box, such as \"T T F\""},
        {TextFormat::lammps_data, "", ", line 0: the file has no section Atoms"},
        {TextFormat::lammps_data, "t, units = si\n1 atoms\n", ", line 2: the file has no section Atoms"},
        {TextFormat::lammps_data, "t, units = si\n\nAtoms\n", ": the header names no number of atoms"},
        {TextFormat::lammps_data, "t, units = si\n0 atoms\nAtoms\n", " has no particles"},
        {TextFormat::lammps_data, "t\n1 atoms\nAtoms # atomic\n\n1 1 1 1 1\n",
         ", line 3: the file names no unit: give --length-unit"},
        {TextFormat::lammps_data, "t, units = si\n2 atoms\nAtoms # atomic\n\n1 1 1 1 1\n",
         ", line 5: the file ends after 1 of 2 atoms"},
        {TextFormat::lammps_data, "t, units = si\n1 atoms\nAtoms # full\n\n1 1 1 1 1\n",
         ", line 5: there are 5 columns, but atom style full has 7 (and three image flags)"},
        {TextFormat::lammps_data, "t, units = si\n1 atoms\nAtoms # atomic\n\n1 1 1 1\n",
         ", line 5: there are 4 columns, but atom style atomic has 5 (and three image flags)"},
        {TextFormat::lammps_data, "t, units = si\n2 atoms\nAtoms # atomic\n\n1 1 1 1 1\n1 1 2 2 2\n",
         ", line 6: atom 1 occurs twice"},
        {TextFormat::lammps_data, "t, units = si\n1 atoms\n0 x 1 xy xz yz\nAtoms # atomic\n\n1 1 1 1 1\n",
         ", line 3: the tilt is 'x', which is not a number"},
        {TextFormat::lammps_data, "t, units = si\n1 atoms\n1 0 xlo xhi\n0 1 ylo yhi\n0 1 zlo zhi\nAtoms # atomic\n\n1 1 1 1 1\n",
         ", line 6: the edge length of the box is -1 m, but must be finite and positive"},
    };
    for (const BadText& bad : files) {
        const std::string path = write("bad", bad.contents);
        EXPECT_EQ(sentence<InputError>([&] { read_text(path, bad.format, in_box()); }), path + bad.rule) << bad.contents;
    }
}

TEST_F(TextFormats, BadOptions) {
    const std::string path = write("a.csv", "x [um],y [um],z [um]\n1,2,3\n");
    const auto reading = [&](const ImportOptions& options) {
        return sentence<InputError>([&] { read_text(path, TextFormat::csv, options); });
    };
    ImportOptions options;
    options.box = box;
    EXPECT_EQ(reading(options), path + " names no radii: give --radius (or a column 'radius' or 'diameter')");
    options.radius = -1;
    EXPECT_EQ(reading(options), path + ": the radius is -1 m, but must be finite and positive");
    options = in_box();
    options.box.reset();
    EXPECT_EQ(reading(options), path + " names no box: give --box for a periodic one or --open for a set with a free surface");
    options.box = Eigen::Matrix3d(Eigen::Vector3d(1e-5, 0, 1e-5).asDiagonal());
    EXPECT_EQ(reading(options), path + ": the edge length of the box is 0 m, but must be finite and positive");
    options = in_box();
    options.radius = 1e-5;
    EXPECT_TRUE(reading(options).starts_with(path + " is overfull: its spheres take 4.18"));
    EXPECT_EQ(sentence<InputError>([&] { read_text(file("none.csv"), TextFormat::csv, in_box()); }),
              file("none.csv") + " does not exist");
    EXPECT_EQ(sentence<InputError>([&] { read_text(folder_.string(), TextFormat::csv, in_box()); }),
              folder_.string() + " cannot be read: it is a folder");
}

TEST_F(TextFormats, ReadsXyzOfOthers) {
    const std::string path = write("a.xyz",
                                   "1\nplain\nAr 0 0 0\n"
                                   "2\nLattice=\"10 0 0 0 20 0 0 0 30\" Properties=radius:R:1:species:S:1:pos:R:3:v:R:2\n"
                                   "0.5 Si 1 2 3 7 7\n0.25 O 4 5 6 8 8\n");
    ImportOptions options;
    options.length_unit = 1e-10;
    const Packing found = read_text(path, TextFormat::extended_xyz, options);
    EXPECT_TRUE(found.positions.isApprox((Eigen::Matrix3Xd(3, 2) << 1, 4, 2, 5, 3, 6).finished() * 1e-10, 1e-15));
    EXPECT_TRUE(found.radii.isApprox(Eigen::Vector2d(0.5, 0.25) * 1e-10, 1e-15));
    EXPECT_TRUE(found.cell.lengths().isApprox(Eigen::Vector3d(10, 20, 30) * 1e-10, 1e-15));
}

TEST_F(TextFormats, ExtendedXyzInEverySpelling) {
    const std::string atoms = "\nA 1 1 1 0.3\nA 2 2 2D0 0.3\n";
    ImportOptions options;
    options.length_unit = 1e-6;
    for (const std::string comment :
         {R"(Lattice="5 0 0 0 6 0 0 0 7" Properties=species:S:1:pos:R:3:radius:R:1)",
          R"(Lattice = "5 0 0 0 6 0 0 0 7" Properties = species:S:1:pos:R:3:radius:R:1 pbc = "T T T")",
          R"(Lattice='5 0 0 0 6 0 0 0 7' Properties='species:S:1:pos:R:3:radius:R:1' pbc='True True True')",
          R"(Lattice=[[5.0, 0.0, 0.0], [0.0, 6.0, 0.0], [0.0, 0.0, 7.0]] Properties=species:S:1:pos:R:3:radius:R:1 pbc=[T, T, T])",
          R"(Lattice=[ [ 5, 0, 0 ],[0, 6, 0],[0,0,7] ] pbc=[True, TRUE, true] Properties=species:S:1:pos:R:3:radius:R:1)",
          R"(lattice={5 0 0 0 6 0 0 0 7} pbc={T T T} properties=species:S:1:pos:R:3:radius:R:1)",
          R"(pbc="[T, T, T]" Lattice="5,0,0,0,6,0,0,0,7" Properties=species:S:1:pos:R:3:radius:R:1)",
          R"(pbc=T Lattice="5 0 0 0 6 0 0 0 7" name="a \"quoted\" word" Properties=species:S:1:pos:R:3:radius:R:1)",
          R"(a remark, it's free pbc="1 1 1" Lattice	=	"5 0 0 0 6 0 0 0 7" Properties=species:S:1:pos:R:3:radius:R:1)"}) {
        const Packing found = read_text(write("a.xyz", "2\n" + comment + atoms), TextFormat::extended_xyz, options);
        EXPECT_TRUE(found.cell.is_periodic()) << comment;
        EXPECT_TRUE(found.cell.lengths().isApprox(Eigen::Vector3d(5e-6, 6e-6, 7e-6))) << comment;
        EXPECT_TRUE(found.positions.isApprox((Eigen::Matrix3Xd(3, 2) << 1, 2, 1, 2, 1, 2).finished() * 1e-6, 1e-14)) << comment;
        EXPECT_TRUE(found.radii.isApprox(Eigen::Vector2d::Constant(3e-7), 1e-14)) << comment;
    }
    for (const std::string flags : {"\"False False False\"", "[F, F, F]", "false", "\"0 0 0\""}) {
        const std::string path = write("a.xyz", "1\nLattice=\"5 0 0 0 6 0 0 0 7\" pbc=" + flags + "\nA 1 1 1\n");
        options.radius = 1e-7;
        EXPECT_FALSE(read_text(path, TextFormat::extended_xyz, options).cell.is_periodic()) << flags;
    }
}

TEST_F(TextFormats, OriginOfAPeriodicBoxIsATranslation) {
    const std::string path =
        write("a.xyz",
              "2\nLattice=\"5 0 0 0 6 0 0 0 7\" Origin=\"-2.5 -3 10\" Properties=species:S:1:pos:R:3:radius:R:1\n"
              "A -2.5 0 16 0.3\nA 2 -3 10.5 0.3\n");
    ImportOptions options;
    options.length_unit = 1e-6;
    const Packing found = read_text(path, TextFormat::extended_xyz, options);
    EXPECT_TRUE(found.positions.isApprox((Eigen::Matrix3Xd(3, 2) << 0, 4.5, 3, 0, 6, 0.5).finished() * 1e-6, 1e-12));
    EXPECT_EQ(found.cell.origin(), Eigen::Vector3d::Zero());
}

TEST_F(TextFormats, ExtendedXyzThatDoesNotEnd) {
    for (const auto& [comment, rule] : {std::pair{"Lattice=\"5 0 0", "quotation mark \""},
                                        {"Lattice='5 0 0", "quotation mark '"},
                                        {"Lattice=[[5, 0, 0]", "bracket"},
                                        {"pbc=\"T T\" Lattice=\"5 0 0 0 6 0 0 0 7\"", "pbc must be"},
                                        {"pbc=[T, T, maybe] Lattice=\"5 0 0 0 6 0 0 0 7\"", "pbc must be"},
                                        {"Origin=\"1 2\" Lattice=\"5 0 0 0 6 0 0 0 7\"", "Origin must have three numbers"}}) {
        const std::string path = write("a.xyz", "1\nlength_unit=um " + std::string(comment) + "\nA 1 1 1\n");
        EXPECT_NE(sentence<InputError>([&] { read_text(path, TextFormat::extended_xyz, in_box()); }).find(rule), std::string::npos)
            << comment;
    }
}

TEST_F(TextFormats, PackingsOfOtherPrograms) {
    const std::filesystem::path data = std::filesystem::path(COAGULA_DATASETS) / "foreign_structures";
    ImportOptions options;
    options.length_unit = 1e-6;
    const auto reading = [&](const char* name, TextFormat format) { return read_text((data / name).string(), format, options); };
    const Packing reference = reading("x_ref.xyz", TextFormat::extended_xyz);
    EXPECT_EQ(reference.size(), 120);
    for (const char* name : {"x_True.xyz", "x_list.xyz", "x_latlist.xyz"}) {
        const Packing found = reading(name, TextFormat::extended_xyz);
        EXPECT_EQ(found.positions, reference.positions) << name;
        EXPECT_EQ(found.cell.lengths(), reference.cell.lengths()) << name;
        EXPECT_TRUE(found.cell.is_periodic()) << name;
    }
    for (const char* name : {"blanks_around_equals.xyz", "single_quotes.xyz"}) {
        const Packing found = reading(name, TextFormat::extended_xyz);
        EXPECT_TRUE(found.cell.lengths().isApprox(Eigen::Vector3d::Constant(5e-6))) << name;
        EXPECT_TRUE(found.radii.isApprox(Eigen::Vector2d::Constant(3e-7))) << name;
    }
    options.box = Eigen::Matrix3d(Eigen::Vector3d(8e-6, 9e-6, 10e-6).asDiagonal());
    for (const char* name : {"y_space.csv", "y_yade.csv", "y_yade.txt"}) {
        const Packing found = reading(name, TextFormat::csv);
        EXPECT_TRUE(found.positions.isApprox(reference.positions, 1e-8)) << name;
        EXPECT_EQ(found.radii, reference.radii) << name;
    }
}

TEST_F(TextFormats, ReadsLammpsOfOthers) {
    const std::string path = write("a.data",
                                   "LAMMPS data file via write_data, version 1, timestep = 0, units = micro\n\n"
                                   "2 atoms\n1 atom types\n\n-5 5 xlo xhi\n0 8 ylo yhi\n1 7 zlo zhi\n\n"
                                   "Masses\n\n1 1\n\nAtoms # sphere\n\n"
                                   "2 1 0.5 1 4 5 6 0 0 -1\n1 1 1 1 -4 2 3 0 1 0 # last\n\nVelocities\n\n1 0 0 0 0 0 0\n");
    const Packing found = read_text(path, TextFormat::lammps_data, {});
    EXPECT_TRUE(found.positions.isApprox((Eigen::Matrix3Xd(3, 2) << 1, 9, 2, 5, 2, 5).finished() * 1e-6, 1e-15));
    EXPECT_TRUE(found.radii.isApprox(Eigen::Vector2d(0.5, 0.25) * 1e-6, 1e-15));
    EXPECT_TRUE(found.cell.lengths().isApprox(Eigen::Vector3d(10, 8, 6) * 1e-6, 1e-15));
    EXPECT_TRUE(found.cell.is_periodic());
}

TEST_F(TextFormats, MeasuredAndReferencePackings) {
    const std::filesystem::path data = COAGULA_DATASETS;
    ImportOptions options;
    options.radius = 0.25e-6;
    options.box = Eigen::Matrix3d(Eigen::Vector3d::Constant(1.0939048394478881e-05).asDiagonal());
    for (const char* name : {"vem_1-8", "vem_1-2", "vem_2-1", "brownian_0mV", "brownian_15mV"}) {
        const Packing packing = read_text((data / "reference_structures" / name).string() + ".csv", TextFormat::csv, options);
        EXPECT_EQ(packing.size(), 8000);
        EXPECT_NEAR(volume_fraction(packing), 0.4, 1e-12);
    }
    ImportOptions finney;
    finney.radius = 1.0;
    finney.length_unit = 1.0;
    finney.open = true;
    const Packing packing = read_text((data / "finney_pack/finney.csv").string(), TextFormat::csv, finney);
    EXPECT_EQ(packing.size(), 4021);
    EXPECT_GT(find_contacts(packing, -0.016).size(), 0) << "the smallest centre distance is 1.966";
    EXPECT_EQ(find_contacts(packing, -0.018).size(), 0);
}

}  // namespace
}  // namespace coagula::io
