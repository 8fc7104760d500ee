"""Speed of the ray tracer beside Mitsuba 3.9.1 (PyPI), on the Cornell box and on an exported motorway: samples a second and core, in
one run.

    python3 -m venv V && V/bin/pip install mitsuba==3.9.1 numpy pillow
    V/bin/python ray_tracing.py SEPTET_BENCH SEPTET_PEER_SCENE [--rounds N]

SEPTET_BENCH is what ./bench builds, SEPTET_PEER_SCENE is built when asked for. In the box all trace 256² pixels with 64 samples each by paths of six
edges; on the motorway, at noon as tests/engine/raytrace/peers exports it, 320 × 210 pixels with 32 samples by paths of eight edges. None ends
early; a box filter; light and surface sampled and weighed together. Seconds are those of the processor, without loading and compiling, so that other
work disturbs little, though caches are shared: the load is told. They take turns. The bar: not slower than `llvm`, at least 2.4 times as
fast as `scalar`; the exit status says whether it is held. `llvm` needs LLVM's library (Debian's libllvm19; those of 15 and 16
abort); where it is not found by itself, DRJIT_LIBLLVM_PATH names it.
"""

import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

SIDE_PX, SAMPLES = 256, 64
MOTORWAY_SAMPLES = 32
AT_LEAST = {"scalar_rgb": 2.4, "llvm_ad_rgb": 1.0}
KNOWN_MEAN = (0.2339, 0.1402, 0.0599)


def mitsuba_box(mitsuba):
    box = mitsuba.cornell_box()
    box["sensor"]["film"].update(width=SIDE_PX, height=SIDE_PX, rfilter={"type": "box"})
    box["integrator"] = {"type": "path", "max_depth": 6, "rr_depth": 100}
    return mitsuba.load_dict(box), SAMPLES, KNOWN_MEAN


def mitsuba_motorway(folder):
    sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "engine/raytrace/peers"))
    import mitsuba_peer
    loaded = mitsuba_peer.mitsuba_scene(folder, json.loads((folder / "scene.json").read_text()))
    return loaded, MOTORWAY_SAMPLES, mitsuba_peer.read_pfm(folder / "traced.pfm").mean(axis=(0, 1))


def mitsuba_rate(variant, folder):
    """Run as a program of its own: a variant's threads and caches do not meet those of the next."""
    import mitsuba
    import numpy
    mitsuba.set_variant(variant)
    scene, samples, known_mean = mitsuba_motorway(folder) if folder else mitsuba_box(mitsuba)
    numpy.array(mitsuba.render(scene, spp=samples, seed=1))  # Compiles.
    began = time.process_time()
    picture = numpy.array(mitsuba.render(scene, spp=samples))
    seconds = time.process_time() - began
    mean = picture.mean(axis=(0, 1))
    if max(abs(mean / known_mean - 1)) > 0.02:
        raise SystemExit(f"{variant} draws something else: {mean}, not {known_mean}")
    return picture.shape[0] * picture.shape[1] * samples / seconds


def septet_box_rate(program):
    run = subprocess.run([program, "--benchmark_filter=^trace/cornell", "--benchmark_repetitions=1", "--benchmark_format=json"],
                         check=True, capture_output=True, text=True)
    return json.loads(run.stdout)["benchmarks"][0]["samples"]


def septet_motorway_rate(program, folder):
    subprocess.run([program, "noon", str(folder), str(MOTORWAY_SAMPLES)], check=True)
    scene = json.loads((folder / "scene.json").read_text())
    return scene["width"] * scene["height"] * MOTORWAY_SAMPLES / scene["processor_s"]


def compare(name, rounds, septet_rate, arguments):
    """True if the bound is kept."""
    rates = {"septet": [], **{variant: [] for variant in AT_LEAST}}
    for _ in range(rounds):
        rates["septet"].append(septet_rate())
        for variant in AT_LEAST:
            run = subprocess.run([sys.executable, __file__, *arguments, "--variant", variant], capture_output=True, text=True)
            if run.returncode:
                print(f"{variant} does not run: {run.stderr.strip().splitlines()[-1] if run.stderr.strip() else run.returncode}")
                return False
            rates[variant].append(float(run.stdout.split()[-1]))
    medians = {variant: statistics.median(values) for variant, values in rates.items()}
    print(f"{name}, {rounds} rounds, load {os.getloadavg()[0]:.1f}:")
    for variant, rate in medians.items():
        print(f"  {variant:12} {rate / 1e6:.3f} million samples a second and core")
    held = True
    for variant, least in AT_LEAST.items():
        ratio = medians["septet"] / medians[variant]
        held = held and ratio >= least
        print(f"  {ratio:.2f} times {variant}, at least {least}", flush=True)
    return held


def main():
    options = argparse.ArgumentParser()
    options.add_argument("bench")
    options.add_argument("peer_scene")
    options.add_argument("--rounds", type=int, default=3)
    options.add_argument("--variant", help=argparse.SUPPRESS)
    options.add_argument("--folder", type=pathlib.Path, help=argparse.SUPPRESS)
    options = options.parse_args()
    if options.variant:
        print(mitsuba_rate(options.variant, options.folder))
        return 0
    programs = [options.bench, options.peer_scene]
    with tempfile.TemporaryDirectory() as made:
        folder = pathlib.Path(made)
        held = [compare("Cornell box", options.rounds, lambda: septet_box_rate(options.bench), programs),
                compare("motorway", options.rounds, lambda: septet_motorway_rate(options.peer_scene, folder),
                        [*programs, "--folder", made])]
    return 0 if all(held) else 1


if __name__ == "__main__":
    sys.exit(main())
