// SPDX-License-Identifier: GPL-3.0-or-later
// Results as named arrays with unit and meaning: the value that stages hand to whoever writes files, JSON or pages.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace coagula {

/// A named array with unit and meaning. `path` is absolute in the file, such as "/characterization/doh/a".
/// An empty shape is a scalar; values are stored in C order (last index fastest).
struct Dataset {
    std::string path;
    std::vector<std::size_t> shape;
    std::variant<std::vector<double>, std::vector<std::int64_t>, std::string> values;
    std::string unit;  ///< UDUNITS text, "1" for pure numbers
    std::string description;
};

/// One value (or vector) per particle, shown by ParaView and OVITO too. Values are d x N.
struct ParticleField {
    std::string name;
    Eigen::MatrixXd values;
    std::string unit;
    std::string description;
};

/// One number per bond, shown by ParaView on the lines of the bonds; single precision. Values are M.
struct BondField {
    std::string name;
    Eigen::VectorXd values;
    std::string unit;
    std::string description;
};

/// Datasets of the usual shapes.
namespace dataset {

Dataset scalar(std::string path, double value, std::string unit, std::string description);
Dataset integer(std::string path, std::int64_t value, std::string description);
Dataset text(std::string path, std::string value, std::string description);
Dataset vector(std::string path, const Eigen::VectorXd& values, std::string unit, std::string description);
Dataset integers(std::string path, const Eigen::VectorXi& values, std::string description);
/// A d x N matrix of columns is stored as [N][d].
Dataset columns(std::string path, const Eigen::MatrixXd& values, std::string unit, std::string description);
/// A matrix as it stands, [rows][cols].
Dataset matrix(std::string path, const Eigen::MatrixXd& values, std::string unit, std::string description);

}  // namespace dataset

}  // namespace coagula
