// SPDX-License-Identifier: GPL-3.0-or-later
// Results that come from a file may have lost numbers; then they are simulated again.
#include "hidden_effects.hpp"
#include "responses/contact_response.hpp"
#include "responses/drag_response.hpp"
#include "responses/imaged_centres.hpp"
#include "responses/linear_modulus.hpp"
#include "responses/prestress_response.hpp"

#include <gtest/gtest.h>

namespace coagula::diagnose {
namespace {

Simulator over(SimulationCache& cache) {
    static const Packing packing = structure(64, 1);
    return Simulator({packing}, {"one"}, cache);
}

/// `ask` has the same answer when every result in the cache has lost its last number.
template <class Ask>
void expect_made_again(const Ask& ask) {
    SimulationCache whole;
    Simulator first = over(whole);
    const auto answer = ask(first);
    ASSERT_FALSE(whole.empty());
    SimulationCache damaged = whole;
    for (auto& [key, values] : damaged) {
        values.pop_back();
    }
    Simulator again = over(damaged);
    EXPECT_EQ(ask(again), answer);
    EXPECT_EQ(damaged, whole);
}

TEST(StoredResults, AreMadeAgainWhereNumbersAreLost) {
    expect_made_again([](Simulator& simulator) { return exact_linear_modulus(simulator, Settings{}); });
    expect_made_again([](Simulator& simulator) {
        Settings settings;
        settings.tension = 1e-3;
        return prestress_response(simulator, settings, 0, true);
    });
    Settings dragged;
    dragged.felt_viscosity = 1e-3;
    expect_made_again([&](Simulator& simulator) { return exact_drag_response(simulator, dragged, 1e3); });
    expect_made_again([&](Simulator& simulator) { return drag_response(simulator, dragged, 1e3); });
    expect_made_again([](Simulator& simulator) {
        Settings settings;
        settings.contact_preload = 1e-3;
        return contact_secant(simulator, settings, 1e-3);
    });
    expect_made_again([](Simulator& simulator) {
        Settings settings;
        settings.localisation_plane = 0.02 * 2 * simulator.radius();
        settings.localisation_axis = 0.04 * 2 * simulator.radius();
        return repeated_images(simulator, settings, true);
    });
}

}  // namespace
}  // namespace coagula::diagnose
