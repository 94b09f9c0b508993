# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of a campaign: counts, 95 % binomial intervals (Wilson 1927), targets.

    python3 tests/benchmark/diagnosis_campaign/table.py campaign/results.jsonl"""

import json
import sys
from math import log10, pi, sqrt
from pathlib import Path
from statistics import mean, median

import shown_cases
from open_set import add_open_set


NULLS = ("null", "null-tails", "null-correlated", "null-offsets", "null-one-sample", "null-relaxation", "null-series", "null-coordinates", "null-pores")
TIES = {"tie": "tie of slip and gap", "tie-level": "tie of the level", "tie-stiffening": "tie of time and strain", "tie-yield": "tie of yield"}
MIXED = ("single", "contact-loss", "ageing", "tool-compliance", "tool-inertia")
BREAKING = ("bond-strength", "bond-strength-cone")
ON_THEIR_DAYS = ("ageing-power", "ageing-saturating", "temperature-drift", "evaporation", "drying-rim", "radius-error", "edge-fracture", "sudden-loss",
                "reversible-softening", "activated-rupture", "missing-contacts", "contact-dashpot", "contact-relaxation", "thixotropy",
                "bond-strength-rates", "sedimentation", "temperature-drift-gaps", "evaporation-gaps", "ageing-gaps", "ageing-saturating-gaps",
                "poroelastic-backflow", "poroelastic-backflow-gradual", "poroelastic-backflow-radii",
                "volume-fraction-gradient", "bearing-damping", "phase-offset", "sample-inertia")
# Rows of shown_cases.py with a cause of the catalogue, whose parameters are compared, too.
SHOWN = tuple(row for row in shown_cases.ROWS if row not in NULLS)
COMPARED = (*SHOWN, "activated-rupture", "bond-strength-rates")
CRITICAL_STRAIN = 1e-4  # of all bonds that break
RATES_STRAIN = 4e-4     # largest of the sweeps at two frequencies
USUAL_RADIUS = 25e-3    # of plates, under which a stress is stated


def wilson(hits, runs):
    if runs == 0:
        return 0.0, 1.0
    share, z = hits / runs, 1.96
    middle = (share + z * z / (2 * runs)) / (1 + z * z / runs)
    half = z / (1 + z * z / runs) * sqrt(share * (1 - share) / runs + z * z / (4 * runs * runs))
    return max(0.0, middle - half), min(1.0, middle + half)


def in_set(truth, names):
    """A pair counts if its members are found, alone or together."""
    found = {part for name in names for part in name.split(" + ")}
    return set(truth.split(" + ")) <= found


def of_rates(truth, hidden):
    """Critical strain at 1 Hz and its growth per decade, of sweeps to RATES_STRAIN at two frequencies."""
    (low, slow), (high, fast) = [(log10(frequency), RATES_STRAIN / load) for frequency, load in hidden["rates"]]
    growth = (fast - slow) / (high - low)
    return [slow - low * growth, growth / (slow - low * growth)] if truth == "activated-rupture" else [slow]


def true_values(truth, hidden):
    """Of the parameters of the true cause, in their order; none where they are not compared."""
    fields = {"ageing": "ageing", "tool-compliance": "compliance", "tool-inertia": "inertia", "solvent-drag": "viscosity", "wall-slip": "slip",
              "gap-error": "gap_error", "contact-nonlinearity": "hertz", "normal-load": "pressure", "polydispersity": "sizes",
              "surface-potential": "potential", "ionic-strength": "ions"}
    several = {"contact-loss": "loss", "bond-stiffening": "stiffening", "ageing-after-shear": "power", "localisation-error": "images"}
    if truth in fields:
        return [hidden[fields[truth]]]
    if truth in several:
        return list(hidden[several[truth]])
    if truth == "prestress":
        return [hidden["contact"][1]]
    if truth == "shear-thinning":
        return [hidden["thinning"], hidden["exponent"]]
    if truth == "torque-offset":
        return [2 * hidden["torque"] / (pi * USUAL_RADIUS**3)]
    if hidden["rates"]:
        return of_rates(truth, hidden)
    return [CRITICAL_STRAIN] if hidden["loads"] else []


def parameter_covered(entry):
    """Whether the 90 % intervals of the true cause's own entry hold the truth; one bool per parameter."""
    for cause in entry["found"]["causes"]:
        if cause["name"] != entry["truth"]:
            continue
        values = [each for name, each in cause["parameters"].items() if name not in ("normal_stiffness", "viscosity")]
        for each, value in zip(values, true_values(entry["truth"], entry["hidden"])):
            yield each["low"] <= value <= each["high"]


def named_first(entry):
    """The true cause comes first and the verdict does not take it back."""
    found = entry["found"]
    return found["verdict"] in ("named", "tied") and found["credible_set"][0] == entry["truth"]


class Table:
    def __init__(self):
        self.lines = [("case", "what", "count", "share", "95 % interval", "target", "")]

    def add(self, case, what, hits, low=0.0, high=1.0):
        hits = list(hits)
        count, runs = sum(hits), len(hits)
        if runs == 0:
            return
        bounds = wilson(count, runs)
        share = count / runs
        met = "met" if low <= share <= high else "met within error" if bounds[1] >= low and bounds[0] <= high else "missed"
        target = f"{100 * low:g} - {100 * high:g} %" if low > 0 and high < 1 else f">= {100 * low:g} %" if low > 0 else f"<= {100 * high:g} %"
        self.lines.append((case, what, f"{count}/{runs}", f"{100 * share:.1f} %", f"{100 * bounds[0]:.1f} - {100 * bounds[1]:.1f} %", target, met))

    def print(self):
        print("| " + " | ".join(self.lines[0]) + " |\n|" + "---|" * len(self.lines[0]))
        for line in self.lines[1:]:
            print("| " + " | ".join(line) + " |")


def is_strong(entry):
    return entry["gain"] >= 25 * (1 - 1e-6)  # those that were scaled to 25 count


def is_tied(entry):
    return entry["found"]["verdict"] == "tied" and in_set(entry["truth"], entry["found"]["credible_set"])


def has_gain(entry):
    low = (entry["found"].get("gain") or {}).get("elpd_ci90", [None])[0]
    return low is not None and low > 0


def confidently_wrong(entry):
    return entry["found"]["detected"] and any(cause["posterior"] >= 0.95 and cause["name"] not in ("none of the catalogue", "base")
                                              and not set(cause["name"].split(" + ")) & set(entry["truth"].split(" + "))
                                              for cause in entry["found"]["causes"])


def held_out_ratio(entry):
    """rms error of the extended model over that of a fit told the cause."""
    told = entry.get("told") or entry["found"]["gain"]
    own = entry["found"]["gain"]
    return own["rmse_extended"] / told["rmse_extended"] if told and own and told["rmse_extended"] else None


def add_named(table, case, entries):
    """Rows about effects that are alone; gives them back."""
    table.add(case, "detected", [entry["found"]["detected"] for entry in entries], 0.95)
    table.add(case, "named first", [named_first(entry) for entry in entries], 0.90)
    found = [in_set(entry["truth"], entry["found"]["credible_set"]) for entry in entries if entry["found"]["detected"]]
    table.add(case, "true cause in the 95 % set", found, 0.93, 0.97)
    return entries


def is_named(entry):
    return entry["found"]["verdict"] == "named" and entry["found"]["credible_set"] == [entry["truth"]]


def is_certain(entry):
    """Every member of the set is or has the true cause."""
    found = entry["found"]
    return found["verdict"] in ("named", "tied") and all(entry["truth"] in cause.split(" + ") for cause in found["credible_set"])


def outliers(entry):
    return [note for note in entry["found"].get("notes") or [] if "left out as an outlier" in note]


def add_faults(table, of):
    """Rows with wrong data, wrong statements, and what a cause leaves over."""
    for row, least, name in (("wrong-rows", 2, "row "), ("slid-sample", 1, "sample 'B'")):
        own = of(row)
        table.add(row, "found, true cause in the set", [entry["found"]["detected"] and in_set(entry["truth"], entry["found"]["credible_set"])
                                                        for entry in own], 0.90)
        table.add(row, "listed", [sum(name in note for note in outliers(entry)) >= least for entry in own], 0.90)
    for row in ("contacts-removed", "volume-fraction"):
        table.add(row, "a cause named alone", [entry["found"]["verdict"] == "named" for entry in of(row)], 0.0, 0.01)
        table.add(row, "a tie without none", [entry["found"]["verdict"] == "tied" and "none of the catalogue" not in entry["found"]["credible_set"]
                                              for entry in of(row)], 0.0, 0.01)
    for row in ("negative-storage", "drag"):
        table.add(row, "90 % intervals cover", [hit for entry in of(row) for hit in parameter_covered(entry)], 0.86, 0.94)
        table.add(row, "true cause named alone", [is_named(entry) for entry in of(row)], 0.90)
    table.add("bump", "named first", [named_first(entry) for entry in of("bump")], 0.90)
    table.add("bump", "true cause named alone", [is_named(entry) for entry in of("bump")], 0.90)
    table.add("bump", "true cause in every member of the set", [is_certain(entry) for entry in of("bump")], 0.90)
    table.add("bump", "remainder found in G''", ["G''" in (entry["found"].get("remainder") or {}).get("where", "") for entry in of("bump")], 0.90)
    table.add("all of these", "confidently wrong", [confidently_wrong(entry) for entry in of("wrong-rows", "slid-sample", "negative-storage",
                                                    "drag", "bump", "contacts-removed", "volume-fraction")], 0.0, 0.01)


def print_table(path):
    entries = [json.loads(line) for line in Path(path).open()]
    problems = [entry for entry in entries if "problem" in entry]
    entries = [entry for entry in entries if "problem" not in entry]
    of = lambda *rows: [entry for entry in entries if entry["row"] in rows]
    table = Table()
    for row in NULLS:
        # The structures of a series are drawn once for all runs, so that their part of the errors is no draw.
        least = 0.0 if row == "null-series" else 0.03
        table.add(row, "detected", [entry["found"]["detected"] for entry in of(row)], least, 0.07)
    table.add("all of these", "a gain whose interval excludes 0", [has_gain(entry) for entry in of(*NULLS)], 0.0, 0.05)
    strong = {}
    for case, rows in (("one effect", MIXED), *((row, (row,)) for row in BREAKING)):
        strong[case] = add_named(table, case, [entry for entry in of(*rows) if is_strong(entry)])
    for name in sorted({entry["truth"] for entry in strong["one effect"]}):
        own = [entry for entry in strong["one effect"] if entry["truth"] == name]
        table.add(name, "named first", [named_first(entry) for entry in own], 0.90)
    series = [entry for entry in of("structure-series") if is_strong(entry)]
    table.add("structure series", "detected", [entry["found"]["detected"] for entry in series], 0.95)
    table.add("structure series", "named first", [named_first(entry) for entry in series], 0.90)
    table.add("structure series", "true cause in the 95 % set",
              [in_set(entry["truth"], entry["found"]["credible_set"]) for entry in series if entry["found"]["detected"]], 0.93)
    table.add("structure series", "confidently wrong", [confidently_wrong(entry) for entry in of("structure-series")], 0.0, 0.02)
    every = of("pair", *TIES, *NULLS, "structure-series", *MIXED, *BREAKING)
    table.add("all that is in the catalogue, and nothing", "confidently wrong", [confidently_wrong(entry) for entry in every], 0.0, 0.02)
    for row, name in TIES.items():
        own = [entry for entry in of(row) if is_strong(entry)]
        table.add(name, "reported as tied, truth in the set", [is_tied(entry) for entry in own], 0.95)
        table.add(name, "truth in the set", [in_set(entry["truth"], entry["found"]["credible_set"]) for entry in own], 0.95)
        followed = [entry["resolved_after"] for entry in own if "resolved_after" in entry]
        table.add(name, "resolved by the proposed measurement", [after == 1 for after in followed], 0.90)
        table.add(name, "resolved by it or the next two that are proposed", [after > 0 for after in followed], 0.90)
    table.add("outside the catalogue", "none of the catalogue", [entry["found"]["verdict"] == "none-of-catalogue" for entry in of("outside")], 0.85)
    table.add("outside the catalogue", "confident false name",
              [entry["found"]["verdict"] == "named" for entry in of("outside")], 0.0, 0.05)
    table.add("two effects", "both in the set", [in_set(entry["truth"], entry["found"]["credible_set"]) for entry in of("pair")], 0.85)
    for row in (*ON_THEIR_DAYS, *SHOWN):
        own = [entry for entry in of(row) if is_strong(entry)]
        table.add(row, "detected", [entry["found"]["detected"] for entry in own], 0.95)
        table.add(row, "named, or tied with its look-alikes", [in_set(entry["truth"], entry["found"]["credible_set"]) for entry in own
                                                               if entry["found"]["detected"]], 0.90)
        if row in COMPARED:
            table.add(row, "90 % intervals cover", [hit for entry in own for hit in parameter_covered(entry)], 0.86, 0.94)
    table.add("all of these", "confidently wrong", [confidently_wrong(entry) for entry in of(*ON_THEIR_DAYS, *SHOWN)], 0.0, 0.01)
    add_faults(table, of)
    add_open_set(table, of)
    strong["tie of yield"] = of("tie-yield")
    for case, runs in strong.items():
        table.add(case, "90 % intervals cover", [hit for entry in runs for hit in parameter_covered(entry)], 0.86, 0.94)
    for case in ("one effect", *BREAKING):
        ratios = [ratio for entry in strong[case] if entry["found"]["detected"] and (ratio := held_out_ratio(entry)) is not None]
        table.add(case, "held-out rms at most 1.2 of that of a fit told the cause", [ratio <= 1.2 for ratio in ratios], 0.90)
    table.print()
    detected = [entry for entry in strong["one effect"] if entry["found"]["detected"]]
    if detected:
        stated = [entry["found"]["stated"] for entry in detected]
        print(f"\nMedian size of the set: {median(len(entry['found']['credible_set']) for entry in detected)}. "
              f"By the posteriors it should hold the truth in {100 * mean(stated):.1f} % of the runs.")
    times = [entry["wall"] for entry in entries]
    if times:
        print(f"{len(entries)} runs, {len(problems)} failed; median {median(times):.1f} s, longest {max(times):.1f} s a diagnosis.")
    for entry in problems[:5]:
        print(entry["row"], entry["number"], entry["problem"][:300])


def share_of(hits):
    hits = list(hits)
    return f"{sum(hits)}/{len(hits)}" if hits else ""


def in_short(row, own):
    """A line of the table by rows."""
    found = [entry for entry in own if entry["found"]["detected"]]
    times = [entry["wall"] for entry in own]
    hidden = row not in NULLS
    return [row, share_of(entry["found"]["detected"] for entry in own),
            share_of(is_named(entry) for entry in found) if hidden else "",
            share_of(in_set(entry["truth"], entry["found"]["credible_set"]) for entry in found) if hidden else "",
            share_of(hit for entry in own for hit in parameter_covered(entry)),
            share_of(confidently_wrong(entry) for entry in own), f"{median(times):.1f}", f"{max(times):.0f}"]


def print_rows(path):
    """One line for each row of the campaign, every run of it counted, however weak its effect is."""
    entries = [entry for entry in map(json.loads, Path(path).open()) if "problem" not in entry]
    head = ["row", "detected", "the cause alone", "the cause in the set", "90 % intervals hold", "confidently wrong", "median, s", "longest, s"]
    print("\n| " + " | ".join(head) + " |\n|" + "---|" * len(head))
    for row in dict.fromkeys(entry["row"] for entry in entries):
        print("| " + " | ".join(in_short(row, [entry for entry in entries if entry["row"] == row])) + " |")


if __name__ == "__main__":
    print_table(sys.argv[1])
    print_rows(sys.argv[1])
