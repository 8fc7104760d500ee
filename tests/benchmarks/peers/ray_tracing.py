"""How fast the ray tracer is beside Mitsuba 3.9.1 (PyPI) on the Cornell box: samples a second and core, in one run.

    python3 -m venv V && V/bin/pip install mitsuba==3.9.1 numpy
    V/bin/python ray_tracing.py SEPTET_BENCH [--rounds N]

SEPTET_BENCH is what ./bench builds. All trace 256² pixels with 64 samples each by paths of six edges without early ends, a box filter,
light and surface sampled and weighed together; seconds are those of the processor, so that other work disturbs little. They take
turns. The bar: not slower than `llvm`, at least 2.4 times as fast as `scalar`; the exit status says whether it is held. `llvm` needs
LLVM's library (Debian's libllvm19; those of 15 and 16 abort); where it is not found by itself, DRJIT_LIBLLVM_PATH names it.
"""

import argparse
import json
import statistics
import subprocess
import sys
import time

SIDE_PX, SAMPLES = 256, 64
AT_LEAST = {"scalar_rgb": 2.4, "llvm_ad_rgb": 1.0}
KNOWN_MEAN = (0.2339, 0.1402, 0.0599)


def mitsuba_rate(variant):
    """Run as a program of its own: a variant's threads and caches do not meet those of the next."""
    import mitsuba
    import numpy
    mitsuba.set_variant(variant)
    box = mitsuba.cornell_box()
    box["sensor"]["film"].update(width=SIDE_PX, height=SIDE_PX, rfilter={"type": "box"})
    box["integrator"] = {"type": "path", "max_depth": 6, "rr_depth": 100}
    scene = mitsuba.load_dict(box)
    numpy.array(mitsuba.render(scene, spp=SAMPLES, seed=1))  # Compiles.
    began = time.process_time()
    mean = numpy.array(mitsuba.render(scene, spp=SAMPLES)).mean(axis=(0, 1))
    seconds = time.process_time() - began
    if max(abs(mean - KNOWN_MEAN)) > 0.001:
        raise SystemExit(f"{variant} draws something else: {mean}")
    return SIDE_PX ** 2 * SAMPLES / seconds


def septet_rate(program):
    run = subprocess.run([program, "--benchmark_filter=^trace/cornell", "--benchmark_repetitions=1", "--benchmark_format=json"],
                         check=True, capture_output=True, text=True)
    return json.loads(run.stdout)["benchmarks"][0]["samples"]


def main():
    options = argparse.ArgumentParser()
    options.add_argument("program")
    options.add_argument("--rounds", type=int, default=3)
    options.add_argument("--variant", help=argparse.SUPPRESS)
    options = options.parse_args()
    if options.variant:
        print(mitsuba_rate(options.variant))
        return 0
    rates = {"septet": [], **{variant: [] for variant in AT_LEAST}}
    for _ in range(options.rounds):
        rates["septet"].append(septet_rate(options.program))
        for variant in AT_LEAST:
            run = subprocess.run([sys.executable, __file__, options.program, "--variant", variant], capture_output=True, text=True)
            if run.returncode:
                print(f"{variant} does not run: {run.stderr.strip().splitlines()[-1] if run.stderr.strip() else run.returncode}")
                return 1
            rates[variant].append(float(run.stdout.split()[-1]))
    medians = {name: statistics.median(values) for name, values in rates.items()}
    for name, rate in medians.items():
        print(f"{name:12} {rate / 1e6:.3f} million samples a second and core")
    held = True
    for variant, least in AT_LEAST.items():
        ratio = medians["septet"] / medians[variant]
        held = held and ratio >= least
        print(f"{ratio:.2f} times {variant}, at least {least}")
    return 0 if held else 1


if __name__ == "__main__":
    sys.exit(main())
