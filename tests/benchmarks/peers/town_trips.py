#!/usr/bin/env python3
"""Septet's town traffic beside SUMO's, in one run on one machine: the same trips on the same network.

    tests/benchmarks/peers/town_trips.py [--program build/release/septet-town-trips] [--trips 600,1000,1400]

A grid of 5 x 5 crossings of streets with a lane for each direction, 150 m apart, right before left, by SUMO's netgenerate; netconvert
writes it as OpenDRIVE for Septet. Trips go by the shortest way between two of its 40 ends, and are due by chance (Poisson)
within an hour of simulated time, as many as --trips says. A trip's time is from when it is due until it arrives. SUMO drives them with its own
default car, with turns no faster than 2 m/s2 across as in Septet, in steps of 0.1 s; so does Septet. Vehicle updates a CPU second: vehicles times steps by the CPU
time of all of SUMO's run, less that of a run without trips; of Septet's stepping. Needs Debian's `sumo`, and `septet-town-trips` built.
"""

import argparse
import json
import os
import random
import re
import resource
import subprocess
import tempfile
import xml.etree.ElementTree as ElementTree

STEP_S = 0.1


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def cpu_s(*command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    run(*command)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def make_network(folder):
    """Returns the road of each of SUMO's edges."""
    run("netgenerate", "--grid", "--grid.number", "5", "--grid.length", "150", "--grid.attach-length", "150", "-j", "right_before_left",
        "--no-turnarounds", "--junctions.limit-turn-speed", "2", "-o", f"{folder}/net.xml")
    run("netconvert", "-s", f"{folder}/net.xml", "--output.original-names", "--opendrive-output", f"{folder}/net.xodr")
    roads = {}
    for road in ElementTree.parse(f"{folder}/net.xodr").getroot().iter("road"):
        if road.get("junction") == "-1":
            roads[road.find("userData").get("value")] = road.get("id")
    return roads


def make_trips(folder, roads, count, seed):
    """SUMO's demand, and the same as lines of roads."""
    ends = sorted(edge for edge in roads if re.search("(left|right|top|bottom)", edge))
    ways_in = [edge for edge in ends if re.match("(left|right|top|bottom)", edge)]
    ways_out = [edge for edge in ends if not re.match("(left|right|top|bottom)", edge)]
    rng = random.Random(seed)
    due = sorted(rng.uniform(0, 3600) for _ in range(count))
    with open(f"{folder}/trips.xml", "w") as trips:
        trips.write("<routes>")
        for k, at in enumerate(due):
            start, goal = rng.choice(ways_in), rng.choice(ways_out)
            trips.write(f'<trip id="{k}" depart="{at:.1f}" from="{start}" to="{goal}"/>')
        trips.write("</routes>")
    run("duarouter", "-n", f"{folder}/net.xml", "-r", f"{folder}/trips.xml", "-o", f"{folder}/routes.xml", "--no-warnings", "--ignore-errors",
        "--named-routes", "false")
    # SUMO's cars come in as fast as they can, as Septet's do.
    text = open(f"{folder}/routes.xml").read()
    open(f"{folder}/routes.xml", "w").write(re.sub(r"<vehicle ", '<vehicle departSpeed="max" ', text))
    with open(f"{folder}/septet.txt", "w") as lines:
        for vehicle in ElementTree.fromstring(text).iter("vehicle"):
            edges = vehicle.find("route").get("edges").split()
            lines.write(" ".join([vehicle.get("depart")] + [roads[edge] for edge in edges]) + "\n")


def sumo(folder):
    command = ["sumo", "-n", f"{folder}/net.xml", "--step-length", str(STEP_S), "--no-step-log", "--no-warnings", "--xml-validation", "never",
               "--time-to-teleport", "-1"]
    used_s = cpu_s(*command, "-r", f"{folder}/routes.xml", "--tripinfo-output", f"{folder}/info.xml") - cpu_s(*command, "--end", "1")
    trips = list(ElementTree.parse(f"{folder}/info.xml").getroot().iter("tripinfo"))
    spent_s = [float(trip.get("duration")) for trip in trips]
    mean_s = sum(s + float(trip.get("departDelay")) for s, trip in zip(spent_s, trips)) / len(trips)
    return {"arrived": len(trips), "mean_s": mean_s, "updates": sum(spent_s) / STEP_S, "cpu_s": used_s}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../..")
    parser.add_argument("--program", default=os.path.join(root, "build/release/septet-town-trips"))
    parser.add_argument("--trips", default="600,1000,1400", help="trips an hour, a run each")
    options = parser.parse_args()
    print("| trips an hour | mean time, s: Septet | SUMO | ratio | million updates a CPU second: Septet | SUMO | ratio |\n" + "|---" * 7 + "|")
    for count in map(int, options.trips.split(",")):
        with tempfile.TemporaryDirectory() as folder:
            make_trips(folder, make_network(folder), count, 1)
            theirs = sumo(folder)
            ours = json.loads(run(options.program, f"{folder}/net.xodr", f"{folder}/septet.txt", str(STEP_S)))
        assert ours["arrived"] == theirs["arrived"], f'{ours["arrived"]} trips of Septet arrived, {theirs["arrived"]} of SUMO'
        rates = [run["updates"] / run["cpu_s"] / 1e6 for run in (ours, theirs)]
        print(f'| {ours["arrived"]} | {ours["mean_s"]:.1f} | {theirs["mean_s"]:.1f} | {ours["mean_s"] / theirs["mean_s"]:.2f} '
              f'| {rates[0]:.2f} | {rates[1]:.2f} | {rates[0] / rates[1]:.1f} |')


if __name__ == "__main__":
    main()
