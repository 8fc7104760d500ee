#!/usr/bin/env python3
"""An ambulance in dense traffic, Septet's rescue lane beside SUMO's bluelight device, in one run.

    python3 -m venv DIR && DIR/bin/pip install eclipse-sumo libsumo
    DIR/bin/python tests/benchmarks/peers/emergency_lane.py [--bench build/release/septet-bench] [--seeds 10] [--step 0.5]

The same traffic in both: 1,000 vehicles on a ring of 5 km with five lanes of 3.75 m (40 per km and lane), IDM with Septet's
mix of drivers, a minute to settle; then the ambulance's 5 km. Its speed and the mean of the others over that time, and their
ratio. SUMO's ambulance has SUMO's bluelight device in the settings in which it gained most in our trials (sublane model,
arbitrary lateral alignment, pushy, assertive, eager for speed; reaction distance 100 m). SUMO is that of PyPI: Debian's 1.15
ends in a failed assertion of its sublane model with this device.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile

from traffic_updates import demand, ring_network, septet

LENGTH_M, VEHICLES, SETTLING_S = 5000.0, 1000, 60.0
AMBULANCE = (
    '<vType id="ambulance" vClass="emergency" carFollowModel="IDM" laneChangeModel="SL2015" length="6.1" width="2.08" '
    'maxSpeed="38" speedFactor="1" speedDev="0" tau="0.8" accel="2" decel="3" minGap="2" latAlignment="arbitrary" lcPushy="1" '
    'lcAssertive="2" lcSpeedGain="5"><param key="has.bluelight.device" value="true"/>'
    '<param key="device.bluelight.reactiondist" value="100"/></vType>')


def use_sumo_of_pypi():
    """Its programs before any other's on the path."""
    import sumo
    os.environ["SUMO_HOME"] = sumo.SUMO_HOME
    os.environ["PATH"] = os.path.join(sumo.SUMO_HOME, "bin") + os.pathsep + os.environ["PATH"]


def sumo_run(seed, step):
    """Mean speed of the ambulance and of the others, m/s, and how often SUMO reports colliding vehicles."""
    import libsumo
    speed = libsumo.constants.VAR_SPEED
    with tempfile.TemporaryDirectory() as folder:
        parts = ring_network(folder, LENGTH_M)
        demand(folder, parts, LENGTH_M, VEHICLES, seed, 'laneChangeModel="SL2015" latAlignment="arbitrary"', AMBULANCE)
        libsumo.start(["sumo", "-n", f"{folder}/net.xml", "-r", f"{folder}/r.xml", "--step-length", str(step),
                       "--lateral-resolution", "0.8", "--seed", str(seed), "--no-step-log", "--no-warnings", "--xml-validation", "never",
                       "--time-to-teleport", "-1", "--collision.action", "warn"])
        while libsumo.simulation.getTime() < SETTLING_S:
            libsumo.simulationStep()
        for name in libsumo.vehicle.getIDList():
            libsumo.vehicle.subscribe(name, [speed])
        way = seconds = others = 0.0
        collisions = 0
        while way < LENGTH_M and seconds < 1000.0:
            libsumo.simulationStep()
            speeds = {name: values[speed] for name, values in libsumo.vehicle.getAllSubscriptionResults().items()}
            own = speeds.pop("ambulance")
            way += step * own
            seconds += step
            others += step * statistics.fmean(speeds.values())
            collisions += libsumo.simulation.getCollidingVehiclesNumber()
        libsumo.close()
        return way / seconds, others / seconds, collisions


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../..")
    parser.add_argument("--bench", default=os.path.join(root, "build/release/septet-bench"))
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--step", type=float, default=0.5, help="SUMO's step, s; Septet's is 0.1 s")
    parser.add_argument("--one", type=int, help="(internal) one seed of SUMO, printed as JSON")
    options = parser.parse_args()
    use_sumo_of_pypi()
    if options.one is not None:
        print(json.dumps(sumo_run(options.one, options.step)))
        return
    runs = {int(entry["name"].split("/")[1]): entry for entry in septet(options.bench, "traffic_emergency_run")}
    print("| seed | Septet: ambulance, traffic m/s | ratio | overlaps | SUMO: ambulance, traffic m/s | ratio | collisions |")
    print("|---|---|---|---|---|---|---|")
    own_ratios, sumo_ratios = [], []
    for seed in range(1, options.seeds + 1):
        # A process each: libsumo holds one simulation per process.
        done = subprocess.run([sys.executable, os.path.abspath(__file__), "--one", str(seed), "--step", str(options.step)], check=True,
                              capture_output=True, text=True)
        ambulance, traffic, collisions = json.loads(done.stdout.strip().splitlines()[-1])
        run = runs[seed]
        own_ratios.append(run["ambulance_mps"] / run["traffic_mps"])
        sumo_ratios.append(ambulance / traffic)
        print(f"| {seed} | {run['ambulance_mps']:.1f}, {run['traffic_mps']:.1f} | {own_ratios[-1]:.2f} | {run['overlaps']:.0f} | "
              f"{ambulance:.1f}, {traffic:.1f} | {sumo_ratios[-1]:.2f} | {collisions} |", flush=True)
    print(f"| median | | {statistics.median(own_ratios):.2f} | | | {statistics.median(sumo_ratios):.2f} | |")


if __name__ == "__main__":
    main()
