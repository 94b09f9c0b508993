// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/structure_file.hpp>

#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/resource.h>

#include <csignal>

#include "example_packing.hpp"
#include "temporary_folder.hpp"

namespace coagula::io {
namespace {

Provenance example_provenance(const std::string& stage) {
    return {stage, "coagula " + stage + " --seed 3", R"({"seed": 3})", 3, "0.1.0+abc", "2000-01-01T00:00:00Z", 1.25, ""};
}

using StructureFile = TemporaryFolder;

void expect_equal(const ContactNetwork& found, const ContactNetwork& wanted) {
    EXPECT_EQ(found.particles, wanted.particles);
    EXPECT_EQ(found.ends, wanted.ends);
    EXPECT_EQ(found.branch, wanted.branch);
}

TEST_F(StructureFile, RoundTripLosesAtMostARounding) {
    for (const bool periodic : {true, false}) {
        for (const Index particles : {1, 2, 7, 1000}) {
            const Packing packing = example_packing(particles, periodic);
            write_structure(file("a.h5"), {packing, std::nullopt}, {}, {}, example_provenance("generate"), true);
            const Structure found = read_structure(file("a.h5"));
            EXPECT_FALSE(found.bonds);
            EXPECT_EQ(found.packing.cell.is_periodic(), periodic);
            ASSERT_EQ(found.packing.size(), particles);
            const double rounding = 2.3e-16;
            EXPECT_LE((found.packing.positions - packing.positions).cwiseQuotient(packing.positions).cwiseAbs().maxCoeff(),
                      rounding);
            EXPECT_LE((found.packing.radii - packing.radii).cwiseQuotient(packing.radii).cwiseAbs().maxCoeff(), rounding);
            EXPECT_LE((found.packing.cell.lengths() - packing.cell.lengths()).cwiseAbs().maxCoeff(), rounding * 4.1e-6);
            EXPECT_LE((found.packing.cell.origin() - packing.cell.origin()).cwiseAbs().maxCoeff(), rounding * 1.3e-6);
        }
    }
}

TEST_F(StructureFile, SecondRoundTripIsExact) {
    const Packing packing = example_packing(1000, true);
    write_structure(file("a.h5"), {packing, std::nullopt}, {}, {}, example_provenance("generate"), true);
    const Packing once = read_structure(file("a.h5")).packing;
    write_structure(file("b.h5"), {once, std::nullopt}, {}, {}, example_provenance("generate"), true);
    const Packing twice = read_structure(file("b.h5")).packing;
    EXPECT_EQ(once.positions, twice.positions);
    EXPECT_EQ(once.radii, twice.radii);
    EXPECT_EQ(once.cell.edges(), twice.cell.edges());
    EXPECT_EQ(positions_sha256(packing), positions_sha256(once));
    EXPECT_EQ(positions_sha256(packing), positions_sha256(twice));
}

TEST_F(StructureFile, RoundTripKeepsPositionsAtTheEdgeInsideTheBox) {
    const double length = 3.1e-6;
    Packing packing{Cell::periodic(Eigen::Vector3d::Constant(length)), Eigen::Matrix3Xd(3, 400),
                    Eigen::VectorXd::Constant(400, 1e-8)};
    for (Index i = 0; i < packing.size(); ++i) {  // doubles just below the edge, one after the other
        const double below = i == 0 ? length : std::nextafter(packing.positions(0, i - 1), 0.0);
        packing.positions.col(i) << below, 7e-9 * static_cast<double>(i), 1e-6;
    }
    const std::string before = positions_sha256(packing);
    write_structure(file("a.h5"), {packing, std::nullopt}, {}, {}, example_provenance("generate"), true);
    const Packing found = read_structure(file("a.h5")).packing;
    EXPECT_TRUE((found.positions.array() >= 0).all());
    EXPECT_TRUE((found.positions.row(0).array() < found.cell.lengths()[0]).all());
    EXPECT_EQ(positions_sha256(found), before);
    for (Index i = 0; i < packing.size(); ++i) {
        EXPECT_LE(packing.cell.minimum_image(found.positions.col(i) - packing.positions.col(i)).norm(), 5e-16 * length);
    }
}

TEST_F(StructureFile, ShaIsThatOfTheStoredBytes) {
    // printf of the bytes of (1000, 2000, 3000) as little-endian doubles through sha256sum
    const Packing packing{Cell::open(Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(1e-5)), Eigen::Vector3d(1e-6, 2e-6, 3e-6),
                          Eigen::VectorXd::Constant(1, 1e-7)};
    EXPECT_EQ(positions_sha256(packing), "0562c7e597d6332a17aee7d4bf5586affa41e4acd7a0aeaefa58282b6700f32f");
}

TEST_F(StructureFile, BondsComeBackExactly) {
    for (const Index particles : {1, 8, 500}) {
        const Packing packing = example_packing(particles, true);
        const ContactNetwork bonds = find_contacts(packing, particles < 100 ? 1.0 : 0.1);
        write_structure(file("a.h5"), {packing, bonds}, {}, {}, example_provenance("generate"), true);
        const Structure found = read_structure(file("a.h5"));
        ASSERT_TRUE(found.bonds);
        expect_equal(*found.bonds, bonds);
    }
}

std::vector<Dataset> example_results() {
    return {scalar("/characterization/doh/a", 0.4567, "1", "width"),
            integer("/characterization/doh/points", 12, "number of points"),
            text("/characterization/doh/model", "1 - erf", "the law"),
            text("/characterization/empty", "", "an empty text"),
            vector("/characterization/pores/radius", Eigen::VectorXd::LinSpaced(1000, 0, 1e-6), "m", "radii"),
            vector("/characterization/pores/none", Eigen::VectorXd(), "m", "nothing"),
            integers("/characterization/counts", Eigen::Vector3i(1, -2, 3), "counts"),
            columns("/characterization/columns", Eigen::MatrixXd{{1, 2}, {3, 4}, {5, 6}}, "m", "two columns"),
            matrix("/mechanics/linear/matrix", Eigen::MatrixXd{{1, 2}, {3, 4}, {5, 6}}, "Pa", "three rows")};
}

TEST_F(StructureFile, ResultsComeBack) {
    const auto written = example_results();
    write_structure(file("a.h5"), {example_packing(5, true), std::nullopt}, {}, written, example_provenance("generate"), false);
    auto found = read_results(file("a.h5"), "/characterization");
    const auto mechanics = read_results(file("a.h5"), "/mechanics");
    found.insert(found.end(), mechanics.begin(), mechanics.end());
    ASSERT_EQ(found.size(), written.size());
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end() - 1, [](const auto& a, const auto& b) { return a.path < b.path; }));
    for (const Dataset& wanted : written) {
        const auto same = std::find_if(found.begin(), found.end(), [&](const Dataset& d) { return d.path == wanted.path; });
        ASSERT_NE(same, found.end()) << wanted.path;
        EXPECT_EQ(same->shape, wanted.shape) << wanted.path;
        EXPECT_EQ(same->values, wanted.values) << wanted.path;
        EXPECT_EQ(same->unit, wanted.unit);
        EXPECT_EQ(same->description, wanted.description);
    }
    EXPECT_EQ(std::get<std::vector<double>>(mechanics[0].values), (std::vector<double>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(mechanics[0].shape, (std::vector<std::size_t>{3, 2}));
    EXPECT_EQ(read_results(file("a.h5"), "/characterization/doh/a").size(), 1U);
    EXPECT_TRUE(read_results(file("a.h5"), "/diagnosis").empty());
}

TEST_F(StructureFile, AddResultsReplacesGroupsAndKeepsTheRest) {
    const Packing packing = example_packing(100, true);
    const ContactNetwork bonds = find_contacts(packing, 0.1);
    write_structure(file("a.h5"), {packing, std::nullopt}, {}, example_results(), example_provenance("generate vem"), false);
    const std::string sha = positions_sha256(packing);
    add_results(file("a.h5"), file("a.h5"),
                {{"/characterization/doh"},
                 bonds,
                 {{"order", packing.radii.transpose(), "m", "a field"}},
                 {scalar("/characterization/doh/b", 0.5, "1", "shift"), scalar("/diagnosis/x", 1, "1", "new")},
                 example_provenance("shear/linear")},
                false);
    const auto found = read_results(file("a.h5"), "/characterization");
    EXPECT_EQ(std::count_if(found.begin(), found.end(), [](const auto& d) { return d.path.starts_with("/characterization/doh"); }),
              1);
    EXPECT_EQ(found.size(), 6U);
    EXPECT_EQ(read_results(file("a.h5"), "/mechanics").size(), 1U);
    EXPECT_EQ(read_results(file("a.h5"), "/diagnosis").size(), 1U);
    const Structure structure = read_structure(file("a.h5"));
    ASSERT_TRUE(structure.bonds);
    expect_equal(*structure.bonds, bonds);
    EXPECT_EQ(positions_sha256(structure.packing), sha);
    const auto fields = read_results(file("a.h5"), "/VTKHDF/PointData");
    ASSERT_EQ(fields.size(), 3U);
    const Eigen::VectorXi counts = contact_counts(bonds);
    EXPECT_EQ(std::get<std::vector<std::int64_t>>(fields[0].values), std::vector<std::int64_t>(counts.begin(), counts.end()));
    EXPECT_EQ(fields[1].path, "/VTKHDF/PointData/order");
    EXPECT_EQ(entries(), std::vector<std::string>{"a.h5"});
}

TEST_F(StructureFile, AddResultsToAnotherFileLeavesTheSource) {
    write_structure(file("a.h5"), {example_packing(9, false), std::nullopt}, {}, {}, example_provenance("import"), false);
    const std::string before = read(file("a.h5"));
    const auto add = [&](bool overwrite) {
        add_results(file("a.h5"), file("b.h5"),
                    {{}, std::nullopt, {}, {scalar("/mechanics/x", 1, "1", "new")}, example_provenance("shear")}, overwrite);
    };
    add(false);
    EXPECT_EQ(read(file("a.h5")), before);
    EXPECT_EQ(read_results(file("b.h5"), "/mechanics").size(), 1U);
    EXPECT_EQ(sentence<InputError>([&] { add(false); }), file("b.h5") + " exists already; give --force to overwrite it");
    add(true);
}

TEST_F(StructureFile, AddResultsKeepsWhatItDoesNotKnow) {
    const Packing packing = example_packing(20, true);
    write_structure(file("a.h5"), {packing, find_contacts(packing, 0.5)}, {}, {}, example_provenance("generate"), false);
    {
        const hid_t id = H5Fopen(file("a.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
        const hid_t space = H5Screate(H5S_SCALAR);
        const hid_t root = H5Gopen2(id, "/", H5P_DEFAULT);
        const hid_t attribute = H5Acreate2(root, "laboratory", H5T_NATIVE_INT, space, H5P_DEFAULT, H5P_DEFAULT);
        const int value = 42;
        H5Awrite(attribute, H5T_NATIVE_INT, &value);
        H5Aclose(attribute);
        H5Gclose(root);
        const hid_t group = H5Gcreate2(id, "/foreign", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
        H5Lcreate_soft("/particles/trajectory", group, "soft", H5P_DEFAULT, H5P_DEFAULT);
        H5Lcreate_hard(id, "/particles/trajectory/radius", group, "hard", H5P_DEFAULT, H5P_DEFAULT);
        H5Gclose(group);
        H5Sclose(space);
        H5Fclose(id);
    }
    for (int turn = 0; turn < 2; ++turn) {
        add_results(file("a.h5"), file("a.h5"), {{}, std::nullopt, {}, {}, example_provenance("shear")}, false);
    }
    const hid_t id = H5Fopen(file("a.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    int value = 0;
    const hid_t attribute = H5Aopen_by_name(id, "/", "laboratory", H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(H5Aread(attribute, H5T_NATIVE_INT, &value), 0);
    EXPECT_EQ(value, 42);
    H5Aclose(attribute);
    EXPECT_GT(H5Oexists_by_name(id, "/foreign/soft", H5P_DEFAULT), 0);
    H5O_info_t hard{};
    H5O_info_t radius{};
    H5Oget_info_by_name2(id, "/foreign/hard", &hard, H5O_INFO_BASIC, H5P_DEFAULT);
    H5Oget_info_by_name2(id, "/particles/trajectory/radius", &radius, H5O_INFO_BASIC, H5P_DEFAULT);
    EXPECT_EQ(hard.addr, radius.addr) << "hard links must stay one object";
    const hid_t bonds = H5Dopen2(id, "/connectivity/bonds", H5P_DEFAULT);
    const hid_t referring = H5Aopen(bonds, "particles_group", H5P_DEFAULT);
    hobj_ref_t reference{};
    H5Aread(referring, H5T_STD_REF_OBJ, &reference);
    const hid_t group = H5Rdereference2(bonds, H5P_DEFAULT, H5R_OBJECT, &reference);
    ASSERT_GE(group, 0);
    H5O_info_t referred{};
    H5O_info_t trajectory{};
    H5Oget_info2(group, &referred, H5O_INFO_BASIC);
    H5Oget_info_by_name2(id, "/particles/trajectory", &trajectory, H5O_INFO_BASIC, H5P_DEFAULT);
    EXPECT_EQ(referred.addr, trajectory.addr) << "the reference must lead to the group of the copy";
    H5Gclose(group);
    H5Aclose(referring);
    H5Dclose(bonds);
    H5Fclose(id);
}

TEST_F(StructureFile, ProvenanceIsAHistory) {
    Provenance first = example_provenance("generate vem");
    first.positions_sha256 = "abc";
    write_structure(file("a.h5"), {example_packing(3, true), std::nullopt}, {}, {}, first, false);
    for (int i = 0; i < 11; ++i) {
        add_results(file("a.h5"), file("a.h5"), {{}, std::nullopt, {}, {}, example_provenance("stage " + std::to_string(i))},
                    false);
    }
    const auto history = read_provenance(file("a.h5"));
    ASSERT_EQ(history.size(), 12U);
    EXPECT_EQ(history[0].stage, "generate vem");
    EXPECT_EQ(history[11].stage, "stage 10");
    EXPECT_EQ(history[0].command_line, "coagula generate vem --seed 3");
    EXPECT_EQ(history[0].options, R"({"seed": 3})");
    EXPECT_EQ(history[0].seed, 3);
    EXPECT_EQ(history[0].version, "0.1.0+abc");
    EXPECT_EQ(history[0].time, "2000-01-01T00:00:00Z");
    EXPECT_EQ(history[0].seconds, 1.25);
    EXPECT_EQ(history[0].positions_sha256, "abc");
}

TEST_F(StructureFile, EqualInputGivesEqualBytes) {
    const Packing packing = example_packing(2000, true);
    for (const char* name : {"a.h5", "b.h5"}) {
        write_structure(file(name), {packing, find_contacts(packing, 0.1)}, {{"radii", packing.radii.transpose(), "m", ""}},
                        example_results(), example_provenance("generate"), false);
        add_results(file(name), file(name), {{}, std::nullopt, {}, example_results(), example_provenance("again")}, false);
    }
    EXPECT_EQ(read(file("a.h5")), read(file("b.h5")));
    const std::size_t once = read(file("a.h5")).size();
    add_results(file("a.h5"), file("a.h5"),
                {{"/characterization"}, std::nullopt, {}, example_results(), example_provenance("more")}, false);
    EXPECT_LT(read(file("a.h5")).size(), once + 30000) << "replaced groups must not leave their space behind";
}

TEST_F(StructureFile, RefusesTargets) {
    const Structure structure{example_packing(3, true), std::nullopt};
    const auto save = [&](const std::string& path, bool overwrite) {
        write_structure(path, structure, {}, {}, example_provenance("generate"), overwrite);
    };
    const std::string old = write("old.h5", "old contents");
    EXPECT_EQ(sentence<InputError>([&] { save(old, false); }), old + " exists already; give --force to overwrite it");
    EXPECT_EQ(read(old), "old contents");
    EXPECT_EQ(sentence<InputError>([&] { save(folder_.string(), true); }),
              "cannot write " + folder_.string() + ": it is not a regular file");
    EXPECT_EQ(sentence<InputError>([&] { save(file("none/a.h5"), true); }),
              "cannot write " + file("none/a.h5") + ": there is no folder " + file("none"));
    EXPECT_EQ(sentence<InputError>([&] { save("/dev/full", true); }), "cannot write /dev/full: it is not a regular file");
    EXPECT_THROW(save("", true), InputError);
    save(old, true);
    EXPECT_EQ(read_structure(old).packing.size(), 3);
}

TEST_F(StructureFile, OverwritesBehindASymbolicLink) {
    write("real.h5", "old");
    std::filesystem::create_symlink("real.h5", file("link.h5"));
    write_structure(file("link.h5"), {example_packing(3, true), std::nullopt}, {}, {}, example_provenance("generate"), true);
    EXPECT_TRUE(std::filesystem::is_symlink(file("link.h5")));
    EXPECT_EQ(read_structure(file("real.h5")).packing.size(), 3);
}

/// While it lives no file can grow beyond a few bytes: what a full disk looks like from inside.
class FullDisk {
public:
    explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &before_);
        rlimit limit = before_;
        limit.rlim_cur = bytes;
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FullDisk() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;

private:
    rlimit before_{};
    void (*handler_)(int);
};

TEST_F(StructureFile, FullDiskLeavesTheOldFileAndNothingElse) {
    const Structure structure{example_packing(2000, true), std::nullopt};
    write_structure(file("a.h5"), structure, {}, {}, example_provenance("generate"), false);
    const std::string before = read(file("a.h5"));
    for (const rlim_t room : std::initializer_list<rlim_t>{0, 100, 5000, 50000}) {
        const FullDisk full(room);
        EXPECT_EQ(sentence<std::runtime_error>(
                      [&] { write_structure(file("a.h5"), structure, {}, {}, example_provenance("generate"), true); }),
                  "cannot write " + file("a.h5") + ": File too large");
        EXPECT_THROW(add_results(file("a.h5"), file("a.h5"), {{}, std::nullopt, {}, {}, example_provenance("shear")}, false),
                     std::runtime_error);
        EXPECT_THROW(write_structure(file("new.h5"), structure, {}, {}, example_provenance("generate"), true), std::runtime_error);
    }
    EXPECT_EQ(read(file("a.h5")), before);
    EXPECT_EQ(entries(), std::vector<std::string>{"a.h5"});
}

TEST_F(StructureFile, RefusesWhatIsNotAPackingOrResult) {
    const Packing good = example_packing(4, true);
    const auto save = [&](const Packing& packing, const std::vector<ParticleField>& fields, const std::vector<Dataset>& results) {
        write_structure(file("a.h5"), {packing, std::nullopt}, fields, results, example_provenance("generate"), false);
    };
    Packing bad = good;
    bad.positions(1, 2) = unset;
    EXPECT_THROW(save(bad, {}, {}), std::invalid_argument);
    EXPECT_THROW(save(good, {{"short", Eigen::MatrixXd::Zero(1, 3), "1", ""}}, {}), std::invalid_argument);
    EXPECT_THROW(save(good, {{"a/b", Eigen::MatrixXd::Zero(1, 4), "1", ""}}, {}), std::invalid_argument);
    EXPECT_THROW(save(good, {}, {scalar("relative", 1, "1", "")}), std::invalid_argument);
    EXPECT_THROW(save(good, {}, {Dataset{"/x", {3}, std::vector<double>{1, 2}, "1", ""}}), std::invalid_argument);
    EXPECT_TRUE(entries().empty());
}

}  // namespace
}  // namespace coagula::io
