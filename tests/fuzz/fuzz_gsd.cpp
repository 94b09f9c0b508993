// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/gsd_file.hpp>

#include "packing_contract.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace coagula;
    return fuzz::read_packing_by(
        data, size, [](const std::string& path, const io::ImportOptions& options) { return io::read_gsd(path, options); });
}
