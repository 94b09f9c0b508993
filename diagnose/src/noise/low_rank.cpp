#include "low_rank.hpp"

namespace coagula::diagnose {

NormalEffects::NormalEffects(const Eigen::VectorXd& numbers, const Eigen::VectorXd& level, const std::vector<Index>& sample,
                             Index samples, const Eigen::MatrixXd& others, const std::vector<std::size_t>& group,
                             std::size_t groups)
    : numbers_(numbers), level_(level), sample_(sample), others_(others) {
    const Index count = others.cols();
    products_.assign(groups, {{},
                              Eigen::VectorXd::Zero(samples),
                              Eigen::MatrixXd::Zero(samples, count),
                              Eigen::MatrixXd::Zero(count, count),
                              Eigen::VectorXd::Zero(samples + count)});
    for (std::size_t number = 0; number < groups; ++number) {
        Products& products = products_[number];
        std::vector<Index>& rows = products.rows;
        for (Index row = 0; row < numbers.size(); ++row) {
            if (group[static_cast<std::size_t>(row)] != number) {
                continue;
            }
            rows.push_back(row);
            if (const Index one = sample[static_cast<std::size_t>(row)]; one >= 0) {
                products.own[one] += level[row] * level[row];
                products.right[one] += level[row] * numbers[row];
                products.between.row(one) += level[row] * others.row(row);
            }
        }
        const Eigen::MatrixXd own = others(rows, Eigen::all);
        products.rest.noalias() = own.transpose() * own;
        products.right.tail(count) = own.transpose() * numbers(rows);
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
    own_ = Eigen::VectorXd::Ones(samples);
    between_ = Eigen::MatrixXd::Zero(samples, count);
    Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(count, count);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(samples + count);
    for (std::size_t group = 0; group < products_.size(); ++group) {
        const Products& products = products_[group];
        const double weight = 1 / variances[group];
        own_ += weight * effect * effect * products.own;
        between_ += weight * effect * products.between * scales.asDiagonal();
        rest += weight * scales.asDiagonal() * products.rest * scales.asDiagonal();
        right += weight * deviation_.cwiseProduct(products.right);
    }
    log_determinant_ = own_.array().log().sum();
    effects_.resize(samples + count);
    if (count > 0) {
        const Eigen::MatrixXd eliminated = own_.cwiseInverse().asDiagonal() * between_;
        rest_.compute(rest - between_.transpose() * eliminated);
        log_determinant_ += 2 * rest_.matrixLLT().diagonal().array().log().sum();
        effects_.tail(count) = rest_.solve(right.tail(count) - eliminated.transpose() * right.head(samples));
    }
    effects_.head(samples) = (right.head(samples) - between_ * effects_.tail(count)).cwiseQuotient(own_);

    const Eigen::VectorXd moved = deviation_.cwiseProduct(effects_);
    Eigen::VectorXd left = numbers_ - others_ * moved.tail(count);
    for (Index row = 0; effect > 0 && row < left.size(); ++row) {
        const Index sample = sample_[static_cast<std::size_t>(row)];
        left[row] -= sample >= 0 ? level_[row] * moved[sample] : 0.0;
    }
    misfit_ = effects_.squaredNorm();
    squares_.clear();
    for (std::size_t group = 0; group < products_.size(); ++group) {
        squares_.push_back(left(products_[group].rows).squaredNorm());
        misfit_ += squares_.back() / variances[group];
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
    const Eigen::MatrixXd open = deviation_.asDiagonal() * covariance() * deviation_.asDiagonal();
    std::vector<double> squares = squares_;
    for (std::size_t group = 0; group < squares.size(); ++group) {
        const Products& products = products_[group];
        squares[group] += open.diagonal().head(samples).dot(products.own) +
                          2 * open.topRightCorner(samples, others).cwiseProduct(products.between).sum() +
                          open.bottomRightCorner(others, others).cwiseProduct(products.rest).sum();
    }
    return squares;
}

}  // namespace coagula::diagnose
