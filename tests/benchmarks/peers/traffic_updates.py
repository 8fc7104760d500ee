#!/usr/bin/env python3
"""Septet's traffic beside SUMO's, in one run on one machine: vehicle updates per CPU second.

    tests/benchmarks/peers/traffic_updates.py [--bench build/release/septet-bench] [--steps 3000]

1,000 vehicles on a ring of 10 km with five lanes of 3.75 m (20 per km and lane), steps of 0.1 s, IDM with Septet's mix of
drivers in both; SUMO with its default lane changes. SUMO's figure is the CPU time of a long run less that of a short one, so
that neither loading nor settling counts. Needs Debian's `sumo`, and `septet-bench` built.
"""

import argparse
import json
import math
import os
import random
import resource
import statistics
import subprocess
import tempfile

LANES, SPEED_LIMIT = 5, 50.0
# Septet's mix (engine/traffic/swarm.cpp): length, width, v0, T, a, b, s0, share; a driver between timid and aggressive.
CAR = (4.6, 1.82, 32.0, 1.3, 1.5, 2.5, 2.0)
LORRY = (11.9, 2.55, 23.5, 1.7, 0.7, 2.0, 2.5)


def ring_network(folder, length):
    """A ring of eight edges, so that no route passes an edge twice in a row."""
    radius, parts = length / (2 * math.pi), 8
    with open(f"{folder}/n.xml", "w") as nodes, open(f"{folder}/e.xml", "w") as edges:
        nodes.write("<nodes>")
        edges.write("<edges>")
        for k in range(parts):
            angle = 2 * math.pi * k / parts
            nodes.write(f'<node id="n{k}" x="{radius * math.cos(angle):.4f}" y="{radius * math.sin(angle):.4f}"/>')
            steps = [2 * math.pi * (k + i / 60) / parts for i in range(61)]
            shape = " ".join(f"{radius * math.cos(a):.4f},{radius * math.sin(a):.4f}" for a in steps)
            edges.write(f'<edge id="e{k}" from="n{k}" to="n{(k + 1) % parts}" numLanes="{LANES}" speed="{SPEED_LIMIT}" '
                        f'width="3.75" spreadType="center" shape="{shape}"/>')
        nodes.write("</nodes>")
        edges.write("</edges>")
    subprocess.run(["netconvert", "--node-files", f"{folder}/n.xml", "--edge-files", f"{folder}/e.xml", "--no-turnarounds",
                    "--xml-validation", "never", "--no-warnings", "-o", f"{folder}/net.xml"], check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    return parts


def factor(timid, aggressive, u):
    return timid ** (1 - 2 * u) if u < 0.5 else aggressive ** (2 * u - 1)


def driver_type(name, kind, u, extra):
    length, width, v0, gap, a, b, s0 = kind
    return (f'<vType id="{name}" carFollowModel="IDM" length="{length}" width="{width}" speedFactor="1" speedDev="0" '
            f'maxSpeed="{v0 * factor(0.90, 1.15, u):.3f}" tau="{gap * factor(1.35, 0.62, u):.3f}" '
            f'accel="{a * factor(0.65, 1.40, u):.3f}" decel="{b * factor(0.65, 1.25, u):.3f}" minGap="{s0 * factor(1.40, 0.75, u):.3f}" {extra}/>')


def demand(folder, parts, length, vehicles, seed, extra, ambulance=None):
    """Writes r.xml: vehicles spread evenly; `ambulance`, the XML of a type of that name, takes the place of one on the left."""
    rng = random.Random(seed)
    spacing = length * LANES / vehicles
    with open(f"{folder}/r.xml", "w") as routes:
        routes.write("<routes>")
        for k in range(parts):
            edges = " ".join(f"e{(k + i) % parts}" for i in range(parts * 60))
            routes.write(f'<route id="r{k}" edges="{edges}"/>')
        order = []
        for i in range(vehicles):
            lane = i % LANES  # SUMO counts from the right.
            heavy = lane < 2 and rng.randrange(3) == 0
            u = (rng.random() + rng.random() + rng.random()) / 3
            is_ambulance = ambulance and i == LANES - 1
            routes.write(ambulance if is_ambulance else driver_type(f"t{i}", LORRY if heavy else CAR, u, extra))
            x = ((i // LANES) * spacing + rng.uniform(0, 0.1) * spacing + lane * 3) % length
            order.append(("ambulance", "ambulance", lane, x) if is_ambulance else (f"v{i}", f"t{i}", lane, x))
        part = length / parts
        for name, kind, lane, x in order:
            k = int(x / part)
            routes.write(f'<vehicle id="{name}" type="{kind}" route="r{k}" depart="0" departLane="{lane}" departPos="{x - k * part:.2f}" '
                         f'departSpeed="desired" insertionChecks="none"/>')
        routes.write("</routes>")


def sumo_updates(steps):
    """CPU seconds of SUMO's own program for so many steps of 1,000 vehicles."""
    with tempfile.TemporaryDirectory() as folder:
        parts = ring_network(folder, 10000.0)
        demand(folder, parts, 10000.0, 1000, 1, "")

        def cpu(count):
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            subprocess.run(["sumo", "-n", f"{folder}/net.xml", "-r", f"{folder}/r.xml", "--step-length", "0.1", "--end", str(0.1 * count),
                            "--no-step-log", "--no-warnings", "--xml-validation", "never", "--time-to-teleport", "-1"], check=True,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

        # The difference of a long and a short run: without loading, and once everybody has found their pace.
        rates = [1000 * steps / (cpu(600 + steps) - cpu(600)) for _ in range(3)]
        return statistics.median(rates)


def septet(bench, pattern):
    done = subprocess.run([bench, f"--benchmark_filter={pattern}", "--benchmark_format=json"], check=True, capture_output=True, text=True)
    return json.loads(done.stdout)["benchmarks"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../..")
    parser.add_argument("--bench", default=os.path.join(root, "build/release/septet-bench"))
    parser.add_argument("--steps", type=int, default=3000, help="steps of SUMO that are timed")
    options = parser.parse_args()
    ours = statistics.median(entry["items_per_second"] for entry in septet(options.bench, "traffic_update/1000$"))
    theirs = sumo_updates(options.steps)
    print("| 1,000 vehicles, five lanes, 0.1 s | vehicle updates per CPU second |\n|---|---|")
    print(f"| Septet | {ours / 1e6:.1f} M |\n| SUMO | {theirs / 1e6:.3f} M |\n| ratio | {ours / theirs:.0f} |")


if __name__ == "__main__":
    main()
