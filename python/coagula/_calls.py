# SPDX-License-Identifier: GPL-3.0-or-later
"""The stages. Options, units, ranges and sentences are those of the program."""

import contextlib
import json
import os
import tempfile

import numpy as np

from . import _coagula
from ._options import call_text, documented, values
from ._results import Result, from_json, from_stage

REQUIRED = __import__("inspect").Parameter.empty
_PACKING = ("packing", "Packing | Generated | Structure", REQUIRED, "The packing, or something that has one.")
_RADII = ("radii", "ArrayLike | None", None, "Radii of the particles [m], array (N,), instead of particles, radius and size_distribution.")


def packing_of(value):
    """The packing itself, or that of a generated structure or a file."""
    packing = getattr(value, "packing", value)
    if not isinstance(packing, _coagula.Packing):
        raise TypeError(f"{type(value).__name__} is no packing and has none: give a coagula.Packing, what a generator made or read")
    return packing


def _potential_of(value):
    """What a generated structure or a file says about the bonds of its potential: single numbers by name."""
    for path in ("potential", "generation/brownian/potential"):
        if isinstance(value, Result) and path in value and isinstance(value[path], Result):
            return {name: number for name, number in value[path].flat().items() if isinstance(number, float)}
    return {}


def _numbers(items, unit):
    """An array of numbers, or of texts with a unit."""
    return np.array([_coagula.parse_quantity(value, unit) if isinstance(value, str) else value for value in items], dtype=float)


def _radii(radii):
    if radii is None:
        return np.empty(0)
    array = _numbers(radii, "m")
    if array.ndim != 1 or len(array) == 0 or not np.all(np.isfinite(array)) or np.any(array <= 0):
        raise _coagula.InputError("radii must be a list of positive numbers, one for each particle")
    return array


@documented("generate_vem", extra=[_RADII], returns="Generated")
def generate_vem(*, radii=None, progress=None, threads=None, **options):
    """Returns the packing and what is known of it: .packing, .bonds, .coordination, .void_radius ...

    Schenker, Filser, Gauckler, Aste, Herrmann, Phys. Rev. E 80 (2009) 021302.
    """
    call = call_text("generate_vem", [], {**options, "radii": radii})
    stage = _coagula.generate_vem(values("generate_vem", options, threads), call, _radii(radii), progress)
    return from_stage(stage, "VoidExpansion")


@documented("generate_brownian", returns="Generated", extra=[
    _RADII, ("start", "Packing | Generated | Structure | None", None, "Go on from this packing instead of a suspension in equilibrium.")])
def generate_brownian(*, radii=None, start=None, progress=None, threads=None, **options):
    """Returns the packing and the run: .packing, .bonds, .frames, .series.time, .series.coordination ...

    docs/explanation/brownian.md has forces, contacts, steps and limits.
    """
    call = call_text("generate_brownian", [], {**options, "radii": radii, "start": start})
    first = None if start is None else packing_of(start)
    stage = _coagula.generate_brownian(values("generate_brownian", options, threads), call, _radii(radii), first, progress)
    return from_stage(stage, "BrownianRun")


@documented("characterize", first=[_PACKING], returns="Stage")
def characterize(packing, *, progress=None, threads=None, **options):
    """Returns what was measured: .coordination, .doh.a, .pore_size.mean, .pore_curve.radius ..."""
    call = call_text("characterize", ["packing"], options)
    stage = _coagula.characterize(values("characterize", options, threads), call, packing_of(packing), _potential_of(packing),
                                  progress)
    return from_stage(stage, "Characterization")


@documented("compare_heterogeneity", returns="Result", first=[
    ("first", "Packing | Generated | Structure", REQUIRED, "A structure."),
    ("second", "Packing | Generated | Structure", REQUIRED, "The other one."),
    ("names", "Sequence[str]", ("first", "second"), "What the answer calls them.")])
def compare_heterogeneity(first, second, names=("first", "second"), *, progress=None, threads=None, **options):
    """Returns what `coagula characterize --compare` prints: .more_heterogeneous, .agreement, .verdict, .measures.pore_sizes ..."""
    if isinstance(names, str) or len(names) != 2:
        raise _coagula.InputError("names must be two texts, one for each structure")
    found = _coagula.compare_heterogeneity(values("compare_heterogeneity", options, threads), [str(name) for name in names],
                                           [packing_of(first), packing_of(second)], progress)
    return from_json(json.loads(found), "Comparison")


@contextlib.contextmanager
def _model_file(model):
    """A contact model as the file that the program reads; parameters may be given as a dictionary."""
    if not isinstance(model, dict):
        yield model
        return
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "model.toml")
        with open(path, "w", encoding="utf-8") as file:
            for name, value in model.items():
                shown = json.dumps(value) if isinstance(value, str) else repr(float(value))
                file.write(f"{json.dumps(str(name))} = {shown}\n")
        try:
            yield path
        except _coagula.InputError as error:
            raise _coagula.InputError(str(error).replace(path, "model")) from None


@documented("shear", first=[_PACKING], replaced=["model"], returns="Stage", extra=[
    ("model", "str | dict[str, float | str] | None", None,
     "The contact in full and the solvent: a TOML file, or a dictionary of its parameters (docs/reference/contact-model.md).")])
def shear(packing, *, model=None, progress=None, threads=None, **options):
    """Returns the response: .storage_modulus.mean, .elastic_tensor, .per_particle.nonaffine_displacement_xy ...

    With frequency or frequency_sweep the springs may have losses; method "quasistatic" and "dem" go beyond the linear regime.
    """
    call = call_text("shear", ["packing"], {**options, "model": model})
    with _model_file(model) as path:
        stage = _coagula.shear(values("shear", {**options, "model": path}, threads), call, packing_of(packing),
                               _potential_of(packing), progress)
    return from_stage(stage, stage.group.rpartition("/")[2].capitalize() + "Response")


@documented("calibrate", first=[("packings", "Sequence[Packing | Generated | Structure]", REQUIRED, "The structures.")],
            returns="Result")
def calibrate(packings, *, progress=None, threads=None, **options):
    """Returns a series of moduli for each structure, and with `measured` the stiffness that matches: .calibration."""
    given = [packing_of(packing) for packing in packings]
    if not given:
        raise _coagula.InputError("calibrate needs at least one structure")
    names = [f"packings[{k}]" for k in range(len(given))]
    return from_json(json.loads(_coagula.calibrate(values("calibrate", options, threads), names, given, progress)), "Calibration")


@documented("fit_power_law", returns="Result", first=[
    ("a", "ArrayLike", REQUIRED, "Degree of heterogeneity of each structure."),
    ("modulus", "ArrayLike", REQUIRED, "Its shear modulus [Pa]."),
    ("standard_error", "ArrayLike | None", None, "Standard errors of the moduli [Pa], as weights.")])
def fit_power_law(a, modulus, standard_error=None, *, progress=None, threads=None, **options):
    """Returns a0, beta, c, their errors, the interval of a0 and its profile."""
    def column(items, name, unit="Pa"):
        array = _numbers([] if items is None else items, unit)
        if array.ndim != 1:
            raise _coagula.InputError(f"{name} must be a list of numbers, one for each structure")
        return array

    found = _coagula.fit_power_law(values("fit_power_law", options, threads), column(a, "a", "1"), column(modulus, "modulus"),
                                   column(standard_error, "standard_error"), progress)
    return from_json(json.loads(found), "PowerLaw")


@documented("diagnose", returns="Result", replaced=["new", "check", "power", "catalogue", "data_sets", "diagnoses", "output"],
            first=[("experiment", "str | PathLike[str]", REQUIRED, "The experiment file (docs/reference/experiment-file.md).")],
            extra=[("output", "str | PathLike[str] | None", None,
                    "Folder for report.html, diagnosis.json, diagnosis.h5 and the simulations; nothing is written when None.")])
def diagnose(experiment, *, output=None, progress=None, threads=None, **options):
    """Returns the keys of diagnosis.json as attributes: .detected, .p_value, .verdict, .causes, .gain ..."""
    folder = "" if output is None else os.fspath(output)
    given = {"input": os.fspath(experiment), **values("diagnose", options, threads), **({"output": folder} if folder else {})}
    call = call_text("diagnose", [repr(os.fspath(experiment))], {**options, "output": output})
    return from_json(json.loads(_coagula.diagnose(given, call, folder, progress)), "Diagnosis")


def fit_degree_of_heterogeneity(radius: "ArrayLike", exclusion_probability: "ArrayLike", r0: "float | str") -> "Result":
    """Degree of heterogeneity of a pore-size curve: P(r_P > r) = 1 - erf((r/r0 - b) / (a sqrt 2)) by least squares.

    Parameters
    ----------
    radius : ArrayLike
        Radii r [m].
    exclusion_probability : ArrayLike
        P(r_P > r) at these radii.
    r0 : float | str
        Mean radius of the particles [m].

    Returns a, b, a_stderr, b_stderr and rms_residual, lengths over r0. Schenker et al., Granular Matter 14 (2012) 333, section 2.3.
    """
    size = _coagula.parse_quantity(r0, "m") if isinstance(r0, str) else float(r0)
    found = _coagula.fit_degree_of_heterogeneity(np.asarray(radius, dtype=float), np.asarray(exclusion_probability, dtype=float), size)
    return from_json(found, "DegreeOfHeterogeneity")


def find_contacts(packing: "Packing | Generated | Structure", tolerance: "float" = 0.01) -> "Bonds":
    """All pairs nearer than (1 + tolerance) (r_i + r_j), periodic images included: coagula.Bonds."""
    return _coagula.find_contacts(packing_of(packing), float(tolerance))
