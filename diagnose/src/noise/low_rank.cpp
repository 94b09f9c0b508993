#include "low_rank.hpp"

#include <utility>

namespace coagula::diagnose {

NormalEffects::NormalEffects(const Eigen::VectorXd& numbers, const Eigen::VectorXd& level, std::vector<Index> sample, Index samples,
                             const Eigen::MatrixXd& others, std::vector<std::size_t> group, std::size_t groups)
    : sample_(std::move(sample)), group_(std::move(group)), others_(others), rows_(groups), products_(groups) {
    for (Products& products : products_) {
        products.own.resize(samples);
        products.between.resize(samples, others.cols());
        products.right.resize(samples + others.cols());
    }
    for (Index row = 0; row < others.rows(); ++row) {
        rows_[group_[static_cast<std::size_t>(row)]].push_back(row);
    }
    for (std::size_t number = 0; number < groups; ++number) {
        const Eigen::MatrixXd own = others(rows_[number], Eigen::all);
        products_[number].rest = own.transpose() * own;
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
        for (const Index row : rows_[number]) {
            products.right.tail(others_.cols()) += numbers[row] * others_.row(row).transpose();
            if (const Index one = sample_[static_cast<std::size_t>(row)]; one >= 0) {
                products.own[one] += level[row] * level[row];
                products.right[one] += level[row] * numbers[row];
                products.between.row(one) += level[row] * others_.row(row);
            }
        }
    }
}

NormalEffects::NormalEffects(const Eigen::VectorXd& numbers, const Eigen::MatrixXd& others)
    : NormalEffects(numbers, Eigen::VectorXd::Zero(numbers.size()),
                    std::vector<Index>(static_cast<std::size_t>(numbers.size()), -1), 0, others,
                    std::vector<std::size_t>(static_cast<std::size_t>(numbers.size()), 0), 1) {}

void NormalEffects::solve(double effect, const Eigen::VectorXd& scales, const std::vector<double>& variances) {
    const Index samples = products_.front().own.size();
    const Index count = others_.cols();
    deviation_.resize(samples + count);
    deviation_ << Eigen::VectorXd::Constant(samples, effect), scales;
    own_.setOnes(samples);
    between_.setZero(samples, count);
    Eigen::MatrixXd rest = Eigen::MatrixXd::Zero(count, count);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(samples + count);
    for (std::size_t group = 0; group < products_.size(); ++group) {
        const Products& products = products_[group];
        const double weight = 1 / variances[group];
        own_ += weight * effect * effect * products.own;
        between_ += weight * effect * products.between;
        rest += weight * products.rest;
        right += weight * products.right;
    }
    between_ *= scales.asDiagonal();
    right.array() *= deviation_.array();
    log_determinant_ = own_.array().log().sum();
    effects_.resize(samples + count);
    if (count > 0) {
        const Eigen::MatrixXd eliminated = own_.cwiseInverse().asDiagonal() * between_;
        rest = scales.asDiagonal() * rest * scales.asDiagonal();
        rest.diagonal().array() += 1;
        rest.noalias() -= between_.transpose() * eliminated;
        rest_.compute(rest);
        log_determinant_ += 2 * rest_.matrixLLT().diagonal().array().log().sum();
        effects_.tail(count) = rest_.solve(right.tail(count) - eliminated.transpose() * right.head(samples));
    }
    effects_.head(samples) = (right.head(samples) - between_ * effects_.tail(count)).cwiseQuotient(own_);

    const Eigen::VectorXd moved = deviation_.cwiseProduct(effects_);
    Eigen::VectorXd left = numbers_;
    left.noalias() -= others_ * moved.tail(count);
    squares_.assign(products_.size(), 0.0);
    for (Index row = 0; row < left.size(); ++row) {
        const auto place = static_cast<std::size_t>(row);
        const Index sample = sample_[place];
        const double each = left[row] - (sample >= 0 ? level_[row] * moved[sample] : 0.0);
        squares_[group_[place]] += each * each;
    }
    misfit_ = effects_.squaredNorm();
    for (std::size_t group = 0; group < squares_.size(); ++group) {
        misfit_ += squares_[group] / variances[group];
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
