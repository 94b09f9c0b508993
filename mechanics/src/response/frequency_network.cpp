// SPDX-License-Identifier: GPL-3.0-or-later
#include "frequency_network.hpp"

#include <coagula/common/contact_model.hpp>
#include <coagula/common/parallel.hpp>

#include <algorithm>

namespace coagula::mechanics {

namespace {

/// Unit stiffness along or across every bond.
std::vector<ContactTangent> on_bonds(const FrequencyPairs& pairs, const ContactTangent& tangent) {
    std::vector<ContactTangent> tangents(pairs.tangents.size());
    std::fill_n(tangents.begin(), pairs.bonds, tangent);
    return tangents;
}

std::vector<ContactTangent> films_of(const FrequencyPairs& pairs, double r0) {
    std::vector<ContactTangent> tangents;
    for (const double film : pairs.film) {
        tangents.push_back({.normal = film / r0});
    }
    return tangents;
}

Eigen::VectorXd drag_of(const Packing& packing, const LoadBearing& kept) {
    const double r0 = mean_radius(packing);
    Eigen::VectorXd drag(6 * static_cast<Index>(kept.particle.size()));
    for (std::size_t place = 0; place < kept.particle.size(); ++place) {
        const double radius = packing.radii[kept.particle[place]] / r0;
        drag.segment<3>(6 * static_cast<Index>(place)).setConstant(translation_drag(radius));
        drag.segment<3>(6 * static_cast<Index>(place) + 3).setConstant(rotation_drag(radius));
    }
    return drag;
}

std::vector<Block> free_spins(const LinearNetwork& network, BlockMatrix upper) {
    for (Block& block : upper.block) {
        block.setZero();
    }
    network.stiffen_spins(upper);
    std::vector<Block> spins;
    for (Index particle = 0; particle < upper.rows(); ++particle) {
        spins.push_back(upper.diagonal(particle));
    }
    return spins;
}

}  // namespace

FrequencyNetwork::FrequencyNetwork(const Packing& packing, const FrequencyPairs& pairs, const LoadBearing& kept, double reference)
    : springs_(packing, pairs.network, kept, pairs.tangents, reference),
      upper_(springs_.stiffness()),
      spring_matrix_(both_triangles(upper_)),
      spring_loads_(springs_.loads()),
      spin_(free_spins(springs_, upper_)),
      drag_(drag_of(packing, kept)) {
    const double r0 = mean_radius(packing);
    const LinearNetwork along(packing, pairs.network, kept, on_bonds(pairs, {.normal = 1}), 1);
    const LinearNetwork across(packing, pairs.network, kept, on_bonds(pairs, {.shear = 1}), 1);
    const LinearNetwork films(packing, pairs.network, kept, films_of(pairs, r0), 1);
    along_matrix_ = both_triangles(along.stiffness());
    across_matrix_ = both_triangles(across.stiffness());
    drag_matrix_ = both_triangles(films.stiffness());
    along_loads_ = along.loads();
    across_loads_ = across.loads();
    drag_loads_ = films.loads();
    load_scale_ = springs_.affine_energy().diagonal().transpose().array().abs().sqrt();
    for (Index row = 0; row < particles(); ++row) {
        upper_.diagonal(row) += spin_[static_cast<std::size_t>(row)];
    }
    add_drag();
    for (const Index pair : kept.bond) {
        bonded_.push_back(pair < pairs.bonds);
        film_.push_back(pairs.film[static_cast<std::size_t>(pair)] / r0);
        rough_.push_back(pairs.rough[static_cast<std::size_t>(pair)]);
    }
}

/// Stokes drag beside the films.
void FrequencyNetwork::add_drag() {
    for (Index row = 0; row < particles(); ++row) {
        for (auto k = static_cast<std::size_t>(drag_matrix_.start[static_cast<std::size_t>(row)]);
             k < static_cast<std::size_t>(drag_matrix_.start[static_cast<std::size_t>(row) + 1]); ++k) {
            if (drag_matrix_.column[k] == row) {
                drag_matrix_.block[k].diagonal() += drag_.segment<6>(6 * row);
            }
        }
    }
}

double FrequencyNetwork::change(const Ratios& now, const Ratios& then) const {
    const auto of = [](const Complex& a, const Complex& b) { return a == b ? 0.0 : std::abs(std::log(a / b)); };
    double most = of(now.drag, then.drag);
    for (std::size_t k = 0; k < bonded_.size(); ++k) {
        const ContactTangent& t = springs_.bonds()[k].tangent;
        if (bonded_[k]) {
            most = std::max({most, of(now.springs * t.normal + now.normal, then.springs * t.normal + then.normal),
                             of(now.springs * t.shear + now.shear, then.springs * t.shear + then.shear)});
            const bool alone = t.bending > 0 || t.twisting > 0 || t.tension != 0;
            most = alone ? std::max(most, of(now.springs, then.springs)) : most;
        }
    }
    return most;
}

ComplexBlocks FrequencyNetwork::matrix(const Ratios& ratios) const {
    ComplexBlocks result;
    result.block.resize(spring_matrix_.block.size());
    for (std::size_t k = 0; k < result.block.size(); ++k) {
        result.block[k] =
            ratios.springs * spring_matrix_.block[k].cast<Complex>() + ratios.normal * along_matrix_.block[k].cast<Complex>() +
            ratios.shear * across_matrix_.block[k].cast<Complex>() + ratios.drag * drag_matrix_.block[k].cast<Complex>();
    }
    return result;
}

ComplexLoads FrequencyNetwork::loads(const Ratios& ratios) const {
    return ratios.springs * spring_loads_.cast<Complex>() + ratios.normal * along_loads_.cast<Complex>() +
           ratios.shear * across_loads_.cast<Complex>() + ratios.drag * drag_loads_.cast<Complex>();
}

void FrequencyNetwork::multiply(const ComplexBlocks& matrix, const ComplexLoads& x, ComplexLoads& y) const {
    y.resize(x.rows(), 6);
#pragma omp parallel for schedule(static) if (worth_threads(particles(), 1000))
    for (Index row = 0; row < particles(); ++row) {
        Eigen::Matrix<Complex, 6, 6, Eigen::RowMajor> sum = Eigen::Matrix<Complex, 6, 6, Eigen::RowMajor>::Zero();
        for (auto k = static_cast<std::size_t>(spring_matrix_.start[static_cast<std::size_t>(row)]);
             k < static_cast<std::size_t>(spring_matrix_.start[static_cast<std::size_t>(row) + 1]); ++k) {
            sum.noalias() += matrix.block[k] * x.middleRows<6>(6 * spring_matrix_.column[k]);
        }
        y.middleRows<6>(6 * row) = sum;
    }
}

template <class Visit>
void FrequencyNetwork::for_each_upper(const Visit& visit) const {
    for (Index row = 0; row < particles(); ++row) {
        for (auto k = static_cast<std::size_t>(spring_matrix_.start[static_cast<std::size_t>(row)]);
             k < static_cast<std::size_t>(spring_matrix_.start[static_cast<std::size_t>(row) + 1]); ++k) {
            const bool diagonal = spring_matrix_.column[k] == row;
            if (spring_matrix_.column[k] < row) {
                continue;
            }
            for (int r = 0; r < 6; ++r) {
                for (int c = diagonal ? r : 0; c < 6; ++c) {
                    visit(row, k, r, c);
                }
            }
        }
    }
}

void FrequencyNetwork::scalar_pattern(std::vector<int>& row, std::vector<int>& column) const {
    for_each_upper([&](Index block_row, std::size_t k, int r, int c) {
        row.push_back(static_cast<int>(6 * block_row) + r);
        column.push_back(static_cast<int>(6 * spring_matrix_.column[k]) + c);
    });
}

std::vector<Complex> FrequencyNetwork::scalar_values(const ComplexBlocks& matrix, double shift) const {
    std::vector<Complex> values;
    for_each_upper([&](Index row, std::size_t k, int r, int c) {
        Complex value = matrix.block[k](r, c);
        if (shift > 0 && spring_matrix_.column[k] == row) {
            value += spin_[static_cast<std::size_t>(row)](r, c) + (r == c ? shift : 0.0);
        }
        values.push_back(value);
    });
    return values;
}

Forms FrequencyNetwork::forms(const ComplexLoads& motion, const std::vector<std::vector<ContactTangent>>& changes) const {
    using Columns = Eigen::Matrix<Complex, 9, 6>;
    const Loads real = motion.real();
    const Loads imaginary = motion.imag();
    Forms sum;
    sum.changes.assign(changes.size(), Forms::Tensor::Zero());
    for (std::size_t k = 0; k < bonded_.size(); ++k) {
        LinearBond bond = springs_.bonds()[k];
        const Deformations<6> re = LinearNetwork::deformation(bond, real);
        const Deformations<6> im = LinearNetwork::deformation(bond, imaginary) - LinearNetwork::affine_deformations(bond);
        const Columns all = re.cast<Complex>() + Complex(0, 1) * im.cast<Complex>();
        const auto form = [&](const ContactTangent& tangent) -> Forms::Tensor {
            bond.tangent = tangent;
            const Columns stress = stresses(bond, re).cast<Complex>() + Complex(0, 1) * stresses(bond, im).cast<Complex>();
            return all.transpose() * stress;
        };
        const Eigen::Matrix<Complex, 1, 6> along = bond.normal.transpose().cast<Complex>() * all.topRows<3>();
        const Eigen::Matrix<Complex, 3, 6> across = all.topRows<3>() - bond.normal.cast<Complex>() * along;
        const Forms::Tensor stretch = along.transpose() * along;
        const Forms::Powers power = along.cwiseAbs2().transpose();
        if (bonded_[k]) {
            sum.springs += form(bond.tangent);
            sum.along += stretch;
            sum.across += across.transpose() * across;
            sum.along_power += power;
            sum.across_power += across.colwise().squaredNorm().transpose();
            for (std::size_t change = 0; change < changes.size(); ++change) {
                sum.changes[change] += form(changes[change][k]);
            }
        }
        sum.drag += film_[k] * stretch;
        sum.rough += rough_[k] ? Forms::Tensor(film_[k] * stretch) : Forms::Tensor::Zero();
        sum.drag_power += film_[k] * power;
    }
    sum.drag += motion.transpose() * drag_.cast<Complex>().asDiagonal() * motion;
    sum.drag_power += motion.cwiseAbs2().transpose() * drag_;
    return sum;
}

}  // namespace coagula::mechanics
