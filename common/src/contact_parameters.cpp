// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact_directions.hpp"

#include <coagula/common/contact_model.hpp>

#include <array>
#include <limits>
#include <vector>

namespace coagula {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr const char* paper = "Schenker et al. 2012, sec. 2.1";
constexpr const char* polymers = "Ferry 1980, Viscoelastic Properties of Polymers, ch. 3";
constexpr const char* beams = "Potyondy and Cundall 2004, Int. J. Rock Mech. Min. Sci. 41, 1329";
constexpr const char* mechanics = "Johnson 1985, Contact Mechanics, ch. 4 and 7";
constexpr const char* fractional = "Koeller 1984, J. Appl. Mech. 51, 299";

void append_maxwell(std::vector<ContactParameter>& list, const std::string& name, const Direction& d) {
    list.push_back({name + "_maxwell_stiffness", "N/m", d.maxwell_stiffness, 0, true, infinity,
                    name + " spring in series with a dashpot, of a contact", polymers, ContactRole::loss});
    list.push_back({name + "_maxwell_time", "s", d.maxwell_time, 0, false, infinity,
                    name + " dashpot of that element over its spring: relaxation time", polymers, ContactRole::loss});
}

void append_springpot(std::vector<ContactParameter>& list, const std::string& name, const Direction& d) {
    list.push_back({name + "_springpot_stiffness", "N/m", d.springpot_stiffness, 0, true, infinity,
                    name + " springpot of a contact: |k*| where w times its time is 1", fractional, ContactRole::loss});
    list.push_back({name + "_springpot_time", "s", d.springpot_time, 0, false, infinity, name + " springpot: time", fractional,
                    ContactRole::loss});
    list.push_back({name + "_springpot_exponent", "1", d.springpot_exponent, 0, true, 1,
                    name + " springpot: 0 is a spring, 1 a dashpot", fractional, ContactRole::loss});
}

void append_lubrication(std::vector<ContactParameter>& list) {
    const char* source = "Jeffrey and Onishi 1984, J. Fluid Mech. 139, 261 (leading term)";
    list.push_back({"lubrication_gap", "m", &ContactModel::lubrication_gap, 0, false, infinity,
                    "smallest gap that counts for the squeezed film, the roughness of the surfaces", source, ContactRole::loss});
    list.push_back({"lubrication_cutoff", "m", &ContactModel::lubrication_cutoff, 0, false, infinity,
                    "pairs with a smaller gap between their surfaces squeeze the solvent", source, ContactRole::loss});
}

void append_moments(std::vector<ContactParameter>& list) {
    list.push_back({"bending_stiffness", "N.m", &ContactModel::bending_stiffness, 0, true, infinity,
                    "moment per relative rotation of the ends of a bond, across it", beams});
    list.push_back({"twisting_stiffness", "N.m", &ContactModel::twisting_stiffness, 0, true, infinity,
                    "moment per relative rotation of the ends of a bond, about it", beams});
}

void append_solids(std::vector<ContactParameter>& list) {
    list.push_back({"young_modulus", "Pa", &ContactModel::young_modulus, 0, false, infinity,
                    "of the particles: contacts by Hertz and Mindlin instead of the linear springs", mechanics});
    list.push_back({"poisson_ratio", "1", &ContactModel::poisson_ratio, 0, true, 0.5, "of the particles", mechanics});
    list.push_back({"work_of_adhesion", "J/m2", &ContactModel::work_of_adhesion, 0, false, infinity,
                    "of two surfaces: adhesive contacts", "Johnson, Kendall and Roberts 1971, Proc. R. Soc. A 324, 301"});
}

void append_strengths(std::vector<ContactParameter>& list) {
    using Model = ContactModel;
    list.push_back({"normal_strength", "N", &Model::normal_strength, 0, false, infinity, "tension at which a bond breaks", paper,
                    ContactRole::limit});
    list.push_back({"shear_strength", "N", &Model::shear_strength, 0, false, infinity, "shear force at which a bond breaks", paper,
                    ContactRole::limit});
    list.push_back({"bending_strength", "N.m", &Model::bending_strength, 0, false, infinity,
                    "moment, bending or twisting, at which a bond breaks", beams, ContactRole::limit});
    list.push_back({"friction", "1", &Model::friction, 0, true, infinity,
                    "coefficient of Coulomb friction of contacts without a bond", "Cundall and Strack 1979, Geotechnique 29, 47",
                    ContactRole::limit});
}

void append_state(std::vector<ContactParameter>& list) {
    using Model = ContactModel;
    list.push_back({"prestress", "N", &Model::prestress, -infinity, false, infinity,
                    "normal force in every bond as found, before the network comes to rest; compression is positive",
                    "Alexander 1998, Phys. Rep. 296, 65"});
    list.push_back({"ageing_rate", "1", &Model::ageing_rate, 0, true, infinity,
                    "all springs of a contact grow by 1 + rate ln(1 + t / time)", "Bonacci et al. 2020, Nat. Mater. 19, 775",
                    ContactRole::limit});
    list.push_back(
        {"ageing_time", "s", &Model::ageing_time, 0, false, infinity, "the time in that law", "the same", ContactRole::limit});
}

std::vector<ContactParameter> make_parameters() {
    using Model = ContactModel;
    std::vector<ContactParameter> list{
        {"normal_stiffness", "N/m", &Model::normal_stiffness, 0, false, infinity, "normal spring of a particle", paper},
        {"shear_stiffness", "N/m", &Model::shear_stiffness, 0, true, infinity, "shear spring of a particle", paper},
        {"normal_viscosity", "N.s/m", &Model::normal_viscosity, 0, true, infinity, "normal dashpot of a contact", polymers,
         ContactRole::loss},
        {"shear_viscosity", "N.s/m", &Model::shear_viscosity, 0, true, infinity, "shear dashpot of a contact", polymers,
         ContactRole::loss}};
    append_maxwell(list, "normal", normal_direction);
    append_maxwell(list, "shear", shear_direction);
    append_springpot(list, "normal", normal_direction);
    append_springpot(list, "shear", shear_direction);
    list.push_back({"solvent_viscosity", "Pa.s", &Model::solvent_viscosity, 0, false, infinity,
                    "viscosity of the solvent, which drags on every particle that leaves its affine flow",
                    "Stokes 1851; Happel and Brenner 1983, Low Reynolds Number Hydrodynamics, ch. 5", ContactRole::loss});
    append_lubrication(list);
    append_moments(list);
    append_solids(list);
    append_strengths(list);
    append_state(list);
    return list;
}

/// The name of a parameter.
const std::string& name_of(Parameter parameter) {
    for (const ContactParameter& entry : contact_parameters()) {
        if (entry.value == parameter) {
            return entry.name;
        }
    }
    throw std::logic_error("a parameter of the contact model is not in the list");
}

void check_range(const ContactModel& model, const ContactParameter& entry) {
    const double value = model.*entry.value;
    const bool holds = value <= entry.high && (entry.low_included ? value >= entry.low : value > entry.low);
    require(!entry.is_set(model) || (holds && std::isfinite(value)), entry.name + " of the contact model is " + to_text(value) +
                                                                         (entry.unit == "1" ? "" : " " + entry.unit) +
                                                                         ": it must be finite and " + entry.range());
}

/// What is given needs another parameter.
void check_needs(const ContactModel& model, Parameter given, Parameter needed) {
    require(!has(model, given) || has(model, needed),
            "the contact model has " + name_of(given) + " but no " + name_of(needed) + ", which it needs");
}

/// Parts of one element: all or none.
void check_together(const ContactModel& model, std::span<const Parameter> parts) {
    for (const Parameter given : parts) {
        for (const Parameter missing : parts) {
            require(!has(model, given) || has(model, missing),
                    "the contact model has " + name_of(given) + " but no " + name_of(missing) + ": they belong together");
        }
    }
}

void check_direction(const ContactModel& model, const Direction& d) {
    check_together(model, std::array{d.maxwell_stiffness, d.maxwell_time});
    check_together(model, std::array{d.springpot_stiffness, d.springpot_time, d.springpot_exponent});
}

void check_lubrication(const ContactModel& model) {
    check_together(model, std::array{&ContactModel::lubrication_gap, &ContactModel::lubrication_cutoff});
    check_needs(model, &ContactModel::lubrication_gap, &ContactModel::solvent_viscosity);
    require(!(model.lubrication_gap > model.lubrication_cutoff),
            "lubrication_gap of the contact model is " + to_text(model.lubrication_gap) +
                " m: it must not be larger than lubrication_cutoff, " + to_text(model.lubrication_cutoff) + " m");
}

/// A strength that no force can reach, or that the bond has lost from the start, is a mistake.
void check_strengths(const ContactModel& model) {
    const bool sheared = model.shear_stiffness > 0 || has(model, &ContactModel::young_modulus);
    require(!has(model, &ContactModel::shear_strength) || sheared,
            "the contact model has shear_strength, but its shear_stiffness is 0: no bond would feel shear");
    const bool turned = model.bending_stiffness > 0 || model.twisting_stiffness > 0;
    require(!has(model, &ContactModel::bending_strength) || turned,
            "the contact model has bending_strength, but neither bending_stiffness nor twisting_stiffness above 0: no bond would "
            "feel a moment");
    require(!(-model.prestress > model.normal_strength), "prestress of the contact model is " + to_text(model.prestress) +
                                                             " N: a bond breaks at a tension of " + to_text(model.normal_strength) +
                                                             " N, its normal_strength");
}

}  // namespace

bool ContactParameter::is_set(const ContactModel& model) const {
    return has(model, value);
}

std::string ContactParameter::range() const {
    if (std::isinf(low)) {
        return "any number";
    }
    if (std::isfinite(high)) {
        return to_text(low) + " .. " + to_text(high);
    }
    return (low_included ? ">= " : "> ") + to_text(low);
}

std::span<const ContactParameter> contact_parameters() {
    static const std::vector<ContactParameter> parameters = make_parameters();
    return parameters;
}

void check(const ContactModel& model) {
    for (const Parameter needed : {&ContactModel::normal_stiffness, &ContactModel::shear_stiffness}) {
        require(has(model, needed), "the contact model needs " + name_of(needed));
    }
    for (const ContactParameter& entry : contact_parameters()) {
        check_range(model, entry);
    }
    check_direction(model, normal_direction);
    check_direction(model, shear_direction);
    check_together(model, std::array{&ContactModel::young_modulus, &ContactModel::poisson_ratio});
    check_needs(model, &ContactModel::work_of_adhesion, &ContactModel::young_modulus);
    check_together(model, std::array{&ContactModel::ageing_rate, &ContactModel::ageing_time});
    check_lubrication(model);
    check_strengths(model);
}

}  // namespace coagula
