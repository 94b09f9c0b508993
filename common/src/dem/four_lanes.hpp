// SPDX-License-Identifier: GPL-3.0-or-later
// Arithmetic on four numbers at a time in the registers of AVX2 (GCC and clang on x86-64), by which bond_loop.hpp computes four
// bonds at once. Only a source that is compiled for AVX2 may include it: all names have internal linkage, so that no function of it
// runs on another processor.
#pragma once

#include <coagula/common/dem/bond_loop.hpp>

#include <immintrin.h>

// NOLINTBEGIN(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays): see bond_loop.hpp
namespace {

struct FourLanes {
    using Real = double __attribute__((vector_size(32)));
    static constexpr std::size_t width = 4;
    static Real load(const double* values) { return _mm256_loadu_pd(values); }
    static void store(double* values, Real value) { _mm256_storeu_pd(values, value); }
    static Real square_root(Real value) { return _mm256_sqrt_pd(value); }
    static Real larger(Real a, Real b) { return _mm256_max_pd(a, b); }
    static double largest(Real value) {
        const double low = value[0] > value[1] ? value[0] : value[1];
        const double high = value[2] > value[3] ? value[2] : value[3];
        return low > high ? low : high;
    }
    static Real magnitude(Real value) { return _mm256_andnot_pd(_mm256_set1_pd(-0.0), value); }
    static Real where_positive(Real sign, Real value) {
        return _mm256_and_pd(_mm256_cmp_pd(sign, _mm256_setzero_pd(), _CMP_GT_OQ), value);
    }
    static double sum_of_three(const Real* values) { return values[0][0] + values[0][1] + values[0][2]; }
    static void transpose(Real (&rows)[4]) {
        const Real a = _mm256_unpacklo_pd(rows[0], rows[1]);
        const Real b = _mm256_unpackhi_pd(rows[0], rows[1]);
        const Real c = _mm256_unpacklo_pd(rows[2], rows[3]);
        const Real d = _mm256_unpackhi_pd(rows[2], rows[3]);
        rows[0] = _mm256_permute2f128_pd(a, c, 0x20);
        rows[1] = _mm256_permute2f128_pd(b, d, 0x20);
        rows[2] = _mm256_permute2f128_pd(a, c, 0x31);
        rows[3] = _mm256_permute2f128_pd(b, d, 0x31);
    }
    static const double* at(const double* quads, std::int32_t slot) { return quads + 4 * static_cast<std::size_t>(slot); }
    static double* at(double* quads, std::int32_t slot) { return quads + 4 * static_cast<std::size_t>(slot); }
    static void take(const double* quads, Real (&values)[4]) {
        for (int lane = 0; lane < 4; ++lane) {
            values[lane] = load(at(quads, lane));
        }
        transpose(values);
    }
    static void gather(const double* quads, const std::int32_t* slots, Real (&values)[4]) {
        for (int lane = 0; lane < 4; ++lane) {
            values[lane] = load(at(quads, slots[2 * lane]));
        }
        transpose(values);
    }
    static void add(double* quad, Real value) { store(quad, load(quad) + value); }
    static void scatter(double* quads, const std::int32_t* ends, const Real (&first)[4], const Real (&second)[4]) {
        Real first_rows[4] = {first[0], first[1], first[2], first[3]};
        Real second_rows[4] = {second[0], second[1], second[2], second[3]};
        transpose(first_rows);
        transpose(second_rows);
        for (int lane = 0; lane < 4; ++lane) {
            add(at(quads, ends[2 * lane]), first_rows[lane]);
            add(at(quads, ends[2 * lane + 1]), second_rows[lane]);
        }
    }
};

}  // namespace
// NOLINTEND(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays)
