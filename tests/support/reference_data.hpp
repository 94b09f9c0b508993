// SPDX-License-Identifier: GPL-3.0-or-later
// Measured and reference data: what the build unpacked from datasets/.
#pragma once

#include <coagula/common/packing.hpp>

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace coagula::testing {

/// The path of a file, such as "finney_pack/finney.csv".
inline std::string dataset(const std::string& name) {
    return std::string(COAGULA_DATASETS) + "/" + name;
}

/// Opens a file of a data set. Throws std::runtime_error naming it when that fails.
inline std::ifstream open_dataset(const std::string& path) {
    std::ifstream file(path);
    if (!file) {
        throw std::runtime_error("cannot read " + path);
    }
    return file;
}

/// Three columns of a CSV file with one header line, from column `first` on (3 x N).
inline Eigen::Matrix3Xd read_columns(const std::string& path, int first = 0) {
    std::ifstream file = open_dataset(path);
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

/// One of the reference structures (N = 8000, radius 0.25 um, periodic cube).
inline Packing reference_structure(const std::string& name) {
    Packing packing;
    packing.positions = read_columns(dataset("reference_structures/" + name + ".csv"));
    packing.cell = Cell::periodic(Eigen::Vector3d::Constant(1.0939048394478881e-05));
    for (Index i = 0; i < packing.size(); ++i) {
        packing.positions.col(i) = packing.cell.wrap(packing.positions.col(i));
    }
    packing.radii = Eigen::VectorXd::Constant(packing.positions.cols(), 0.25e-6);
    return packing;
}

}  // namespace coagula::testing
