// SPDX-License-Identifier: GPL-3.0-or-later
// H5MD of another program through import; see hdf5_edits.hpp for what the input is.
#include <coagula/io/h5md_file.hpp>

#include "hdf5_edits.hpp"
#include "packing_contract.hpp"

namespace {

using namespace coagula;

/// Two frames whose elements all depend on time, with a unit and numbers of the particles.
std::string sound_file(const fuzz::InputFolder& folder) {
    Packing packing{Cell::periodic(Eigen::Vector3d(4e-6, 5e-6, 6e-6)), Eigen::Matrix3Xd(3, 4),
                    Eigen::VectorXd::Constant(4, 2.5e-7)};
    packing.positions << 1, 1.4, 1, 3, 1, 1, 1.4, 3, 1, 1, 1, 3;
    packing.positions *= 1e-6;
    io::Structure structure{packing, std::nullopt};
    structure.earlier.push_back({0.0, packing.positions});
    structure.time = 1;
    const std::string path = folder.write("sound.h5", "");
    io::write_structure(path, structure, {}, {},
                        {.stage = "import", .command_line = "", .options = "{}", .version = "", .time = "", .positions_sha256 = ""},
                        true);
    return fuzz::contents_of(path);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzz::InputFolder folder;
    static const std::string sound = sound_file(folder);
    const std::string path = folder.write("foreign.h5", sound);
    fuzz::Choices choices(data, size);
    fuzz::edit_hdf5(path, choices);
    for (const io::ImportOptions& options : fuzz::import_options()) {
        fuzz::expect_sound_packing(path, [&] { return io::read_h5md(path, options); });
    }
    return 0;
}
