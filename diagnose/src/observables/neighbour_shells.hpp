// Mean number of neighbours of a particle in shells of distance: what coordinates say about contacts.
#pragma once

#include <coagula/common/packing.hpp>

#include <Eigen/Core>

#include <vector>

namespace coagula::diagnose {

/// Shells of equal width, the contact distance in the middle of one; all lengths over the diameter.
constexpr int shell_count = 16;
constexpr double shell_width = 0.1;
constexpr double first_shell = 0.55;  ///< where the first begins
constexpr double shell_reach = first_shell + shell_count * shell_width;

struct NeighbourShells {
    std::vector<double> mean;             ///< neighbours of a particle, one per shell
    std::vector<double> standard_errors;  ///< as if pairs were independent; of an empty shell, as if it had one
    Index centres = 0;
};

/// Of measured coordinates: particles farther than the reach of the shells from the faces of the box around all are the centres.
/// @param positions 3 x N [m].
NeighbourShells shells_of_points(const Eigen::Matrix3Xd& positions, double diameter);

/// Of a periodic structure whose particles are found with errors: independent normal ones with these standard deviations in the
/// plane and along z [m], drawn from a fixed seed, several times where the structure is small. Packings too small for the reach are
/// refused by std::invalid_argument.
std::vector<double> shells_of_structure(const Packing& packing, double sigma_plane, double sigma_axis);

/// Mean number of particles of a periodic structure in the shells about random places that are not nearer than half a diameter to a
/// centre: where a search for particles finds one that is none. Nearer than that it takes both for one (the separation that Crocker
/// and Grier, J. Colloid Interface Sci. 179 (1996) 298, ask for between two centres is that of touching images). Last, the
/// particles per cube of the diameter.
std::vector<double> shells_about_free_places(const Packing& packing);

/// Volume of a shell over the cube of the diameter.
double shell_volume(std::size_t shell);

}  // namespace coagula::diagnose
