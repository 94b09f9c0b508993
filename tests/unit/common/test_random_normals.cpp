// SPDX-License-Identifier: GPL-3.0-or-later
// Normal numbers in bulk: the words of Random123, the formula of Box and Muller with the library's functions, moments.
#include <coagula/common/random.hpp>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <Random123/philox.h>
#pragma GCC diagnostic pop

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <vector>

namespace coagula {
namespace {

constexpr std::uint64_t seed = 0x123456789abcdef;

TEST(RandomNormals, AreThoseOfPhiloxAndBoxMuller) {
    constexpr std::uint64_t step = (std::uint64_t{1} << 40U) + 7;
    const std::vector<std::int32_t> particles{5, 3, 1000000, 0, 77};
    std::vector<double> normals(4 * particles.size());
    random_normals(seed, RandomPurpose::test, step, particles, normals.data());
    const auto unit = [](std::uint32_t word) { return (word + 0.5) / 4294967296.0; };
    for (std::size_t entry = 0; entry < particles.size(); ++entry) {
        const r123::Philox4x32::ctr_type counter{{static_cast<std::uint32_t>(step), static_cast<std::uint32_t>(step >> 32U),
                                                  static_cast<std::uint32_t>(particles[entry]), 100}};
        const r123::Philox4x32::key_type key{{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U)}};
        const auto words = r123::Philox4x32{}(counter, key);
        const double first = std::sqrt(-2 * std::log(unit(words[0])));
        const double second = std::sqrt(-2 * std::log(unit(words[2])));
        const double turn = 2 * std::numbers::pi;
        EXPECT_NEAR(normals[4 * entry], first * std::cos(turn * unit(words[1])), 1e-12);
        EXPECT_NEAR(normals[4 * entry + 1], first * std::sin(turn * unit(words[1])), 1e-12);
        EXPECT_NEAR(normals[4 * entry + 2], second * std::cos(turn * unit(words[3])), 1e-12);
        EXPECT_EQ(normals[4 * entry + 3], 0);
    }
}

TEST(RandomNormals, DoNotDependOnTheirNeighbours) {
    std::vector<std::int32_t> particles(200);
    std::iota(particles.begin(), particles.end(), 0);
    std::vector<double> all(800);
    std::vector<double> one(4);
    random_normals(seed, RandomPurpose::test, 3, particles, all.data());
    for (const std::size_t entry : {std::size_t{0}, std::size_t{63}, std::size_t{64}, std::size_t{199}}) {
        random_normals(seed, RandomPurpose::test, 3, std::span(particles).subspan(entry, 1), one.data());
        for (std::size_t part = 0; part < 4; ++part) {
            EXPECT_EQ(one[part], all[4 * entry + part]);
        }
    }
}

TEST(RandomNormals, HaveTheMomentsOfANormalDistribution) {
    constexpr std::size_t count = 300000;
    std::vector<std::int32_t> particles(count);
    std::iota(particles.begin(), particles.end(), 0);
    std::vector<double> normals(4 * count);
    random_normals(seed, RandomPurpose::test, 0, particles, normals.data());
    for (std::size_t part = 0; part < 3; ++part) {
        std::array<double, 5> moments{};
        double tail = 0;
        double across = 0;
        for (std::size_t entry = 0; entry < count; ++entry) {
            const double value = normals[4 * entry + part];
            double power = 1;
            for (double& moment : moments) {
                moment += power / count;
                power *= value;
            }
            tail += std::abs(value) > 3 ? 1.0 / count : 0.0;
            across += value * normals[4 * entry + (part + 1) % 3] / count;
        }
        // Five standard errors.
        const double root = std::sqrt(static_cast<double>(count));
        EXPECT_NEAR(moments[1], 0, 5 / root);
        EXPECT_NEAR(moments[2], 1, 5 * std::sqrt(2.0) / root);
        EXPECT_NEAR(moments[3], 0, 5 * std::sqrt(15.0) / root);
        EXPECT_NEAR(moments[4], 3, 5 * std::sqrt(96.0) / root);
        EXPECT_NEAR(tail, 0.0026998, 5 * std::sqrt(0.0027) / root);
        EXPECT_NEAR(across, 0, 5 / root);
    }
}

TEST(RandomNormals, ComeWithUniformNumbersThatDoNotDependOnThem) {
    constexpr std::size_t count = 300000;
    std::vector<std::int32_t> particles(count);
    std::iota(particles.begin(), particles.end(), 0);
    std::vector<double> alone(4 * count);
    std::vector<double> normals(4 * count);
    std::vector<double> uniforms(4 * count, 7.0);
    random_normals(seed, RandomPurpose::test, 0, particles, alone.data());
    random_normals(seed, RandomPurpose::test, 0, particles, normals.data(), uniforms.data());
    EXPECT_EQ(normals, alone);
    const double root = std::sqrt(static_cast<double>(count));
    // Five standard errors; the products of two numbers, and of their squares less 1, vanish on average.
    const auto expect_apart = [&](const std::vector<double>& others, std::size_t part, std::size_t other, double kurtosis) {
        double product = 0;
        double squares = 0;
        for (std::size_t entry = 0; entry < count; ++entry) {
            const double one = uniforms[4 * entry + part];
            const double two = others[4 * entry + other];
            product += one * two / count;
            squares += (one * one - 1) * (two * two - 1) / count;
        }
        EXPECT_NEAR(product, 0, 5 / root) << part << ' ' << other;
        EXPECT_NEAR(squares, 0, 5 * std::sqrt(0.8 * (kurtosis - 1)) / root) << part << ' ' << other;
    };
    for (std::size_t part = 0; part < 3; ++part) {
        std::array<double, 5> moments{};
        for (std::size_t entry = 0; entry < count; ++entry) {
            double power = 1;
            for (double& moment : moments) {
                moment += power / count;
                power *= uniforms[4 * entry + part];
            }
            ASSERT_EQ(uniforms[4 * entry + 3], 0);
        }
        EXPECT_NEAR(moments[1], 0, 5 / root);
        EXPECT_NEAR(moments[2], 1, 5 * std::sqrt(0.8) / root);
        EXPECT_NEAR(moments[3], 0, 5 * std::sqrt(27.0 / 7) / root);
        EXPECT_NEAR(moments[4], 1.8, 5 * std::sqrt(9 - 1.8 * 1.8) / root);
        for (std::size_t other = 0; other < 3; ++other) {
            expect_apart(normals, part, other, 3);
            if (other != part) {
                expect_apart(uniforms, part, other, 1.8);
            }
        }
    }
}

}  // namespace
}  // namespace coagula
