// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/noise.hpp>

namespace coagula::diagnose {

namespace {

/// The model whose rows tell most about those of `model`; null if there is none.
const NoiseModel* donor_of(const std::vector<NoiseModel>& models, const NoiseModel& model) {
    const NoiseModel* best = nullptr;
    for (const NoiseModel& other : models) {
        const bool tells = other.rows_estimated && is_of_phase(other) == is_of_phase(model);
        if (tells && (best == nullptr || other.degrees > best->degrees)) {
            best = &other;
        }
    }
    return best;
}

void borrow(NoiseModel& model, const NoiseModel& donor) {
    model.floor = donor.floor_of_stress == model.floor_of_stress ? donor.floor : Estimate{};
    model.relative = donor.relative;
    model.degrees = donor.degrees;
    model.borrowed_from = donor.kind;
}

}  // namespace

std::vector<NoiseModel> noise_of_tables(const std::vector<Measurement>& measurements, const StatedNoise& stated) {
    std::vector<NoiseModel> models;
    for (const Replicates& replicates : find_replicates(measurements)) {
        models.push_back(fit_noise(replicates, stated));
    }
    for (NoiseModel& model : models) {
        const NoiseModel* donor = model.rows_estimated ? nullptr : donor_of(models, model);
        if (donor != nullptr) {
            borrow(model, *donor);
        }
    }
    return models;
}

}  // namespace coagula::diagnose
