// SPDX-License-Identifier: GPL-3.0-or-later
#include "sheared_network.hpp"

#include <coagula/common/parallel.hpp>
#include <coagula/common/percolation.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace coagula::mechanics {

namespace {

using Eigen::Vector3d;

/// Neighbours are pairs nearer than (1 + list_skin) times the sum of their radii.
constexpr double list_skin = 0.15;

/// Stiffness of a contact of two mean particles at a small overlap, the unit in which residuals are measured.
double typical_stiffness(const GeneralContact& law, double radius) {
    return law.normal(1e-3 * radius, 0.5 * radius, true).stiffness;
}

}  // namespace

ShearedNetwork::ShearedNetwork(const Packing& packing, const ContactNetwork& bonds, const ContactModel& model,
                               const QuasistaticOptions& options)
    : law_(model),
      orientation_(options.orientation),
      cell_(packing.cell),
      volume_(packing.cell.volume()),
      length_(mean_radius(packing)),
      stiffness_(typical_stiffness(law_, length_)),
      positions_(packing.positions),
      radii_(packing.radii),
      bonds_(bonds.size()) {
    contacts_.reserve(static_cast<std::size_t>(bonds_));
    for (Index bond = 0; bond < bonds_; ++bond) {
        const Index first = bonds.ends(0, bond);
        const Index second = bonds.ends(1, bond);
        const Vector3d branch = bonds.branch.col(bond);
        const double touching = radii_[first] + radii_[second];
        const double unstressed = options.rest_length == RestLength::as_found ? branch.norm() : touching;
        contacts_.push_back({first, second, bond, law_.make_bond(branch, radii_[first], radii_[second], unstressed)});
    }
    find_neighbours();
}

Vector3d ShearedNetwork::strained(const Vector3d& branch, double from, double increment) const {
    Vector3d moved = branch;
    moved[orientation_.direction] += increment / relative_height(from) * branch[orientation_.normal];
    return moved;
}

Vector3d ShearedNetwork::strain_rate(const ContactMemory& memory) const {
    return memory.branch[orientation_.normal] / relative_height(strain_) / length_ * Vector3d::Unit(orientation_.direction);
}

PairMotion ShearedNetwork::pair_motion(const ShearedContact& contact, double strain_increment, const Motion& motion) const {
    const Index first = 6 * contact.first;
    const Index second = 6 * contact.second;
    return {strained(contact.memory.branch, strain_, strain_increment) +
                length_ * (motion.segment<3>(second) - motion.segment<3>(first)),
            motion.segment<3>(first + 3), motion.segment<3>(second + 3), radii_[contact.first], radii_[contact.second]};
}

/// The contact point divides the line of centres in the ratio of the radii.
Wrench ShearedNetwork::wrench(const ContactMemory& memory, const ContactForce& force, const ShearedContact& contact) const {
    const double share = radii_[contact.first] / (radii_[contact.first] + radii_[contact.second]);
    const Vector3d moment = memory.branch.cross(force.force);
    Wrench all;
    all << force.force / (stiffness_ * length_), (share * moment + force.moment) / (stiffness_ * length_ * length_),
        ((1 - share) * moment - force.moment) / (stiffness_ * length_ * length_);
    return all;
}

void ShearedNetwork::evaluate(double strain_increment, const Motion& motion, Trial& trial) const {
    const auto count = static_cast<Index>(contacts_.size());
    trial.strain_increment = strain_increment;
    trial.motion = motion;
    trial.memory.resize(contacts_.size());
    trial.wrench.resize(contacts_.size());
    Eigen::VectorXd dissipated(count);
#pragma omp parallel for schedule(static) if (worth_threads(count, 200))
    for (Index k = 0; k < count; ++k) {
        const ShearedContact& contact = contacts_[static_cast<std::size_t>(k)];
        ContactMemory& memory = trial.memory[static_cast<std::size_t>(k)];
        memory = contact.memory;
        const ContactForce force = law_.update(memory, pair_motion(contact, strain_increment, motion), 0.0);
        trial.wrench[static_cast<std::size_t>(k)] = wrench(memory, force, contact);
        dissipated[k] = force.dissipated;
    }
    trial.dissipated = dissipated.sum();
    gather(trial);
}

void ShearedNetwork::gather(Trial& trial) const {
    trial.residual.resize(6 * particles());
#pragma omp parallel for schedule(static) if (worth_threads(particles(), 100))
    for (Index particle = 0; particle < particles(); ++particle) {
        Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
        const auto row = static_cast<std::size_t>(particle);
        for (Index entry = groups_.start[row]; entry < groups_.start[row + 1]; ++entry) {
            const auto k = static_cast<std::size_t>(groups_.contact[static_cast<std::size_t>(entry)]);
            const Wrench& all = trial.wrench[k];
            // A contact with the particle's own image comes twice in the group, which is right for the sum of both ends.
            if (contacts_[k].first == contacts_[k].second) {
                sum.tail<3>() += 0.5 * (all.segment<3>(3) + all.tail<3>());
            } else if (contacts_[k].first == particle) {
                sum += all.head<6>();
            } else {
                sum.head<3>() -= all.head<3>();
                sum.tail<3>() += all.tail<3>();
            }
        }
        trial.residual.segment<6>(6 * particle) = sum;
    }
    double force = 0;
    Index loaded = 0;
    for (const Wrench& all : trial.wrench) {
        force += all.head<3>().squaredNorm();
        loaded += all.head<3>().squaredNorm() > 0 ? 1 : 0;
    }
    trial.rms_force = std::sqrt(force / static_cast<double>(std::max<Index>(loaded, 1)));
    trial.rms_residual = trial.residual.norm() / std::sqrt(static_cast<double>(particles()));
}

double ShearedNetwork::reach_used(double strain_increment, const Motion& motion) const {
    double farthest = 0;
    for (Index particle = 0; particle < particles(); ++particle) {
        const Vector3d moved = moved_.col(particle) + motion.segment<3>(6 * particle);
        farthest = std::max(farthest, moved.squaredNorm());
    }
    const double reach = 2 * radii_.minCoeff() / length_ * list_skin;
    const double pair = 2 * radii_.maxCoeff() / length_ * (1 + list_skin);
    const double strain = std::abs(strain_ + strain_increment - strain_at_search_) / relative_height(strain_at_search_);
    return (2 * std::sqrt(farthest) + strain * pair) / reach;
}

bool ShearedNetwork::commit(const Trial& trial) {
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
        contacts_[k].memory = trial.memory[k];
    }
    Vector3d drift = Vector3d::Zero();
    for (Index particle = 0; particle < particles(); ++particle) {
        drift += trial.motion.segment<3>(6 * particle) / static_cast<double>(particles());
    }
    for (Index particle = 0; particle < particles(); ++particle) {
        const Vector3d moved = trial.motion.segment<3>(6 * particle) - drift;
        positions_.col(particle) = strained(positions_.col(particle), strain_, trial.strain_increment) + length_ * moved;
        moved_.col(particle) += moved;
    }
    strain_ += trial.strain_increment;
    if (reach_used(0.0, Motion::Zero(6 * particles())) < 0.5) {
        return false;
    }
    const Index before = touching_contacts();
    find_neighbours();
    return touching_contacts() > before;
}

/// The particles where they are in the cell before a strain.
Packing ShearedNetwork::before_strain(double strain) const {
    Packing flat{cell_, positions_, radii_};
    for (Index particle = 0; particle < particles(); ++particle) {
        flat.positions.col(particle) = cell_.wrap(strained(positions_.col(particle), strain, -strain));
    }
    return flat;
}

double ShearedNetwork::stretch_of_distances(double strain) const {
    return orientation_.is_uniaxial() ? std::max(1.0, 1 / (1 + strain))
                                      : 0.5 * std::abs(strain) + std::sqrt(1 + 0.25 * strain * strain);
}

/// Neighbours are looked for in the cell before the strain, whose points and pairs map one to one onto those of the strained cell:
/// in a rectangular box, a shear strain is the same lattice as one that differs by whole edges.
void ShearedNetwork::find_neighbours() {
    double strain = strain_;
    if (cell_.is_rectangular() && !orientation_.is_uniaxial()) {
        const double turn = cell_.lengths()[orientation_.direction] / cell_.lengths()[orientation_.normal];
        strain -= turn * std::nearbyint(strain_ / turn);
    }
    const Packing flat = before_strain(strain);
    const ContactNetwork near = find_pairs(flat, 2 * radii_.maxCoeff() * (1 + list_skin) * stretch_of_distances(strain));
    if (!contacts_.empty() && groups_.start.empty()) {
        group_contacts();
    }
    std::vector<ShearedContact> found(contacts_.begin(), contacts_.begin() + bonds_);
    for (Index pair = 0; pair < near.size(); ++pair) {
        const Index first = near.ends(0, pair);
        const Index second = near.ends(1, pair);
        const Vector3d branch = strained(near.branch.col(pair), 0, strain);
        if (branch.norm() >= (1 + list_skin) * (radii_[first] + radii_[second])) {
            continue;
        }
        const ShearedContact* known = find_contact(first, second, branch);
        if (known == nullptr) {
            found.push_back({first, second, -1, law_.make_contact(branch, radii_[first], radii_[second])});
        } else if (known->bond < 0) {
            found.push_back(*known);
        }
    }
    contacts_ = std::move(found);
    ++generation_;
    group_contacts();
    moved_ = Eigen::Matrix3Xd::Zero(3, particles());
    strain_at_search_ = strain_;
}

/// The contact of two particles that has this branch: a pair may touch through more than one image.
const ShearedContact* ShearedNetwork::find_contact(Index first, Index second, const Vector3d& branch) const {
    if (contacts_.empty()) {
        return nullptr;
    }
    const double near = 1e-3 * (radii_[first] + radii_[second]);
    const ShearedContact* found = nullptr;
    const auto row = static_cast<std::size_t>(first);
    for (Index entry = groups_.start[row]; entry < groups_.start[row + 1]; ++entry) {
        const ShearedContact& old = contacts_[static_cast<std::size_t>(groups_.contact[static_cast<std::size_t>(entry)])];
        const bool forward = old.first == first && old.second == second && (old.memory.branch - branch).norm() < near;
        const bool backward = old.first == second && old.second == first && (old.memory.branch + branch).norm() < near;
        if (forward || backward) {
            found = &old;
        }
    }
    return found;
}

void ShearedNetwork::group_contacts() {
    ContactNetwork network;
    network.particles = particles();
    network.ends.resize(2, static_cast<Index>(contacts_.size()));
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
        network.ends.col(static_cast<Index>(k)) << static_cast<std::int32_t>(contacts_[k].first),
            static_cast<std::int32_t>(contacts_[k].second);
    }
    groups_ = group_by_particle(network);
}

std::vector<ContactMemory> ShearedNetwork::memories() const {
    std::vector<ContactMemory> all;
    all.reserve(contacts_.size());
    std::transform(contacts_.begin(), contacts_.end(), std::back_inserter(all), [](const auto& contact) { return contact.memory; });
    return all;
}

ShearedNetwork::Worst ShearedNetwork::most_loaded(const std::vector<ContactMemory>& memory) const {
    Worst worst;
    for (std::size_t k = 0; k < static_cast<std::size_t>(bonds_); ++k) {
        const BondLoad load = law_.load(memory[k], radii_[contacts_[k].first], radii_[contacts_[k].second]);
        if (load.ratio > worst.ratio) {
            worst = {load.ratio, load.limit, static_cast<Index>(k)};
        }
    }
    return worst;
}

double ShearedNetwork::first_to_break(const std::vector<ContactMemory>& memory) const {
    double first = 2;
    for (std::size_t k = 0; k < static_cast<std::size_t>(bonds_); ++k) {
        const ShearedContact& bond = contacts_[k];
        const double then = law_.load(memory[k], radii_[bond.first], radii_[bond.second]).ratio;
        if (then > 1) {
            const double now = std::min(law_.load(bond.memory, radii_[bond.first], radii_[bond.second]).ratio, 1.0);
            first = std::min(first, (1 - now) / (then - now));
        }
    }
    return first;
}

void ShearedNetwork::break_bond(Index contact) {
    ShearedContact& bond = contacts_[static_cast<std::size_t>(contact)];
    law_.break_bond(bond.memory, radii_[bond.first], radii_[bond.second]);
}

double ShearedNetwork::energy(const std::vector<ContactMemory>& memory) const {
    Eigen::VectorXd each(static_cast<Index>(memory.size()));
#pragma omp parallel for schedule(static) if (worth_threads(each.size(), 30))
    for (Index k = 0; k < each.size(); ++k) {
        const ShearedContact& contact = contacts_[static_cast<std::size_t>(k)];
        each[k] = law_.energy(memory[static_cast<std::size_t>(k)], radii_[contact.first], radii_[contact.second]);
    }
    return each.sum();
}

double ShearedNetwork::reduced_energy(const Trial& trial) const {
    return (energy(trial.memory) + trial.dissipated) / (stiffness_ * length_ * length_);
}

Eigen::Matrix3d ShearedNetwork::stress(const Trial& trial) const {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
        sum += trial.memory[k].branch * trial.wrench[k].head<3>().transpose();
    }
    return stiffness_ * length_ / (volume_ * relative_height(strain_ + trial.strain_increment)) * sum;
}

Index ShearedNetwork::intact_bonds() const {
    return std::count_if(contacts_.begin(), contacts_.end(), [](const auto& contact) { return contact.memory.bonded; });
}

bool ShearedNetwork::spans() const {
    ContactNetwork network;
    network.particles = particles();
    network.ends.resize(2, static_cast<Index>(contacts_.size()));
    network.branch.resize(3, network.ends.cols());
    Index count = 0;
    for (const ShearedContact& contact : contacts_) {
        if (GeneralContact::touches(contact.memory, radii_[contact.first], radii_[contact.second])) {
            network.ends.col(count) << static_cast<std::int32_t>(contact.first), static_cast<std::int32_t>(contact.second);
            network.branch.col(count++) = strained(contact.memory.branch, strain_, -strain_);
        }
    }
    network.ends.conservativeResize(2, count);
    network.branch.conservativeResize(3, count);
    const std::vector<Cluster> clusters = find_clusters(before_strain(strain_), network);
    return std::any_of(clusters.begin(), clusters.end(), [&](const Cluster& each) { return each.percolates(orientation_.normal); });
}

Index ShearedNetwork::touching_contacts() const {
    return std::count_if(contacts_.begin(), contacts_.end(), [&](const auto& contact) {
        return !contact.memory.bonded && GeneralContact::touches(contact.memory, radii_[contact.first], radii_[contact.second]);
    });
}

double ShearedNetwork::age(double factor) {
    const double before = law_.age_factor();
    law_.set_age_factor(factor);
    double lost = 0;
    for (ShearedContact& contact : contacts_) {
        lost += law_.reage(contact.memory, before, radii_[contact.first], radii_[contact.second]);
    }
    return lost;
}

}  // namespace coagula::mechanics
