// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/dataset.hpp>

#include <utility>

namespace coagula::dataset {

namespace {

std::size_t extent(Eigen::Index length) {
    return static_cast<std::size_t>(length);
}

}  // namespace

Dataset scalar(std::string path, double value, std::string unit, std::string description) {
    return {std::move(path), {}, std::vector<double>{value}, std::move(unit), std::move(description)};
}

Dataset integer(std::string path, std::int64_t value, std::string description) {
    return {std::move(path), {}, std::vector<std::int64_t>{value}, "1", std::move(description)};
}

Dataset text(std::string path, std::string value, std::string description) {
    return {std::move(path), {}, std::move(value), "1", std::move(description)};
}

Dataset vector(std::string path, const Eigen::VectorXd& values, std::string unit, std::string description) {
    return {std::move(path),
            {extent(values.size())},
            std::vector<double>(values.begin(), values.end()),
            std::move(unit),
            std::move(description)};
}

Dataset integers(std::string path, const Eigen::VectorXi& values, std::string description) {
    return {std::move(path),
            {extent(values.size())},
            std::vector<std::int64_t>(values.begin(), values.end()),
            "1",
            std::move(description)};
}

Dataset columns(std::string path, const Eigen::MatrixXd& values, std::string unit, std::string description) {
    return {std::move(path),
            {extent(values.cols()), extent(values.rows())},
            std::vector<double>(values.data(), values.data() + values.size()),
            std::move(unit),
            std::move(description)};
}

Dataset matrix(std::string path, const Eigen::MatrixXd& values, std::string unit, std::string description) {
    return columns(std::move(path), values.transpose(), std::move(unit), std::move(description));
}

}  // namespace coagula::dataset
