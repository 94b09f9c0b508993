// SPDX-License-Identifier: GPL-3.0-or-later
// Figures of the measures as one writes them in a paper: title, axes, curves and a sentence. What is not named here takes the words of its
// data sets.

/** The figure of the data sets of one folder that have one unit. */
export interface FigureName {
  title: string;
  /** What the axes show, without unit. */
  x: string;
  y: string;
  note: string;
  /** Names of the curves by the last part of their path. */
  curves?: Record<string, string>;
}

/** Parts of the page, in their order, and the folders whose figures stand there. */
export const sections: { title: string; folders: string[] }[] = [
  { title: "Pores", folders: ["pore_curve", "gelb_gubbins", "delaunay_pores", "chord_lengths", "free_spheres", "sampled_check", "transport"] },
  { title: "Contacts", folders: ["coordination_histogram", "bond_angles", "bond_order", "common_neighbours", "rings", "rigidity", "rigidity_central", "topology", "fabric"] },
  { title: "Positions", folders: ["pair_correlation", "structure_factor", "neighbour_distances", "voronoi", "density_fluctuations", "minkowski"] },
];

const density = "probability density";

/** By folder and unit below /characterization or /mechanics. */
export const figureNames: Record<string, FigureName> = {
  "gelb_gubbins 1": { title: "Pore sizes after Gelb and Gubbins", x: "pore radius r", y: "P(pore radius > r)",
    note: "Share of the void space that some empty sphere of radius r covers.", curves: { exceeding: "P" } },
  "delaunay_pores 1": { title: "Pores and throats of the Delaunay tessellation", x: "radius r", y: "share above r",
    note: "Share of the circumspheres of the tetrahedra, and of the throats between them, whose radius exceeds r.",
    curves: { circumspheres: "circumspheres", throats: "throats" } },
  "sampled_check 1": { title: "Pore curve by random points", x: "pore radius r", y: "P(pore radius > r)",
    note: "The pore curve from random points in the void space, a check of the exact one." },
  "chord_lengths/void m-1": { title: "Chords in the void", x: "length of the chord", y: density,
    note: "Lengths of the pieces that straight lines have in the void space." },
  "chord_lengths/solid m-1": { title: "Chords in the spheres", x: "length of the chord", y: density,
    note: "Lengths of the pieces that straight lines have in the spheres." },
  "bond_angles rad-1": { title: "Bond angles", x: "angle between two contacts", y: density,
    note: "Angles between the contacts of a particle." },
  "bond_order 1": { title: "Bond-orientational order", x: "q₄, q₆", y: density,
    note: "Distribution over the particles of the bond-orientational order parameters of Steinhardt, facets of the Voronoi cells weighted by their area.",
    curves: { q4_density: "q₄", q6_density: "q₆" } },
  "rings 1": { title: "Rings of contacts", x: "particles of the ring", y: "number", note: "Shortest-path rings of the contact network by their number of particles.",
    curves: { count: "rings", per_particle: "rings per particle" } },
  "rigidity 1": { title: "Local redundancy", x: "redundant constraints at a particle", y: density,
    note: "States of self-stress shared out to the particles.", curves: { redundancy_density: "redundancy" } },
  "rigidity_central 1": { title: "Local redundancy, central forces", x: "redundant constraints at a particle", y: density,
    note: "States of self-stress of central forces, shared out to the particles.", curves: { redundancy_density: "redundancy" } },
  "pair_correlation 1": { title: "Pair correlation function", x: "distance of the centres r", y: "g(r)",
    note: "Pairs of particles at distance r over those of an ideal gas of the same density.", curves: { g: "g(r)", neighbours: "neighbours within r" } },
  "pair_correlation/by_contact 1": { title: "Pair correlation function over the contact distance", x: "distance of the centres over r₁ + r₂", y: "g",
    note: "Pairs of particles over those of an ideal gas, against their distance over that at contact.", curves: { g: "g", neighbours: "neighbours within" } },
  "structure_factor 1": { title: "Structure factor", x: "wave number q", y: "S(q)",
    note: "Directly from the positions, and transformed from g(r).", curves: { direct: "from the positions", transformed: "from g(r)", vectors: "wave vectors" } },
  "neighbour_distances m-1": { title: "Nearest neighbours", x: "distance to the nearest centre", y: density,
    note: "Distance from a centre to the nearest other one." },
  "voronoi 1": { title: "Voronoi cells", x: "free volume over its mean", y: density,
    note: "Volume of the Voronoi cell of a particle less the smallest possible one, over the mean of that; and the gamma law.",
    curves: { density: "measured", fit: "gamma law" } },
  "density_fluctuations 1": { title: "Density fluctuations", x: "edge of the window", y: "relative deviation",
    note: "Standard deviation of the solid volume in cubic windows over its mean, against the edge of the windows." },
  "minkowski 1": { title: "Volume of the growing spheres", x: "increase of the radii", y: "volume fraction",
    note: "Union of the spheres as all radii grow by the same length: its share of the volume." },
  "minkowski m-1": { title: "Surface of the growing spheres", x: "increase of the radii", y: "surface per volume",
    note: "Union of the spheres as all radii grow by the same length: its surface over the volume." },
  "minkowski m-2": { title: "Mean curvature of the growing spheres", x: "increase of the radii", y: "mean curvature per volume",
    note: "Union of the spheres as all radii grow by the same length: its integrated mean curvature over the volume." },
  "minkowski m-3": { title: "Euler characteristic of the growing spheres", x: "increase of the radii", y: "χ per volume",
    note: "Union of the spheres as all radii grow by the same length: its Euler characteristic χ (bodies less tunnels plus cavities) over the volume." },
};

const words: Record<string, string> = {
  storage_modulus: "storage modulus G′", loss_modulus: "loss modulus G″", complex_contact_stiffness: "complex stiffness of a contact",
  stress: "shear stress", strain: "shear strain", force_distribution: "forces in the bonds", amplitude: "strain amplitude",
  mean: "mean", std: "standard deviation over the orientations", phase: "phase angle", dissipation: "dissipation",
};

/** Part of a path in words. */
export function inWords(part: string): string {
  return words[part] ?? part.replaceAll("_", " ");
}
