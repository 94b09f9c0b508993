// What the fuzz targets of all text formats with coordinates ask of a packing.
#pragma once

#include <coagula/io/text_formats.hpp>

#include "reader_contract.hpp"

#include <array>

namespace coagula::fuzz {

/// Without options, as an open set with radius and unit, and in a given box.
inline std::array<io::ImportOptions, 3> import_options() {
    return {io::ImportOptions{}, io::ImportOptions{.radius = 0.25, .box = {}, .open = true, .length_unit = 1.0},
            io::ImportOptions{.radius = {}, .box = Eigen::Vector3d(10, 11, 12), .length_unit = 1e-6, .wrap = true}};
}

inline int read_packing(const std::uint8_t* data, std::size_t size, io::TextFormat format) {
    const std::string path = input_file(data, size, "packing");
    for (const io::ImportOptions& options : import_options()) {
        expect_value_or_sentence(path, [&] {
            const Packing packing = io::read_text(path, format, options);
            check(packing);
            expect(packing.cell.lengths().allFinite() && packing.cell.origin().allFinite(), "the box is not finite");
            const double fraction = volume_fraction(packing);
            expect(fraction > 0 && fraction <= 1, "the volume fraction is " + to_text(fraction));
        });
    }
    return 0;
}

}  // namespace coagula::fuzz
