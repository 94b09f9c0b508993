// SPDX-License-Identifier: GPL-3.0-or-later
// Structure, results and history of an HDF5 file; see hdf5_edits.hpp for what the input is.
#include <coagula/io/structure_file.hpp>

#include "hdf5_edits.hpp"

namespace {

using namespace coagula;

/// A small file as the program writes it.
std::string sound_file(const fuzz::InputFolder& folder) {
    Packing packing{Cell::periodic(Eigen::Vector3d(4e-6, 5e-6, 6e-6)), Eigen::Matrix3Xd(3, 4),
                    Eigen::VectorXd::Constant(4, 2.5e-7)};
    packing.positions << 1, 1.4, 1, 3, 1, 1, 1.4, 3, 1, 1, 1, 3;
    packing.positions *= 1e-6;
    const std::string path = folder.write("sound.h5", "");
    io::write_structure(path, {packing, find_contacts(packing, 0.01)}, {{"load", Eigen::MatrixXd::Ones(1, 4), "N", "a force"}},
                        {io::scalar("/mechanics/linear/storage_modulus/mean", 1e6, "Pa", "a modulus"),
                         io::vector("/characterization/curve", Eigen::VectorXd::LinSpaced(5, 0, 1), "1", "a curve"),
                         io::text("/mechanics/linear/solver", "direct", "a text")},
                        {.stage = "generate vem",
                         .command_line = "coagula generate vem",
                         .options = "{}",
                         .seed = 1,
                         .version = "",
                         .time = "",
                         .positions_sha256 = ""},
                        true);
    return fuzz::contents_of(path);
}

void check_structure(const std::string& path) {
    const io::Structure structure = io::read_structure(path);
    check(structure.packing);
    fuzz::expect(structure.packing.cell.lengths().allFinite(), "the box is not finite");
    if (structure.bonds) {
        fuzz::expect(structure.bonds->branch.allFinite(), "a bond is not finite");
        fuzz::expect(structure.bonds->branch.cols() == structure.bonds->ends.cols(), "bonds and their vectors are not as many");
        for (const std::int32_t end : structure.bonds->ends.reshaped()) {
            fuzz::expect(end >= 0 && end < structure.packing.size(), "a bond ends at no particle");
        }
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzz::InputFolder folder;
    static const std::string sound = sound_file(folder);
    const std::string path = folder.write("structure.h5", sound);
    fuzz::Choices choices(data, size);
    fuzz::edit_hdf5(path, choices);
    fuzz::expect_value_or_sentence(path, [&] { check_structure(path); });
    fuzz::expect_value_or_sentence(path, [&] { io::read_provenance(path); });
    fuzz::expect_value_or_sentence(path, [&] {
        for (const io::Dataset& dataset : io::read_results(path, "/")) {
            std::size_t count = 1;
            for (const std::size_t length : dataset.shape) {
                count *= length;
            }
            const auto* numbers = std::get_if<std::vector<double>>(&dataset.values);
            fuzz::expect(numbers == nullptr || numbers->size() == count,
                         dataset.path + " has not as many values as its shape says");
        }
    });
    return 0;
}
