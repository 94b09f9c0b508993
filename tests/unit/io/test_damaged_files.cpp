// SPDX-License-Identifier: GPL-3.0-or-later
// HDF5 files that were damaged or made to mislead: each gives one sentence, and HDF5 prints nothing.
#include <coagula/io/structure_file.hpp>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/file.h>
#include <unistd.h>

#include <functional>
#include <random>

#include "example_packing.hpp"
#include "temporary_folder.hpp"

namespace coagula::io {
namespace {

Provenance stage(const std::string& name, const std::string& command_line = "") {
    Provenance entry;
    entry.stage = name;
    entry.command_line = command_line;
    return entry;
}

class DamagedFile : public TemporaryFolder {
protected:
    DamagedFile() : path_(file("a.h5")) {
        const Packing packing = example_packing(60, true);
        write_structure(path_, {packing, find_contacts(packing, 0.2)}, {},
                        {scalar("/mechanics/linear/modulus", 1, "Pa", "a modulus")}, stage("generate", "coagula generate"), false);
    }

    /// Lets `change` work on the file; what reading it says then, whichever way it is read.
    std::string after(const std::function<void(hid_t)>& change) const {
        const hid_t id = H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
        change(id);
        H5Fclose(id);
        std::string said = sentence<InputError>([&] { read_structure(path_); });
        EXPECT_EQ(sentence<InputError>([&] { read_results(path_, "/mechanics"); }), said);
        EXPECT_EQ(sentence<InputError>([&] { read_provenance(path_); }), said);
        EXPECT_EQ(sentence<InputError>([&] { add_to_copy(); }), said);
        return said;
    }

    void add_to_copy() const { add_results(path_, file("b.h5"), {{}, std::nullopt, {}, {}, stage("shear")}, true); }

    std::string path_;
};

void make_dataset(hid_t id, const char* name, hid_t properties, const std::vector<hsize_t>& shape) {
    const hid_t space = H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
    const hid_t dataset = H5Dcreate2(id, name, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, properties, H5P_DEFAULT);
    ASSERT_GE(dataset, 0);
    H5Dclose(dataset);
    H5Sclose(space);
}

TEST_F(DamagedFile, RefusesDataOfOtherFiles) {
    const std::vector<hsize_t> shape{4};
    EXPECT_EQ(after([&](hid_t id) {
                  const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
                  const hid_t space = H5Screate_simple(1, shape.data(), nullptr);
                  H5Pset_virtual(properties, space, "other.h5", "/x", space);
                  make_dataset(id, "/virtual", properties, shape);
                  H5Sclose(space);
                  H5Pclose(properties);
              }),
              path_ + ": /virtual is a virtual dataset, which coagula does not read");
    EXPECT_EQ(after([&](hid_t id) {
                  H5Ldelete(id, "/virtual", H5P_DEFAULT);
                  const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
                  H5Pset_external(properties, "/etc/hostname", 0, 4 * sizeof(double));
                  make_dataset(id, "/mechanics/outside", properties, shape);
                  H5Pclose(properties);
              }),
              path_ + ": /mechanics/outside is stored in another file, which coagula does not read");
    EXPECT_EQ(after([&](hid_t id) {
                  H5Ldelete(id, "/mechanics/outside", H5P_DEFAULT);
                  H5Lcreate_external("other.h5", "/x", id, "/elsewhere", H5P_DEFAULT, H5P_DEFAULT);
              }),
              path_ + ": /elsewhere is a link to another file, which coagula does not follow");
}

TEST_F(DamagedFile, RefusesGroupsThatAreNestedTooDeep) {
    const std::string said = after([](hid_t id) {
        hid_t group = H5Gcreate2(id, "g", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
        for (int depth = 1; depth < 3000; ++depth) {
            const hid_t inner = H5Gcreate2(group, "g", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
            H5Gclose(group);
            group = inner;
        }
        H5Gclose(group);
    });
    EXPECT_TRUE(said.ends_with("/g/g lies in more than 64 nested groups")) << said;
}

TEST_F(DamagedFile, GroupsThatContainThemselvesAreWalkedOnce) {
    const hid_t id = H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    H5Lcreate_hard(id, "/", id, "/mechanics/again", H5P_DEFAULT, H5P_DEFAULT);
    H5Fclose(id);
    EXPECT_EQ(read_structure(path_).packing.size(), 60);
}

TEST_F(DamagedFile, RefusesTextsThatAreNotUtf8) {
    EXPECT_EQ(after([](hid_t id) { H5Lmove(id, "/mechanics", id, "/\xff", H5P_DEFAULT, H5P_DEFAULT); }),
              path_ + ": / holds an object whose name is not a text in UTF-8: the file is damaged");
    EXPECT_EQ(after([](hid_t id) { H5Lmove(id, "/\xff", id, "/two\nlines", H5P_DEFAULT, H5P_DEFAULT); }),
              path_ + ": / holds an object whose name is not a text in UTF-8: the file is damaged");
    const hid_t id = H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    H5Lmove(id, "/two\nlines", id, "/mechanics", H5P_DEFAULT, H5P_DEFAULT);
    const hid_t dataset = H5Dopen2(id, "/provenance/0001_generate/command_line", H5P_DEFAULT);
    const hid_t type = H5Dget_type(dataset);
    std::string text(H5Tget_size(type), '\xc0');
    H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data());
    H5Tclose(type);
    H5Dclose(dataset);
    H5Fclose(id);
    EXPECT_EQ(sentence<InputError>([&] { read_provenance(path_); }),
              path_ + ": /provenance/0001_generate/command_line holds a text that is not UTF-8: the file is damaged");
}

TEST_F(DamagedFile, BelievesSizesOnlyAsFarAsTheFileIsLong) {
    const hid_t id = H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
    const std::vector<hsize_t> chunk{1024};
    H5Pset_chunk(properties, 1, chunk.data());
    make_dataset(id, "/mechanics/huge", properties, {hsize_t{1} << 28});  // 2 GB without a byte of them in the file
    H5Pclose(properties);
    H5Fclose(id);
    EXPECT_EQ(sentence<InputError>([&] { read_results(path_, "/mechanics"); }),
              path_ + ": /mechanics/huge has an impossible size: the file is damaged");
    EXPECT_EQ(read_structure(path_).packing.size(), 60);
}

TEST_F(DamagedFile, AFileThatAnotherProgramWritesIsNotCalledDamaged) {
    const int held = open(path_.c_str(), O_RDWR);
    ASSERT_EQ(flock(held, LOCK_EX), 0);  // as HDF5 does
    EXPECT_EQ(sentence<InputError>([&] { read_structure(path_); }), path_ + " is open for writing in another program");
    close(held);
}

TEST_F(DamagedFile, NothingIsPrinted) {
    testing::internal::CaptureStderr();
    const std::string whole = read(path_);
    const std::string cut = write("cut.h5", whole.substr(0, whole.size() / 2));
    EXPECT_THROW(read_structure(cut), InputError);
    EXPECT_THROW(read_structure(file("absent.h5")), InputError);
    read_structure(path_);
    EXPECT_LT(H5Fopen(cut.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), 0);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

/// One byte replaced by another one, at places and by values that a fixed seed gives. Whatever it meets, the process survives.
TEST_F(DamagedFile, SingleBytes) {
    add_results(path_, path_, {{}, std::nullopt, {}, {}, stage("again")}, false);
    const std::string whole = read(path_);
    std::mt19937 random(20121);
    int refused = 0;
    for (int turn = 0; turn < 60; ++turn) {
        std::string damaged = whole;
        damaged[random() % whole.size()] = static_cast<char>(random());
        write("a.h5", damaged);
        const auto count_refusal = [&](const std::function<void()>& work) {
            try {
                work();
            } catch (const InputError& error) {
                ++refused;
                EXPECT_TRUE(std::string(error.what()).starts_with(path_)) << error.what();
            }
        };
        count_refusal([&] { EXPECT_TRUE(read_structure(path_).packing.positions.allFinite()); });
        count_refusal([&] { read_results(path_, "/"); });
        count_refusal([&] { add_to_copy(); });
    }
    EXPECT_GT(refused, 5);
}

}  // namespace
}  // namespace coagula::io
