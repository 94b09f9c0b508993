// SPDX-License-Identifier: GPL-3.0-or-later
// The packing as a distant eye sees it, and its place between the plates of the shear test.
#include "figure_parts.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace coagula::report {

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr int shades = 6;  // discs that make a sphere

struct Colour {
    double red;
    double green;
    double blue;
};

int rgb_of(const Colour& colour) {
    const auto channel = [](double value) { return static_cast<int>(std::lround(std::clamp(value, 0.0, 255.0))); };
    return channel(colour.red) * 65536 + channel(colour.green) * 256 + channel(colour.blue);
}

/// From the dark rim (0) to the highlight (1), paler with distance.
Colour shade(double toward_highlight, double nearness) {
    const auto channel = [&](double dark, double light, double pale, double exponent) {
        const double colour = dark + (light - dark) * std::pow(toward_highlight, exponent);
        return colour * nearness + pale * (1 - nearness);
    };
    return {channel(24, 255, 205, 1.3), channel(56, 236, 214, 1.15), channel(92, 205, 224, 1.0)};
}

void add_disc(Series& discs, double x, double y, double radius, int rgb) {
    discs.x.push_back(x);
    discs.y.push_back(y);
    discs.radius.push_back(radius);
    discs.rgb.push_back(rgb);
}

/// Columns by their last row, rising: from the back to the front.
std::vector<Index> back_to_front(const Eigen::Matrix3Xd& seen) {
    std::vector<Index> order(static_cast<std::size_t>(seen.cols()));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return seen(2, a) < seen(2, b); });
    return order;
}

/// Which spheres show at least one cell of a fine raster when painted in this order.
std::vector<bool> visible(const Eigen::Matrix3Xd& seen, const Eigen::VectorXd& radii, const std::vector<Index>& order) {
    const double cell = radii.mean() / 6;
    const Eigen::Vector2d low = seen.topRows(2).rowwise().minCoeff() - Eigen::Vector2d::Constant(radii.maxCoeff());
    const Eigen::Vector2d high = seen.topRows(2).rowwise().maxCoeff() + Eigen::Vector2d::Constant(radii.maxCoeff());
    const Eigen::Vector2i size = ((high - low) / cell).cast<int>() + Eigen::Vector2i::Constant(1);
    Eigen::MatrixXi raster = Eigen::MatrixXi::Constant(size.x(), size.y(), -1);
    for (const Index particle : order) {
        const Eigen::Vector2d centre = (seen.col(particle).head<2>() - low) / cell;
        const double radius = radii[particle] / cell;
        for (int i = std::max(0, static_cast<int>(centre.x() - radius)); i < std::min<double>(size.x(), centre.x() + radius); ++i) {
            const double half = std::sqrt(std::max(0.0, radius * radius - std::pow(i - centre.x(), 2)));
            for (int j = std::max(0, static_cast<int>(std::ceil(centre.y() - half)));
                 j < std::min<double>(size.y(), centre.y() + half); ++j) {
                raster(i, j) = static_cast<int>(particle);
            }
        }
    }
    std::vector<bool> shown(static_cast<std::size_t>(seen.cols()), false);
    for (Index k = 0; k < raster.size(); ++k) {
        if (raster(k) >= 0) {
            shown[static_cast<std::size_t>(raster(k))] = true;
        }
    }
    return shown;
}

/// Turned so that three faces of the box are seen: across, up, towards the eye.
Eigen::Matrix3Xd seen_from_afar(const Packing& packing) {
    constexpr double turn = 32 * degree;
    constexpr double tilt = 24 * degree;
    Eigen::Matrix3d axes;                                                                  // rows: across, up, towards the eye
    axes << std::cos(turn), -std::sin(turn), 0,                                            //
        std::sin(tilt) * std::sin(turn), std::sin(tilt) * std::cos(turn), std::cos(tilt),  //
        -std::cos(tilt) * std::sin(turn), -std::cos(tilt) * std::cos(turn), std::sin(tilt);
    return axes * (packing.positions.colwise() - packing.positions.rowwise().mean());
}

Chart picture_of(const Packing& packing) {
    const Eigen::Matrix3Xd seen = seen_from_afar(packing);
    const std::vector<Index> order = back_to_front(seen);
    const std::vector<bool> shown = visible(seen, packing.radii, order);
    const double far = seen.row(2).minCoeff();
    const double depth = std::max(seen.row(2).maxCoeff() - far, 1e-300);
    Series discs{.name = "", .mark = Mark::discs};
    for (const Index particle : order) {
        if (!shown[static_cast<std::size_t>(particle)]) {
            continue;
        }
        const double nearness = 0.42 + 0.58 * std::pow((seen(2, particle) - far) / depth, 0.8);
        const double radius = packing.radii[particle];
        for (int k = 0; k < shades; ++k) {
            const double toward = static_cast<double>(k) / (shades - 1);
            const double shift = 0.36 * toward * radius;  // the light comes from the upper left
            add_disc(discs, seen(0, particle) - shift, seen(1, particle) + shift, radius * (1 - 0.86 * toward),
                     rgb_of(shade(toward, nearness)));
        }
    }
    return {.x = {.plain = "across", .unit = "m"}, .y = {.plain = "up", .unit = "m"}, .series = {discs}, .picture = true};
}

/// A particle as in a schematic drawing: a rim and its inside.
void add_outlined(Series& discs, double x, double z, double radius, int inside) {
    add_disc(discs, x, z, radius, rgb_of({40, 40, 40}));
    add_disc(discs, x, z, 0.88 * radius, inside);
}

}  // namespace

Drawing draw_packing(const Sources& sources) {
    const Packing& packing = sources.front().structure().structure.packing;
    return {
        .panels = {picture_of(packing)},
        .caption = std::to_string(packing.size()) + " spheres, volume fraction " + with_digits(volume_fraction(packing), 3) + "."};
}

Drawing draw_overview(const Sources& sources) {
    const FigureSource& source = sources.front();
    Drawing pores = draw_pore_curve({source});
    Chart& curve = pores.panels.front();
    curve.notes = {"degree of heterogeneity a = " + with_digits(source.number("/characterization/doh/a"), 3),
                   "coordination number C = " + with_digits(source.number("/characterization/coordination"), 3)};
    if (source.find("/mechanics/linear/storage_modulus/mean") != nullptr) {
        curve.notes.push_back(
            "shear modulus G' = " + with_digits(source.number("/mechanics/linear/storage_modulus/mean") / 1e6, 3) + " MPa");
    }
    const Drawing packing = draw_packing(sources);
    return {.panels = {packing.panels.front(), curve}, .caption = packing.caption + " " + pores.caption};
}

Drawing draw_rheometer(const Sources& sources) {
    constexpr double layers = 3;  // as coagula shear --method dem has it
    const Packing& packing = sources.front().structure().structure.packing;
    if (!packing.cell.is_periodic()) {
        throw InputError(sources.front().file + " is open, but the plates of the shear test are made of periodic images");
    }
    const Eigen::Vector3d lengths = packing.cell.lengths();
    const double radius = mean_radius(packing);
    const double plate = layers * 2 * radius;
    Series discs{.mark = Mark::discs};
    const auto order = back_to_front(
        (Eigen::Matrix3Xd(3, packing.size()) << packing.positions.row(0), packing.positions.row(2), -packing.positions.row(1))
            .finished());
    for (const Index particle : order) {
        const Eigen::Vector3d place = packing.positions.col(particle);
        if (std::abs(place.y() - lengths.y() / 2) > 1.5 * radius) {
            continue;
        }
        for (const int period : {-1, 0, 1}) {
            const double z = place.z() + period * lengths.z();
            if (z > -plate && z < lengths.z() + plate) {
                add_outlined(discs, place.x(), z, packing.radii[particle],
                             rgb_of(period == 0 ? Colour{255, 255, 255} : Colour{150, 155, 160}));
            }
        }
    }
    const double top = lengths.z() + plate + 3 * radius;
    const Series arrow{.x = {0.25 * lengths.x(), 0.75 * lengths.x()}, .y = {top, top}, .mark = Mark::arrow, .colour = 1};
    const Chart chart{
        .x = {.plain = "x", .unit = "m"}, .y = {.plain = "z", .unit = "m"}, .series = {discs, arrow}, .picture = true};
    return {.panels = {chart},
            .caption =
                "Set-up of the shear test, a slice through " + sources.front().label +
                ". White: the sample, periodic along x and y. Grey: three layers of its periodic repetition; the lower ones stand "
                "still, the upper ones move along x (arrow)."};
}

}  // namespace coagula::report
