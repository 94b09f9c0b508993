// SPDX-License-Identifier: GPL-3.0-or-later
#include "low_rank.hpp"

#include <utility>

namespace coagula::diagnose {

Belonging::Belonging(std::vector<Index> in_sample, Index sample_count, const std::vector<std::size_t>& in_group, std::size_t groups)
    : sample(std::move(in_sample)), samples(sample_count), rows(groups) {
    for (std::size_t row = 0; row < in_group.size(); ++row) {
        rows[in_group[row]].push_back(static_cast<Index>(row));
    }
}

NormalEffects::NormalEffects(std::shared_ptr<const Belonging> belonging, const Eigen::VectorXd& numbers,
                             const Eigen::VectorXd& level, const Eigen::MatrixXd& others)
    : belonging_(std::move(belonging)), others_(others), products_(belonging_->rows.size()) {
    const Index samples = belonging_->samples;
    for (std::size_t group = 0; group < products_.size(); ++group) {
        Products& products = products_[group];
        products.own.resize(samples);
        products.between.resize(samples, others.cols());
        products.right.resize(samples + others.cols());
        const Eigen::MatrixXd own = others(belonging_->rows[group], Eigen::all);
        products.rest = own.transpose() * own;
    }
    replace(numbers, level);
}

void NormalEffects::replace(const Eigen::VectorXd& numbers, const Eigen::VectorXd& level) {
    numbers_ = numbers;
    level_ = level;
    for (std::size_t number = 0; number < products_.size(); ++number) {
        Products& products = products_[number];
        products.own.setZero();
        products.between.setZero();
        products.right.setZero();
        for (const Index row : belonging_->rows[number]) {
            products.right.tail(others_.cols()) += numbers[row] * others_.row(row).transpose();
            if (const Index one = belonging_->sample[static_cast<std::size_t>(row)]; one >= 0) {
                products.own[one] += level[row] * level[row];
                products.right[one] += level[row] * numbers[row];
                products.between.row(one) += level[row] * others_.row(row);
            }
        }
    }
}

NormalEffects::NormalEffects(const Eigen::VectorXd& numbers, const Eigen::MatrixXd& others)
    : NormalEffects(std::make_shared<Belonging>(std::vector<Index>(static_cast<std::size_t>(numbers.size()), -1), 0,
                                                std::vector<std::size_t>(static_cast<std::size_t>(numbers.size()), 0), 1),
                    numbers, Eigen::VectorXd::Zero(numbers.size()), others) {}

void NormalEffects::solve(double effect, const Eigen::VectorXd& scales, const std::vector<double>& variances) {
    const Index samples = belonging_->samples;
    const Index count = others_.cols();
    deviation_.resize(samples + count);
    deviation_ << Eigen::VectorXd::Constant(samples, effect), scales;
    own_.setOnes(samples);
    between_.setZero(samples, count);
    precision_.setZero(count, count);
    right_.setZero(samples + count);
    for (std::size_t group = 0; group < products_.size(); ++group) {
        const Products& products = products_[group];
        const double weight = 1 / variances[group];
        own_ += weight * effect * effect * products.own;
        between_ += weight * effect * products.between;
        precision_ += weight * products.rest;
        right_ += weight * products.right;
    }
    between_ *= scales.asDiagonal();
    right_.array() *= deviation_.array();
    log_determinant_ = own_.array().log().sum();
    effects_.resize(samples + count);
    if (count > 0) {
        eliminated_ = own_.cwiseInverse().asDiagonal() * between_;
        precision_.array() *= (scales * scales.transpose()).array();
        precision_.diagonal().array() += 1;
        precision_ -= between_.transpose().lazyProduct(eliminated_);  // a few rows: packing them takes longer
        rest_.compute(precision_);
        log_determinant_ += 2 * rest_.matrixLLT().diagonal().array().log().sum();
        effects_.tail(count) = rest_.solve(right_.tail(count) - eliminated_.transpose() * right_.head(samples));
    }
    effects_.head(samples) = (right_.head(samples) - between_ * effects_.tail(count)).cwiseQuotient(own_);
    square_what_is_left(variances);
}

void NormalEffects::square_what_is_left(const std::vector<double>& variances) {
    const Eigen::VectorXd moved = deviation_.cwiseProduct(effects_);
    left_ = numbers_ - others_.lazyProduct(moved.tail(others_.cols()));  // rows of a few numbers
    squares_.assign(products_.size(), 0.0);
    misfit_ = effects_.squaredNorm();
    for (std::size_t group = 0; group < squares_.size(); ++group) {
        double sum = 0;
        for (const Index row : belonging_->rows[group]) {
            const Index sample = belonging_->sample[static_cast<std::size_t>(row)];
            const double each = left_[row] - (sample >= 0 ? level_[row] * moved[sample] : 0.0);
            sum += each * each;
        }
        squares_[group] = sum;
        misfit_ += sum / variances[group];
    }
}

Eigen::MatrixXd NormalEffects::covariance() const {
    const Index samples = own_.size();
    const Index others = others_.cols();
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(samples + others, samples + others);
    all.topLeftCorner(samples, samples).diagonal() = own_.cwiseInverse();
    if (others > 0) {
        const Eigen::MatrixXd eliminated = own_.cwiseInverse().asDiagonal() * between_;
        const Eigen::MatrixXd rest = rest_.solve(Eigen::MatrixXd::Identity(others, others));
        all.topLeftCorner(samples, samples) += eliminated * rest * eliminated.transpose();
        all.topRightCorner(samples, others) = -eliminated * rest;
        all.bottomLeftCorner(others, samples) = all.topRightCorner(samples, others).transpose();
        all.bottomRightCorner(others, others) = rest;
    }
    return all;
}

std::vector<double> NormalEffects::expected_squares() const {
    const Index samples = own_.size();
    const Index others = others_.cols();
    const Eigen::MatrixXd open = covariance();
    const Eigen::VectorXd own = open.diagonal().head(samples).cwiseProduct(deviation_.head(samples).cwiseAbs2());
    const Eigen::MatrixXd between =
        deviation_.head(samples).asDiagonal() * open.topRightCorner(samples, others) * deviation_.tail(others).asDiagonal();
    const Eigen::MatrixXd rest =
        deviation_.tail(others).asDiagonal() * open.bottomRightCorner(others, others) * deviation_.tail(others).asDiagonal();
    std::vector<double> squares = squares_;
    for (std::size_t group = 0; group < squares.size(); ++group) {
        const Products& products = products_[group];
        squares[group] +=
            own.dot(products.own) + 2 * between.cwiseProduct(products.between).sum() + rest.cwiseProduct(products.rest).sum();
    }
    return squares;
}

}  // namespace coagula::diagnose
