// SPDX-License-Identifier: GPL-3.0-or-later
// Files that are no structure files, or broken ones: each gives a sentence that names the file and the object.
#include <coagula/io/structure_file.hpp>

#include <gtest/gtest.h>
#include <hdf5.h>

#include <functional>

#include "example_packing.hpp"
#include "temporary_folder.hpp"

/// HDF5 1.10 loses some memory on the way out of a damaged file; the leak sanitizer is told so.
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libhdf5";
}

namespace coagula::io {
namespace {

class BadStructure : public TemporaryFolder {
protected:
    BadStructure() : path_(file("a.h5")) {
        const Packing packing = example_packing(8, true);
        write_structure(path_, {packing, find_contacts(packing, 1.0)}, {}, {}, {}, false);
    }

    /// Opens the file, lets `change` work on it and reads it again: what read_structure says.
    std::string after(const std::function<void(hid_t)>& change) const {
        const hid_t id = H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
        change(id);
        H5Fclose(id);
        return reading(path_);
    }

    static std::string reading(const std::string& path) {
        return sentence<InputError>([&] { read_structure(path); });
    }

    std::string path_;
};

void remove(hid_t id, const std::string& object) {
    ASSERT_GE(H5Ldelete(id, object.c_str(), H5P_DEFAULT), 0);
}

/// Replaces a dataset by one with all values equal; unit "nm" unless told otherwise.
void replace(hid_t id, const std::string& object, const std::vector<hsize_t>& shape, double value, const std::string& unit = "nm") {
    remove(id, object);
    hsize_t count = 1;
    for (const hsize_t length : shape) {
        count *= length;
    }
    const std::vector<double> values(count, value);
    const hid_t space = H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
    const hid_t dataset = H5Dcreate2(id, object.c_str(), H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    if (!unit.empty()) {
        const hid_t type = H5Tcopy(H5T_C_S1);
        H5Tset_size(type, unit.size());
        const hid_t scalar = H5Screate(H5S_SCALAR);
        const hid_t attribute = H5Acreate2(dataset, "unit", type, scalar, H5P_DEFAULT, H5P_DEFAULT);
        H5Awrite(attribute, type, unit.data());
        H5Aclose(attribute);
        H5Sclose(scalar);
        H5Tclose(type);
    }
    H5Dclose(dataset);
    H5Sclose(space);
}

/// Writes one value of a dataset of numbers.
void set_value(hid_t id, const std::string& object, std::size_t index, double value) {
    const hid_t dataset = H5Dopen2(id, object.c_str(), H5P_DEFAULT);
    const hid_t space = H5Dget_space(dataset);
    std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    values.at(index) = value;
    H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Sclose(space);
    H5Dclose(dataset);
}

TEST_F(BadStructure, MissingFolderAndForeignFiles) {
    EXPECT_EQ(reading(file("none.h5")), file("none.h5") + " does not exist");
    EXPECT_EQ(reading(folder_.string()), folder_.string() + " cannot be read: it is a folder");
    EXPECT_EQ(reading(write("text.h5", "x,y,z\n1,2,3\n")), file("text.h5") + " is not an HDF5 file");
    EXPECT_EQ(reading(write("empty.h5", "")), file("empty.h5") + " is not an HDF5 file");
    const hid_t id = H5Fcreate(file("other.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    H5Fclose(id);
    EXPECT_EQ(reading(file("other.h5")), file("other.h5") + ": /h5md is missing: this is not an H5MD file");
}

TEST_F(BadStructure, TruncatedAtAnyPlace) {
    const Packing packing = example_packing(500, true);
    write_structure(path_, {packing, std::nullopt}, {}, {}, {}, true);
    const std::string whole = read(path_);
    for (const std::size_t size : {whole.size() - 1, whole.size() / 2, whole.size() / 10, std::size_t{100}, std::size_t{20}}) {
        const std::string path = write("cut.h5", whole.substr(0, size));
        const std::string said = reading(path);
        EXPECT_TRUE(said == path + " is truncated or damaged" || said == path + " is not an HDF5 file") << said;
        EXPECT_THROW(read_results(path, "/"), InputError);
        EXPECT_THROW(read_provenance(path), InputError);
        EXPECT_THROW(add_results(path, file("b.h5"), {{}, std::nullopt, {}, {}, {}}, false), InputError);
    }
    EXPECT_FALSE(std::filesystem::exists(file("b.h5")));
}

TEST_F(BadStructure, DamagedBytesNeverCrash) {
    const Packing packing = example_packing(60, true);
    write_structure(path_, {packing, find_contacts(packing, 0.2)}, {}, {}, {}, true);
    const std::string whole = read(path_);
    for (std::size_t place = 0; place < whole.size(); place += 251) {
        std::string damaged = whole;
        damaged[place] = static_cast<char>(~damaged[place]);
        const std::string path = write("damaged.h5", damaged);
        try {
            const Structure found = read_structure(path);  // the byte may be one that does not matter
            EXPECT_TRUE(found.packing.positions.allFinite());
        } catch (const InputError& error) {
            EXPECT_TRUE(std::string(error.what()).starts_with(path)) << error.what();
        }
    }
}

TEST_F(BadStructure, MissingObjects) {
    EXPECT_EQ(after([](hid_t id) { remove(id, "/particles/trajectory/radius"); }),
              path_ +
                  ": /particles/trajectory/radius is missing: without radii this is not a packing of spheres; coagula import "
                  "takes them from --radius");
    EXPECT_EQ(after([](hid_t id) { remove(id, "/particles/trajectory/position/value"); }),
              path_ + ": /particles/trajectory/position/value is missing");
    EXPECT_EQ(after([](hid_t id) { remove(id, "/particles/trajectory/position"); }),
              path_ + ": /particles/trajectory/position is missing");
    EXPECT_EQ(after([](hid_t id) { remove(id, "/particles/trajectory"); }), path_ + ": /particles/trajectory is missing");
    EXPECT_EQ(after([](hid_t id) { remove(id, "/particles"); }), path_ + ": /particles is missing: this is not an H5MD file");
}

TEST_F(BadStructure, MissingBox) {
    EXPECT_EQ(after([](hid_t id) { remove(id, "/particles/trajectory/box/edges"); }),
              path_ + ": /particles/trajectory/box/edges is missing");
    EXPECT_EQ(after([](hid_t id) { remove(id, "/particles/trajectory/box"); }), path_ + ": /particles/trajectory/box is missing");
}

TEST_F(BadStructure, InconsistentShapes) {
    EXPECT_EQ(after([](hid_t id) { replace(id, "/particles/trajectory/radius", {9}, 1); }),
              path_ + ": /particles/trajectory/radius has the shape [9], but [8] is expected");
    EXPECT_EQ(after([](hid_t id) {
                  replace(id, "/particles/trajectory/radius", {8, 1}, 1);
              }),
              path_ + ": /particles/trajectory/radius has the shape [8][1], but [8] is expected");
    EXPECT_EQ(after([](hid_t id) {
                  replace(id, "/particles/trajectory/radius", {8}, 1);
                  replace(id, "/particles/trajectory/position/step", {2}, 0, "");
              }),
              path_ + ": /particles/trajectory/position/step has the shape [2], but [1] is expected");
    EXPECT_EQ(after([](hid_t id) {
                  replace(id, "/particles/trajectory/position/value", {1, 8, 2}, 1);
              }),
              path_ + ": /particles/trajectory/position/value has the shape [1][8][2], but [frames][particles][3] is expected");
    EXPECT_EQ(after([](hid_t id) {
                  replace(id, "/particles/trajectory/position/value", {1, 0, 3}, 1);
              }),
              path_ + ": /particles/trajectory/position/value has no particles");
    EXPECT_EQ(after([](hid_t id) {
                  replace(id, "/particles/trajectory/position/value", {0, 8, 3}, 1);
              }),
              path_ + ": /particles/trajectory/position/value has no frame");
}

TEST_F(BadStructure, OverfullFiles) {
    EXPECT_EQ(after([](hid_t id) { replace(id, "/particles/trajectory/id", {9}, 1, ""); }),
              path_ + ": /particles/trajectory/id has the shape [9], but [8] is expected");
    EXPECT_TRUE(after([](hid_t id) {
                    remove(id, "/particles/trajectory/id");
                    replace(id, "/particles/trajectory/radius", {8}, 2000);
                }).starts_with(path_ + ": /particles/trajectory is overfull: its spheres take 8.0"));
}

TEST_F(BadStructure, BadValues) {
    EXPECT_EQ(after([](hid_t id) { set_value(id, "/particles/trajectory/position/value", 7, unset); }),
              path_ + ": /particles/trajectory: particle 2 has a coordinate that is not a finite number");
    EXPECT_EQ(
        after([](hid_t id) { set_value(id, "/particles/trajectory/position/value", 7, 2800.0); }),
        path_ + ": /particles/trajectory: particle 2 lies outside the box: its y is 2.8e-06 m, the box goes from 0 to 2.7e-06 m");
    EXPECT_EQ(after([](hid_t id) {
                  set_value(id, "/particles/trajectory/position/value", 7, 1000.0);
                  set_value(id, "/particles/trajectory/radius", 3, -1);
              }),
              path_ + ": /particles/trajectory: particle 3 has radius -1e-09 m, but a radius must be finite and positive");
}

TEST_F(BadStructure, CoincidentParticles) {
    EXPECT_EQ(after([](hid_t id) {
                  replace(id, "/particles/trajectory/position/value", {1, 8, 3}, 500);
              }),
              path_ + ": /particles/trajectory: particles 0 and 1 have the same centre");
}

TEST_F(BadStructure, BadUnitsAndTypes) {
    const std::string position = "/particles/trajectory/position/value";
    EXPECT_EQ(after([&](hid_t id) {
                  replace(id, position, {1, 8, 3}, 1, "");
              }),
              path_ + ": " + position + " carries no unit; coagula import takes it from --length-unit");
    EXPECT_EQ(after([&](hid_t id) {
                  replace(id, position, {1, 8, 3}, 1, "px");
              }),
              path_ + ": " + position + " has the unit 'px', which is not a length");
    EXPECT_EQ(after([&](hid_t id) {
                  replace(id, position, {1, 8, 3}, 1, "s");
              }),
              path_ + ": " + position + " has the unit 's', which is not a length");
    EXPECT_EQ(after([&](hid_t id) {
                  remove(id, position);
                  H5Lcreate_hard(id, "/provenance", id, position.c_str(), H5P_DEFAULT, H5P_DEFAULT);
              }),
              path_ + ": " + position + " is not a dataset");
}

TEST_F(BadStructure, BadBoxes) {
    const std::string edges = "/particles/trajectory/box/edges/value";
    EXPECT_EQ(after([&](hid_t id) {
                  for (const std::size_t entry : {0U, 1U, 2U}) {
                      set_value(id, edges, entry, 0);
                      set_value(id, edges, entry + 3, 5);
                  }
              }),
              path_ + ": " + edges + " cannot be read: the edges of the box lie in one plane: it has no volume");
    EXPECT_EQ(after([&](hid_t id) { set_value(id, edges, 1, unset); }),
              path_ + ": " + edges + " has an edge that is not a finite number");
    EXPECT_EQ(after([&](hid_t id) {
                  for (const std::size_t entry : {1U, 2U, 3U, 5U}) {
                      set_value(id, edges, entry, 0);
                  }
                  set_value(id, edges, 0, 3);
                  set_value(id, edges, 4, -2);
              }),
              path_ + ": /particles/trajectory/box/edges has an edge of -2e-09 m, but edges must be finite and positive");
    EXPECT_EQ(after([&](hid_t id) { H5Adelete_by_name(id, "/particles/trajectory/box", "boundary", H5P_DEFAULT); }),
              path_ + ": /particles/trajectory/box must have an attribute 'boundary' of three texts");
}

TEST_F(BadStructure, BadBonds) {
    EXPECT_EQ(after([](hid_t id) { set_value(id, "/connectivity/bonds", 3, 8); }),
              path_ + ": /connectivity/bonds has bond 1 to particle 8, but particles are numbered from 0 to 7");
    EXPECT_EQ(after([](hid_t id) {
                  replace(id, "/connectivity/bonds", {3, 3}, 1);
              }),
              path_ + ": /connectivity/bonds has the shape [3][3], but [bonds][2] is expected");
    EXPECT_EQ(after([](hid_t id) {
                  replace(id, "/connectivity/bonds", {3, 2}, 1);
                  replace(id, "/connectivity/branch_vectors", {3, 3}, 0, "m");
              }),
              path_ + ": /connectivity/branch_vectors has bond 0 of length 0 m");
    EXPECT_EQ(after([](hid_t id) {
                  replace(id, "/connectivity/branch_vectors", {4, 3}, 1, "m");
              }),
              path_ + ": /connectivity/branch_vectors has the shape [4][3], but [3][3] is expected");
}

TEST_F(BadStructure, ReadsOtherProgramsAndTheLastFrame) {
    const hid_t id = H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const std::string group = "/particles/trajectory";
    for (const char* name : {"/position/value", "/position/step", "/position/time", "/box/edges", "/box/origin", "/radius"}) {
        remove(id, group + name);
    }
    remove(id, "/connectivity");
    const hid_t links = H5Pcreate(H5P_LINK_CREATE);
    H5Pset_create_intermediate_group(links, 1);
    const auto write = [&](const std::string& name, const std::vector<hsize_t>& shape, const std::vector<double>& values) {
        H5Lcreate_soft("/none", id, (group + name).c_str(), links, H5P_DEFAULT);
        replace(id, group + name, shape, 0, "A");
        for (std::size_t i = 0; i < values.size(); ++i) {
            set_value(id, group + name, i, values[i]);
        }
    };
    write("/position/value", {2, 2, 3}, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 1, 2});
    write("/box/edges", {3}, {20, 30, 40});
    write("/radius/value", {2, 2}, {1, 2, 3, 4});
    remove(id, group + "/id");
    H5Lmove(id, group.c_str(), id, "/particles/colloids", H5P_DEFAULT, H5P_DEFAULT);
    H5Pclose(links);
    H5Fclose(id);
    const Packing found = read_structure(path_).packing;
    EXPECT_TRUE(found.positions.isApprox((Eigen::Matrix3Xd(3, 2) << 7, 10, 8, 1, 9, 2).finished() * 1e-10, 1e-15));
    EXPECT_TRUE(found.radii.isApprox(Eigen::Vector2d(3, 4) * 1e-10, 1e-15));
    EXPECT_TRUE(found.cell.lengths().isApprox(Eigen::Vector3d(20, 30, 40) * 1e-10, 1e-15));
    EXPECT_TRUE(found.cell.is_periodic());
    add_results(path_, file("b.h5"), {{}, find_contacts(found, 0.5), {}, {}, {}}, false);
    EXPECT_TRUE(read_structure(file("b.h5")).bonds);
}

}  // namespace
}  // namespace coagula::io
