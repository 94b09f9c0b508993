# SPDX-License-Identifier: GPL-3.0-or-later
"""Moduli of structures that the diagnosis does not know, by other methods than its own: explicit time stepping and the frequency solver."""

import json
import os
import subprocess
import zlib
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy

import hertz
import network
import poroelastic
import pressed

PARTICLES = 400
STRUCTURES = 8
THINNED = (0.0, 0.02, 0.04, 0.06, 0.08, 0.1, 0.12, 0.14, 0.17, 0.2, 0.25, 0.3, 0.4)  # shares of missing contacts
FRACTIONS = (0.3, 0.35, 0.4, 0.45, 0.5)  # of the layers of a sample that has settled
FRACTIONS_KNOWN = (0.36, 0.44)           # of the diagnosis, KNOWN_EACH structures at each
KNOWN_EACH = 4
BREAKING = 32  # of a sample with bonds that break: what a few structures differ from very many is more than errors of 2 %
KNOWN = 16     # that the diagnosis may know
DRAGGED = 64   # of which each sample in a solvent that drags is made anew: floppy modes differ up to a hundredfold between structures
LOADS = (4.0, 8.0)  # largest strain of a sweep over the critical one
SWEEP_ROWS = 14
RUPTURE_ROWS, RUPTURE_LOAD = 28, 8.0  # of the sweeps of bonds whose strength depends on the rate
HERTZ_LOADS = tuple(0.05 * 10**(step / 8) for step in range(33))  # strains over the overlap at rest, over the radius
STIFFNESS = 100.0  # of a particle [N/m]; moduli are proportional to it
CONTACT = STIFFNESS / 2
RADIUS = 0.25e-6
COORDINATIONS = (5.4, 5.0, 4.7, 4.4, 4.15)  # of a structure series
SERIES_STRUCTURES = 4                       # behind each row of it
SERIES_KNOWN = 2                            # of the diagnosis behind each row
CONTACTS = {"bond-bending": (0.003, 0.03), "shear-stiffness": (0.3, 0.8), "bond-range": (0.025, 0.045)}
OSCILLATION = ["--steps-per-oscillation", "6000", "--damping", "0.7", "--orientation", "xz,yx,zy"]
SLOW_OSCILLATION = ["--steps-per-oscillation", "24000", "--damping", "0.7", "--orientation", "xz,yx,zy"]  # where losses count
RINGS = tuple(((ring + 0.5) / 60)**0.25 for ring in range(60))  # of equal shares of the torque: radius over that of the plates


class Material:
    """Structures in a folder and what was simulated of them, each number computed once."""

    def __init__(self, program, folder, shared=None):
        """@param shared folder of a bank that is there already, which is read only."""
        self.program = program
        self.folder = Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)
        self.bank = Path(shared or folder)
        self.results = self.folder / "material.json"
        self.known = {}
        for path in (self.bank / "material.json", self.results):
            self.known.update(json.loads(path.read_text()) if path.exists() else {})

    def prepare(self, jobs, breaking, series, contacts, dragged, rupture, settling, hertzian, loaded):
        """Everything that is not drawn: moduli of structures, with breaking, series, other contacts, a dragging solvent, bonds that heat helps to
        break and layers of several volume fractions if asked for; and those structures that the diagnosis may know."""
        coordinations = COORDINATIONS if series else ()
        kinds = [("", 0.0)] + [(cause, value) for cause, values in CONTACTS.items() for value in values if contacts]
        tasks = [("modulus", number, *contact) for number in range(STRUCTURES) for contact in kinds]
        tasks += [("modulus", number, *contact, coordination) for coordination in coordinations
                  for number in range(SERIES_STRUCTURES) for contact in kinds]
        if breaking:
            tasks += [("modulus", number) for number in range(STRUCTURES, BREAKING)]
            tasks += [("breaking", number, load) for number in range(BREAKING) for load in LOADS]
        tasks += [("elastic", number) for number in range(DRAGGED) if dragged]
        tasks += [("rupture", number) for number in range(BREAKING) if rupture]
        tasks += [("modulus", number, "volume-fraction", fraction) for fraction in FRACTIONS for number in range(STRUCTURES) if settling]
        tasks += [("pressed_curve", number) for number in range(STRUCTURES) if loaded]
        tasks += [("hertz_curve", number) for number in range(STRUCTURES) if hertzian]
        for number in range(DRAGGED if dragged else BREAKING if breaking or rupture else STRUCTURES):
            self.structure(number)
        for coordination in coordinations:
            for number in range(SERIES_STRUCTURES):
                self.structure(number, coordination=coordination)
        with ProcessPoolExecutor(jobs) as pool:
            for known_values in pool.map(computed, [(self.program, self.folder, task) for task in tasks]):
                self.known.update(known_values)
                self.keep()
        for number in range(DRAGGED if dragged else KNOWN):
            self.known_structure(number)
        for coordination in coordinations:
            for number in range(SERIES_KNOWN):
                self.known_structure(number, coordination)
        for fraction in FRACTIONS_KNOWN if settling else ():
            for number in range(KNOWN_EACH):
                self.known_structure(number, fraction=fraction)

    def known_structure(self, number, coordination=None, fraction=0.4):
        """One that the diagnosis may know."""
        words = [] if fraction == 0.4 else [fraction]
        path = self.bank / f"known_{'_'.join(map(str, [*words, *([] if coordination is None else [coordination]), number]))}.h5"
        if not path.exists():
            self.structure(number, seed=1, coordination=coordination, fraction=fraction).rename(path)
        return path

    def run(self, *words):
        done = subprocess.run([self.program, *map(str, words), "--threads", "1", "--json"], capture_output=True, text=True, check=True)
        return json.loads(done.stdout)

    def structure(self, number, seed=1000, coordination=None, fraction=0.4):
        words = [] if coordination is None else ["--target-coordination", coordination]
        denser = [] if fraction == 0.4 else [fraction]
        path = self.bank / f"hidden_{'_'.join(map(str, [PARTICLES, *denser, *words[1:], seed + number]))}.h5"
        if not path.exists():
            self.run("generate", "vem", "--particles", PARTICLES, "--voids", PARTICLES // 2, "--volume-fraction", fraction,
                     "--radius", RADIUS, "--seed", seed + number, *words, "-o", path)
        return path

    def remembered(self, key, compute):
        if key not in self.known:
            self.known[key] = compute()
            self.keep()
        return self.known[key]

    def keep(self):
        """Replaced as a whole, because other processes read it."""
        new = self.results.with_suffix(".new")
        new.write_text(json.dumps(self.known))
        new.rename(self.results)

    def with_fewer_contacts(self, path, share):
        """The same particles of which some have shrunk a little, so that about this share of the bonds is none any more."""
        made = self.folder / f"fewer_{path.name}"
        if not made.exists():
            points = self.folder / "points.csv"
            self.run("export", path, "--format", "csv", "-o", points, "--force")
            edges = self.run("info", path)["box"]
            header, *rows = points.read_text().splitlines()
            names = header.split(",")
            radius = next(k for k, name in enumerate(names) if name.startswith("radius"))
            generator = numpy.random.default_rng(zlib.crc32(path.name.encode()))
            table = [row.split(",") for row in rows]
            for row in table:
                # A bond is lost where either of its ends has shrunk by more than the distance of bonds.
                row[radius] = f"{float(row[radius]) * (0.97 if generator.random() < 1 - (1 - share)**0.5 else 1.0):.12g}"
            points.write_text("\n".join([header, *map(",".join, table)]) + "\n")
            self.run("import", points, "--box", ",".join(f"{edge}m" for edge in edges), "-o", made, "--force")
        return made

    def thinned(self, number, missing, coordination=None):
        """G' over that of all contacts where this share of them is missing at random, mean of three draws, by the solver of network.py."""
        def compute():
            places, radii, box = self.particles(self.structure(number, coordination=coordination))
            bonds = network.bonds_of(places, radii, box)
            generator = numpy.random.default_rng([number, round(1000 * missing), round(100 * (coordination or 0))])
            modulus = lambda some: network.shear_modulus(len(places), some, box, CONTACT, 0.1 * CONTACT)
            return float(numpy.mean([modulus(network.without(bonds, missing, generator)) for _ in range(3)]) / modulus(bonds))
        return self.remembered(f"thinned {number} {missing} {coordination}", compute)

    def particles(self, path):
        return particles_of(self.run, path, self.folder / "points.csv")

    def pulled(self, number, tension, coordination=None):
        """G' over that without where all contacts pull at rest with this force over their stiffness times the diameter (network.py)."""
        def compute():
            places, radii, box = self.particles(self.structure(number, coordination=coordination))
            bonds = network.bonds_of(places, radii, box)
            modulus = lambda pull: network.shear_modulus(len(places), bonds, box, CONTACT, 0.1 * CONTACT, pull * CONTACT)
            return modulus(tension) / modulus(0.0)
        return self.remembered(f"pulled {number} {tension} {coordination}", compute)

    def hertz_curve(self, number):
        """Stress over strain of a structure of Hertz contacts at HERTZ_LOADS over that of small strains, mean of three planes (hertz.py)."""
        def compute():
            places, radii, box = self.particles(self.structure(number))
            bonds = network.bonds_of(places, radii, box)
            return numpy.mean([hertz.secants(places, bonds, box, HERTZ_LOADS, plane) for plane in range(3)], axis=0).tolist()
        return self.remembered(f"hertz in three planes, steps of an eighth {number}", compute)

    def hertz(self, preload, strains):
        """G' of the fundamental over that of small strains, of Hertz contacts pressed in by `preload` radii, of several structures together."""
        curve = numpy.mean([self.hertz_curve(number) for number in range(STRUCTURES)], axis=0)
        phases = (numpy.arange(200) + 0.5) / 200 * numpy.pi / 2
        loads = numpy.log(numpy.outer(numpy.atleast_1d(strains), numpy.sin(phases)) / preload)
        secants = numpy.exp(numpy.interp(loads, numpy.log(HERTZ_LOADS), numpy.log(curve)))
        return 2 * numpy.mean(secants * numpy.sin(phases)**2, axis=1)

    def pressed_curve(self, number):
        """G' between plates that press at pressed.PRESSURES over that of a sample without load."""
        def compute():
            places, radii, box = self.particles(self.structure(number))
            return pressed.growth(places, network.bonds_of(places, radii, box)).tolist()
        return self.remembered(f"pressed {number}", compute)

    def pressed(self, number, pressures):
        return numpy.interp(pressures, pressed.PRESSURES, self.pressed_curve(number))

    def left_by_bonds(self, number, share):
        """G' over that of all bonds where these shares of them are there, along straight lines."""
        curve = [self.thinned(number, missing) if missing else 1.0 for missing in THINNED]
        return numpy.interp(1 - share, THINNED, curve)

    def elastic(self, number):
        """G' of a structure by the solver."""
        return self.remembered(f"plain {number}", lambda: self.shear(self.structure(number))["storage_modulus"]["mean"])

    def mean_drag(self, ratio, frequencies, numbers):
        """G* over the elastic G' of these structures together with a solvent that drags, whose viscosity over the particles' stiffness is `ratio`."""
        def compute(number):
            model = self.folder / "drag.toml"
            model.write_text(f"solvent_viscosity = {ratio * STIFFNESS}\n")
            found = self.shear(self.structure(number), "--model", model, "--frequency", ",".join(f"{each}Hz" for each in frequencies))
            return [numpy.atleast_1d(found[part]["mean"]).tolist() for part in ("storage_modulus", "loss_modulus")]
        values = [self.remembered(f"drag {number} {ratio:.6g} {list(frequencies)}", lambda number=number: compute(number))
                  for number in numbers]
        storage, loss = numpy.mean(values, axis=0)
        return (storage + 1j * loss) / numpy.mean([self.elastic(number) for number in numbers])

    def shear(self, path, *words):
        return self.run("shear", path, "-o", self.folder / "sheared.h5", "--force", *words)

    def explicit(self, path, *words, oscillation=OSCILLATION):
        return self.shear(path, "--method", "dem", "--boundary", "periodic", *oscillation, *words)

    def modulus(self, number, cause="", value=0.0, coordination=None):
        """G' of a structure with springs of unit stiffness and perhaps another contact, by small oscillations."""
        def compute():
            if cause == "prestress":
                return self.modulus(number, coordination=coordination) * self.pulled(number, value, coordination)
            if cause == "missing-contacts":
                return self.modulus(number, coordination=coordination) * self.thinned(number, value, coordination)
            model = self.folder / "contact.toml"
            stiffness = f"bending_stiffness = {value * CONTACT * RADIUS**2}\ntwisting_stiffness = {value * CONTACT * RADIUS**2}\n"
            model.write_text({"bond-bending": stiffness, "shear-stiffness": f"shear_stiffness = {value * STIFFNESS}\n"}.get(cause, ""))
            words = ["--model", model] if model.stat().st_size else []
            words += ["--bond-tolerance", value] if cause == "bond-range" else []
            path = self.structure(number, coordination=coordination, fraction=value if cause == "volume-fraction" else 0.4)
            path = self.with_fewer_contacts(path, value) if cause == "contacts-removed" else path
            found = self.explicit(path, "--oscillations", 3, "--amplitude", "1e-6", "--constant-amplitude", *words)
            return float(numpy.mean([each[-1] for each in found["oscillations"]["fundamental_storage_modulus"]]))
        return self.remembered(f"modulus {number} {cause} {value} {coordination}", compute)

    def mean_modulus(self, cause="", value=0.0):
        """Of a sample as large as the first structures together."""
        return float(numpy.mean([self.modulus(number, cause, value) for number in range(STRUCTURES)]))

    def breaking(self, number, load):
        """G* over G' of the fundamental, as a rheometer shows it, at strains growing linearly to `load` times the critical strain, bonds breaking."""
        def compute():
            strength = 1e-4 * CONTACT * RADIUS
            model = self.folder / "strength.toml"
            model.write_text(f"normal_strength = {strength}\nshear_strength = {strength}\n")
            slowly = lambda *words: self.explicit(self.structure(number), *words, oscillation=SLOW_OSCILLATION)["oscillations"]
            broken = slowly("--oscillations", SWEEP_ROWS, "--amplitude", load * 1e-4, "--model", model)
            whole = slowly("--oscillations", 3, "--amplitude", "1e-6", "--constant-amplitude")
            mean = lambda part, of: numpy.mean(of[part], axis=0)
            unbroken = mean("fundamental_storage_modulus", whole)[-1]
            storage = mean("fundamental_storage_modulus", broken) / unbroken
            loss = (mean("fundamental_loss_modulus", broken) - mean("fundamental_loss_modulus", whole)[-1]) / unbroken
            return [storage.tolist(), loss.tolist()]
        storage, loss = self.remembered(f"breaking {number} {load}", compute)
        return numpy.array(storage) + 1j * numpy.array(loss)

    def mean_breaking(self, load, rim=False):
        """Of a sample as large as all such structures together: G* over G' of their mean, or what the torque shows of it between plates, where the
        strain grows from 0 at the axis to that of the table at the rim."""
        weights = [self.modulus(number) for number in range(BREAKING)]
        whole = numpy.average([self.breaking(number, load) for number in range(BREAKING)], axis=0, weights=weights)
        return numpy.mean([at_radius(whole, ring) for ring in RINGS], axis=0) if rim else whole

    def rupture(self, number):
        """As `breaking`, in one orientation of each structure, which costs a third, and in finer steps, from which other loads are read."""
        def compute():
            strength = 1e-4 * CONTACT * RADIUS
            model = self.folder / "strength.toml"
            model.write_text(f"normal_strength = {strength}\nshear_strength = {strength}\n")
            slow = [*SLOW_OSCILLATION[:-1], SLOW_OSCILLATION[-1].split(",")[number % 3]]
            slowly = lambda *words: self.explicit(self.structure(number), *words, oscillation=slow)["oscillations"]
            broken = slowly("--oscillations", RUPTURE_ROWS, "--amplitude", RUPTURE_LOAD * 1e-4, "--model", model)
            whole = slowly("--oscillations", 3, "--amplitude", "1e-6", "--constant-amplitude")
            return [[each["fundamental_storage_modulus"][0], each["fundamental_loss_modulus"][0]] for each in (broken, whole)]
        (storage, loss), (whole, damping) = self.remembered(f"rupture {number}", compute)
        return numpy.array(storage) + 1j * (numpy.array(loss) - damping[-1]), whole[-1]

    def mean_rupture(self, load):
        """G* over G' of all such structures together where strains grow in even steps to `load` times the critical one."""
        sweeps, whole = zip(*(self.rupture(number) for number in range(BREAKING)))
        strains = numpy.arange(1, SWEEP_ROWS + 1) * load / RUPTURE_LOAD / SWEEP_ROWS
        return shown_at(numpy.sum(sweeps, axis=0) / numpy.sum(whole), strains)

    def consolidation(self, radius):
        """What the torque of plates shows of the solvent that leaves, their radius over the gap given: times and shares."""
        return self.remembered(f"consolidation {radius:.6g}", lambda: [each.tolist() for each in poroelastic.Layer(radius).course()])

    def layers(self, fractions):
        """G' of layers of these volume fractions over that of the fraction 0.4: a parabola through the logarithms of the moduli of structures."""
        means = [numpy.mean([self.modulus(number, "volume-fraction", fraction) for number in range(STRUCTURES)]) for fraction in FRACTIONS]
        parabola = numpy.polynomial.Polynomial.fit(FRACTIONS, numpy.log(means), 2)
        return numpy.exp(parabola(fractions) - parabola(0.4))

    def sketch(self):
        """The same with losses by their closed form, to choose how strong an effect is to be."""
        return Sketch(self)

    def losses(self, number, ratio, exponent, frequencies):
        """G* over the elastic G' with a springpot beside every spring."""
        return self.with_elements(number, f"losses {number} {ratio} {exponent}", lambda stiffness: {
            "springpot_stiffness": ratio * stiffness, "springpot_time": 1 / (2 * numpy.pi), "springpot_exponent": exponent}, frequencies)

    def dashpots(self, number, time, frequencies):
        return self.with_elements(number, f"dashpots {number} {time}", lambda stiffness: {"viscosity": time * stiffness}, frequencies)

    def relaxing(self, number, share, time, frequencies):
        return self.with_elements(number, f"relaxing {number} {share} {time}", lambda stiffness: {
            "maxwell_stiffness": share * stiffness, "maxwell_time": time}, frequencies)

    def with_elements(self, number, key, elements, frequencies):
        """G* over the elastic G' with these elements beside every spring of a stiffness, by the frequency solver."""
        def compute():
            model = self.folder / "loss.toml"
            lines = [f"{part}_{name} = {value}" for part, stiffness in (("normal", CONTACT), ("shear", 0.1 * CONTACT))
                     for name, value in elements(stiffness).items()]
            model.write_text("\n".join(lines) + "\n")
            words = ["--frequency", ",".join(f"{each}Hz" for each in frequencies)]
            found = self.shear(self.structure(number), "--model", model, *words)
            plain = self.remembered(f"plain {number}", lambda: self.shear(self.structure(number))["storage_modulus"]["mean"])
            return [(numpy.array(found[part]["mean"]) / plain).tolist() for part in ("storage_modulus", "loss_modulus")]
        storage, loss = self.remembered(f"{key} {list(frequencies)}", compute)
        return numpy.array(storage) + 1j * numpy.array(loss)


def at_radius(sweep, radius):
    """What a sweep in even steps shows where all its strains are this part as large."""
    return shown_at(sweep, radius * numpy.arange(1, len(sweep) + 1) / len(sweep))


def shown_at(sweep, strains):
    """What a sweep in even steps, to a strain of 1, shows in one to these strains: G' between its rows; the energy that is lost in a row is that of the
    bonds that break between the strain before and its own."""
    rows = numpy.arange(len(sweep) + 1) / len(sweep)
    energy = numpy.concatenate([[0], numpy.cumsum(sweep.imag * rows[1:]**2)])
    storage = numpy.interp(strains, rows, numpy.concatenate([[1], sweep.real]))
    return storage + 1j * numpy.diff(numpy.interp(numpy.concatenate([[0], strains]), rows, energy)) / strains**2


def particles_of(run, path, points):
    """Centres, radii and edges of the box of a structure [m]. run(words) runs the program; `points` is a file for what it exports."""
    run("export", path, "--format", "csv", "-o", points, "--force")
    header, *rows = points.read_text().splitlines()
    columns = dict(zip((name.split()[0] for name in header.split(",")), numpy.array([row.split(",") for row in rows], float).T))
    return numpy.stack([columns[name] for name in "xyz"], axis=1), columns["radius"], numpy.array(run("info", path)["box"])


def computed(task):
    """What a method of Material computes, in a process of its own: all that it knows afterwards."""
    program, folder, (method, *words) = task
    material = Material(program, folder / f"process{os.getpid()}", shared=folder)
    getattr(material, method)(*words)
    return material.known


class Sketch:
    def __init__(self, material):
        self.modulus, self.mean_modulus, self.mean_breaking = material.modulus, material.mean_modulus, material.mean_breaking
        self.left_by_bonds, self.mean_rupture, self.layers = material.left_by_bonds, material.mean_rupture, material.layers
        self.consolidation, self.hertz, self.pressed = material.consolidation, material.hertz, material.pressed

    def losses(self, number, ratio, exponent, frequencies):
        return 1 + ratio * (1j * numpy.asarray(frequencies))**exponent

    def dashpots(self, number, time, frequencies):
        return 1 + 2j * numpy.pi * numpy.asarray(frequencies) * time

    def relaxing(self, number, share, time, frequencies):
        turned = 2j * numpy.pi * numpy.asarray(frequencies) * time
        return 1 + share * turned / (1 + turned)
