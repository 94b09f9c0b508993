# SPDX-License-Identifier: GPL-3.0-or-later
"""Particles as a microscope finds them, and the pores between them, of samples that the diagnosis does not know; counted by numpy and scipy."""

from dataclasses import dataclass

import numpy
from scipy.spatial import cKDTree

from session import Hidden

RADIUS = 0.25e-6
IMAGED, COAGULATED = 700, 300  # particles of a sample
POOL = 12                      # samples of each kind, of which each run sees two
KNOWN = {"vem": ["particles = 500"], "brownian": ["particles = 300"]}
SHELLS = numpy.arange(0.55, 2.2, 0.1)  # over the diameter
PORES = numpy.linspace(0.02, 1.0, 25) * RADIUS


def sample(material, number, hidden, generator="vem"):
    """Centres, radii and box of one."""
    if generator == "brownian":
        words = ["--particles", COAGULATED, "--surface-potential", hidden.potential, "--debye-length", 1e-8 / hidden.ions**0.5,
                 "--stop-coordination", 4.69]
    else:
        words = ["--particles", IMAGED, "--voids", IMAGED // 2]
        words += ["--size-distribution", f"lognormal:{hidden.sizes}"] if hidden.sizes else []
    path = material.bank / f"imaged_{generator}_{hidden.sizes}_{hidden.potential}_{hidden.ions}_{number}.h5"
    if not path.exists():
        material.run("generate", generator, "--volume-fraction", 0.4, "--radius", RADIUS, "--seed", 4000 + number, *words, "-o", path)
    return material.particles(path)


def seen(particles, hidden, generator):
    """Centres that are found."""
    places, _, box = particles
    if not hidden.images:
        return places
    plane, axis, missed, false = hidden.images
    found = places[generator.random(len(places)) >= missed]
    extra = []
    while len(extra) < false / (1 - false) * len(found):
        place = generator.random(3) * box
        branch = places - place
        branch -= box * numpy.round(branch / box)
        if numpy.linalg.norm(branch, axis=1).min() > RADIUS:
            extra.append(place)
    found = found + numpy.array([plane, plane, axis]) * generator.standard_normal(found.shape)
    return numpy.vstack([found, *extra])


def shells(centres):
    """Neighbours of a centre in each shell, of those far from the faces."""
    low, high = centres.min(axis=0) + 4.3 * RADIUS, centres.max(axis=0) - 4.3 * RADIUS
    inner = centres[numpy.all((centres > low) & (centres < high), axis=1)]
    distances = numpy.linalg.norm(inner[:, None] - centres[None], axis=2) / (2 * RADIUS)
    return numpy.histogram(distances[distances > 0], SHELLS)[0] / len(inner)


def pore_curve(particles, generator, points=170000):
    """Share of the space between the spheres that is farther from any surface than PORES; a hundred thousand points lie there."""
    places, radii, box = particles
    tree = cKDTree(places % box, boxsize=box)
    distances, nearest = tree.query(generator.random((points, 3)) * box)
    free = distances - radii[nearest]
    free = free[free > 0]
    return numpy.array([numpy.mean(free > pore) for pore in PORES])


@dataclass
class Images:
    hidden: Hidden
    kind: str         # "coordinates" or "pore-curve"
    numbers: tuple    # of the samples
    generator: str = "vem"
    stated: Hidden = Hidden()  # what the recipe knows
    stiffness: float = float("nan")

    def write(self, material, folder, generator):
        folder.mkdir(parents=True, exist_ok=True)
        lines = ["[sample]", f"particle_radius = {RADIUS}", "volume_fraction = 0.4", "", "[structures]", f'generator = "{self.generator}"',
                 *KNOWN[self.generator], "seeds = [1, 2]", ""]
        if self.generator == "brownian":
            lines[-2:-2] = [f"surface_potential = {self.stated.potential}"]
        for number in self.numbers:
            particles = sample(material, number, self.hidden, self.generator)
            if self.kind == "coordinates":
                rows = ["x [m],y [m],z [m]"] + [",".join(f"{x:.9g}" for x in centre) for centre in seen(particles, self.hidden, generator)]
            else:
                rows = ["pore_radius [m],exclusion_probability"]
                rows += [f"{pore:.9g},{share:.9g}" for pore, share in zip(PORES, pore_curve(particles, generator))]
            (folder / f"table{number}.csv").write_text("\n".join(rows) + "\n")
            lines += ["[[measurement]]", f'kind = "{self.kind}"', f'file = "table{number}.csv"', f'sample = "{number}"', ""]
        path = folder / "experiment.toml"
        path.write_text("\n".join(lines))
        return path

    def gain(self, material):
        """How far the means of such samples are from those without anything hidden: chi-square with the scatter of these over two of them."""
        def measured(hidden):
            generator = numpy.random.default_rng(1)
            each = [sample(material, number, hidden, self.generator) for number in range(POOL)]
            return numpy.array([shells(seen(one, hidden, generator)) if self.kind == "coordinates" else pore_curve(one, generator) for one in each])
        key = lambda hidden: f"{self.kind} {self.generator} {hidden.images} {hidden.sizes} {hidden.potential} {hidden.ions}"
        curves = [numpy.array(material.remembered(key(hidden), lambda hidden=hidden: measured(hidden).tolist())) for hidden in (self.hidden, self.stated)]
        # Bins scatter together: along the principal axes of the scatter that stand out.
        difference = curves[0].mean(axis=0) - curves[1].mean(axis=0)
        _, sizes, axes = numpy.linalg.svd(curves[1] - curves[1].mean(axis=0), full_matrices=False)
        return float(2 * numpy.sum((axes[:5] @ difference)**2 / (sizes[:5]**2 / (POOL - 1))))
