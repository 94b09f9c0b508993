#include <coagula/diagnose/noise.hpp>

#include <string>

namespace coagula::diagnose {

namespace {

/// The model whose rows tell most about those of `model`; null if there is none.
const NoiseModel* teacher_of(const std::vector<NoiseModel>& models, const NoiseModel& model) {
    const std::string observable = model.fluid ? "storage_modulus" : model.observable;
    const NoiseModel* best = nullptr;
    for (const NoiseModel& other : models) {
        const bool tells = other.rows_estimated && !other.fluid && other.observable == observable;
        if (tells && (best == nullptr || other.degrees > best->degrees)) {
            best = &other;
        }
    }
    return best;
}

void borrow(NoiseModel& model, const NoiseModel& teacher) {
    model.floor = teacher.floor_of_stress == model.floor_of_stress ? teacher.floor : Estimate{};
    model.relative = teacher.relative;
    model.relative_to_complex_modulus = teacher.relative_to_complex_modulus;
    model.phase = 0;
    model.degrees = teacher.degrees;
    model.statement =
        "there are no replicates: as found in those of the " + teacher.observable + " of " + std::string(name_of(teacher.kind));
}

}  // namespace

std::vector<NoiseModel> noise_of_tables(const std::vector<Measurement>& measurements, const NoiseOptions& options) {
    std::vector<NoiseModel> models;
    for (const Replicates& replicates : find_replicates(measurements)) {
        models.push_back(fit_noise(replicates, options));
    }
    for (NoiseModel& model : models) {
        const NoiseModel* teacher = model.rows_estimated ? nullptr : teacher_of(models, model);
        if (teacher != nullptr) {
            borrow(model, *teacher);
        }
    }
    return models;
}

}  // namespace coagula::diagnose
