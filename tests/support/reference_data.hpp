// Measured and reference data that lie beside the repository; tests that need them skip where they are absent.
#pragma once

#include <coagula/common/packing.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace coagula::testing {

inline std::string shared_data(const std::string& name) {
    return std::string(COAGULA_SHARED_DATA) + "/" + name;
}

inline bool have_shared_data(const std::string& name) {
    return std::filesystem::exists(shared_data(name));
}

/// Three columns of a CSV file with one header line, from column `first` on (3 x N); no columns if there is no such file.
inline Eigen::Matrix3Xd read_columns(const std::string& path, int first = 0) {
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    std::vector<double> values;
    while (std::getline(file, line)) {
        std::istringstream cells(line);
        std::string cell;
        for (int column = 0; std::getline(cells, cell, ','); ++column) {
            if (column >= first && column < first + 3) {
                values.push_back(std::stod(cell));
            }
        }
    }
    return Eigen::Map<const Eigen::Matrix3Xd>(values.data(), 3, static_cast<Index>(values.size() / 3));
}

/// One of the reference structures (N = 8000, radius 0.25 um, periodic cube); empty if the file is absent.
inline Packing reference_structure(const std::string& name) {
    Packing packing;
    packing.positions = read_columns(shared_data("reference_structures/" + name + ".csv"));
    packing.cell = Cell::periodic(Eigen::Vector3d::Constant(1.0939048394478881e-05));
    for (Index i = 0; i < packing.size(); ++i) {
        packing.positions.col(i) = packing.cell.wrap(packing.positions.col(i));
    }
    packing.radii = Eigen::VectorXd::Constant(packing.positions.cols(), 0.25e-6);
    return packing;
}

}  // namespace coagula::testing
