// SPDX-License-Identifier: GPL-3.0-or-later
// Mean number of neighbours of a particle in shells of distance: what coordinates say about contacts.
#pragma once

#include <coagula/common/packing.hpp>

#include <Eigen/Core>

#include <vector>

namespace coagula::diagnose {

/// Shells of equal width, the contact distance in the middle of one; all lengths over the diameter. Each has two halves of equal
/// solid angle, because microscopes find centres better in the plane than along z: neighbours nearer to the plane than 30 degrees,
/// and those nearer to z than 60. The first shells are those near the plane.
constexpr int shells_of_direction = 16;
constexpr int shell_count = 2 * shells_of_direction;
constexpr double shell_width = 0.1;
constexpr double first_shell = 0.55;  ///< where the first begins
constexpr double shell_reach = first_shell + shells_of_direction * shell_width;

/// Whether a shell is one of those near z.
constexpr bool is_along_axis(std::size_t shell) {
    return shell >= shells_of_direction;
}

/// Inner radius of a shell.
constexpr double inner_end(std::size_t shell) {
    return first_shell + shell_width * static_cast<double>(shell % shells_of_direction);
}

struct NeighbourShells {
    std::vector<double> mean;  ///< neighbours of a particle, one per shell
    std::vector<double>
        variances;  ///< of the number of neighbours of all centres, as if pairs were independent (beside errors_of_density)
    Index centres = 0;
    double mutual = 0;  ///< share of the neighbours that are centres, too
};

/// Neighbours in measured coordinates: the centres are particles farther than the reach of the shells from the faces of the box
/// around all.
/// @param positions 3 x N [m].
NeighbourShells shells_of_points(const Eigen::Matrix3Xd& positions, double diameter);

/// Consecutive shells that are compared together.
struct ShellGroup {
    int first;
    int count;
    double variance;
};

/// Shells of too few neighbours for a normal error go with the next ones, but not across the contact and not to another direction.
std::vector<ShellGroup> groups_of_shells(const std::vector<double>& variances);

/// Standard error of a number with this Poisson variance as counted; of a small one, that of its upper limit (Gehrels, Astrophys.
/// J. 303 (1986) 336, eq. 7), since a count of none tells little about its mean.
double error_of_count(double variance);

/// Mean numbers of neighbours in a periodic structure whose particles are found with errors: independent normal ones with these
/// standard deviations in the plane and along z [m], drawn from a fixed seed, several times where the structure is small. Each of
/// its axes is z in turn: no direction of a structure is another than the others. Packings too small for the reach are refused by
/// std::invalid_argument.
std::vector<double> shells_of_structure(const Packing& packing, double sigma_plane, double sigma_axis);

/// How the neighbours of the particles of a periodic structure vary, mean of its three axes: their mean number in each shell, then,
/// column by column, the covariance of those of a particle, and that of a particle with all others within the reach of the shells
/// together.
std::vector<double> spread_of_neighbours(const Packing& packing);

/// Errors of the mean over so many particles of structures with such a spread, as independent standard errors: shells x errors.
Eigen::MatrixXd errors_of_structures(const std::vector<double>& spread, double particles);

/// What independent pairs leave out in an image of such structures: where particles lie close, all have many neighbours. The part
/// of the spread that is above that of independent pairs, likewise.
/// @param mutual share of the neighbours that are centres, too: as NeighbourShells.
Eigen::MatrixXd errors_of_density(const std::vector<double>& spread, double centres, double mutual);

/// Mean number of particles of a periodic structure in the shells about random places that are not nearer than half a diameter to a
/// centre: where a search for particles finds one that is none. Nearer than that it takes both for one (the separation that Crocker
/// and Grier, J. Colloid Interface Sci. 179 (1996) 298, ask for between two centres is that of touching images). Last, the
/// particles per cube of the diameter.
std::vector<double> shells_about_free_places(const Packing& packing);

/// Volume of a shell, which is half of a whole one, over the cube of the diameter.
double shell_volume(std::size_t shell);

}  // namespace coagula::diagnose
