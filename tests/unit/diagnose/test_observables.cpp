// SPDX-License-Identifier: GPL-3.0-or-later
// The table of observables: what a column holds is called and measured there as in the table of columns.
#include "observables/observations.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace coagula::diagnose {
namespace {

TEST(Observables, OfColumnsHaveTheirUnits) {
    for (const char* key : {"storage_modulus", "loss_modulus", "complex_modulus", "third_harmonic_storage", "third_harmonic_loss",
                            "viscosity", "exclusion_probability"}) {
        ASSERT_NE(find_quantity(key), nullptr) << key;
        EXPECT_EQ(observable_named(key).unit, find_quantity(key)->unit) << key;
    }
    EXPECT_EQ(find_observable("strain"), nullptr);
    EXPECT_THROW(observable_named("strain"), std::out_of_range);
}

TEST(Observables, FollowFromWhatWasMeasured) {
    const auto key_of = [](const decltype(Observation::what)& what, std::size_t row = 0) {
        return observable_of({{}, 0, row, what}).key;
    };
    EXPECT_EQ(key_of(Modulus{}), "storage_modulus");
    EXPECT_EQ(key_of(Modulus{.loss = true}), "loss_modulus");
    EXPECT_EQ(key_of(Harmonic{}), "third_harmonic_storage");
    EXPECT_EQ(key_of(Harmonic{.loss = true}), "third_harmonic_loss");
    EXPECT_EQ(key_of(Viscosity{1}), "viscosity");
    EXPECT_EQ(key_of(Neighbours{}), "neighbours_plane");
    EXPECT_EQ(key_of(Pore{1e-6}), "exclusion_probability");
    EXPECT_EQ(key_of(ImageDifference{ImageQuantity::axis, 100}), "localisation_axis");
    EXPECT_EQ(key_of(ImageDifference{ImageQuantity::unmatched, 100}), "unmatched_share");
}

/// A viscosity is a loss, and a third harmonic does not grow with the stiffness.
TEST(Observables, KnowTheirPartAndWhetherTheyScale) {
    const Observation viscosity{{}, 0, 0, Viscosity{1}};
    const Observation harmonic{{}, 0, 0, Harmonic{.loss = true}};
    const Observation neighbours{{}, 0, 0, Neighbours{}};
    EXPECT_EQ(part_of({1, 2}, viscosity), 2);
    EXPECT_EQ(part_of({1, 2}, harmonic), 2);
    EXPECT_EQ(part_of({1, 2}, {{}, 0, 0, Modulus{}}), 1);
    EXPECT_TRUE(is_modulus_or_viscosity(viscosity));
    EXPECT_FALSE(is_modulus_or_viscosity(harmonic));
    EXPECT_FALSE(is_loss(neighbours));
    EXPECT_FALSE(has_error_of_phase(viscosity));
    EXPECT_TRUE(has_error_of_phase(harmonic));
    EXPECT_EQ(relative_to(viscosity, 5), 5);
    EXPECT_EQ(relative_to(neighbours, 0.2), 1);
    EXPECT_EQ(relative_to(neighbours, 5), 5);
    EXPECT_EQ(relative_to(harmonic, 5), 1);
}

}  // namespace
}  // namespace coagula::diagnose
