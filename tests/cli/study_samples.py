"""Studies of made-up runs, as study.json has them, for the tests of the page that shows one."""

import itertools
import math
import random

QUANTITIES = {"displacement": 1.0, "velocity": 2.1, "stress": 5.3}  # with the size of their errors
UNCERTAINTY = 1.6e-4  # of the truth, of an error of size 1


def sample_run(number, kernel, transfer, cell_size, cfl, noise):
    """Errors fall with the second order until the time step's share is left; seconds rise as the work."""
    steps = round(60 / (cell_size * cfl))
    particles = round(4 * 0.39 / cell_size**2)
    seconds = 2.5e-7 * steps * particles * {"gimp": 0.8, "quadratic": 1, "cubic": 1.9}[kernel] * noise()
    error = ({"gimp": 4, "quadratic": 2.4, "cubic": 1.5}[kernel] * cell_size**2 + 4e-3 * cfl * cell_size
             + (0.02 * cell_size if transfer == "apic" else 0)) * noise()
    return {
        "id": f"{number:04d}",
        "settings": {"cell_size": cell_size, "kernel": kernel, "transfer": transfer, "stress_order": "usl",
                     "cfl": cfl, "materials.rubber.youngs_modulus": 1000},
        "arguments": f"--set simulation.cell_size={cell_size} --set simulation.kernel={kernel} "
                     f"--set simulation.transfer={transfer} --set simulation.cfl={cfl}",
        "state": "finished", "reason": "", "particles": particles, "steps": steps, "dt": 3 / steps,
        "seconds": {"median": seconds, "min": 0.97 * seconds, "q1": 0.98 * seconds, "q3": 1.04 * seconds,
                    "cpu": seconds, "projected": seconds * noise()},
        "passes": {"sort": 0.05 * seconds, "p2g": 0.4 * seconds, "grid": 0.1 * seconds, "g2p": 0.35 * seconds,
                   "material": 0.1 * seconds},
        "work": 9.0 * steps * particles,
        "peak_bytes": 20_000_000 + 400 * particles, "cache_bytes": 90 * particles,
        "error": {name: {"l2": size * error, "max": 3.1 * size * error * noise()**4}
                  for name, size in QUANTITIES.items()},
        "drift": {"energy": 1e-3 * cfl * noise(), "momentum": 3e-16, "angular": 2e-9 * noise()},
        "greyed": list(QUANTITIES) if error < 10 * UNCERTAINTY else [],
    }


def stopped(run, state, reason, seconds=None):
    """The run as one that did not end."""
    unknown = ("error", "drift", "passes", "steps", "dt", "work", "peak_bytes", "cache_bytes")
    return {**run, **dict.fromkeys(unknown), "state": state, "reason": reason, "greyed": [],
            "seconds": None if seconds is None else
            {"median": seconds, "min": seconds, "q1": None, "q3": None, "cpu": None, "projected": 0.4}}


def sample_runs():
    generator = random.Random(7)

    def noise():
        return math.exp(generator.gauss(0, 0.08))

    methods = [("gimp", "flip"), *itertools.product(("quadratic", "cubic"), ("flip", "apic"))]
    settings = itertools.product(methods, (0.1, 0.05, 0.025), (0.4, 0.2))
    runs = [sample_run(k + 1, *method, *others, noise) for k, (method, *others) in enumerate(settings)]
    runs[8] = stopped(runs[8], "failed", "t = 1.2 s: a velocity is not finite", 0.31)
    runs[20] = stopped(runs[20], "failed", "out of memory")
    refused = sample_run(len(runs) + 1, "gimp", "apic", 0.1, 0.4, noise)
    return [*runs, stopped(refused, "refused", "gimp goes with flip and pic only")]


def pareto(runs, quantity, norm="l2"):
    best, front = math.inf, []
    for run in sorted(runs, key=lambda run: run["seconds"]["median"]):
        if run["error"][quantity][norm] < best:
            best = run["error"][quantity][norm]
            front.append(run)
    return front


def sample_study(runs, **others):
    finished = [run for run in runs if run["state"] == "finished"]
    fronts = {quantity: pareto(finished, quantity) for quantity in QUANTITIES}

    def cheapest(quantity, error):
        return next((run["id"] for run in fronts[quantity] if run["error"][quantity]["l2"] <= error), None)

    return {
        "format": "firn study 1", "title": "Two elastic cylinders bounce off each other",
        "description": "What the cell size, the kernel, the transfer and the time step do to accuracy, and "
                       "what they cost.\nThe cylinders meet after 0.4 s and part again.",
        "study": "two_cylinders.toml", "scene": "../scenes/two_cylinders.toml",
        "made": {"firn": "0.1.0", "compiler": "12.2.0", "machine": "AMD EPYC 7B13", "cores": 2,
                 "date": "2026-11-23", "repeats": 3},
        "time": 3.0,
        "truth": {"type": "finest", "text": "the finest runs of this scene",
                  "order": {"displacement": 1.97, "velocity": None, "stress": 1.5}, "levels": [0.0125, 0.00625, 0.003125],
                  "uncertainty": {name: UNCERTAINTY * size for name, size in QUANTITIES.items()}},
        "axes": ["cell_size", "kernel", "transfer", "cfl"], "quantities": list(QUANTITIES), "runs": runs,
        "front": {quantity: [run["id"] for run in front] for quantity, front in fronts.items()},
        "reach": {quantity: [{"error": error, "run": cheapest(quantity, error)}
                             for error in (0.1, 0.05, 0.01, 0.001)] for quantity in QUANTITIES},
        **others,
    }
