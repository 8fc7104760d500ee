#!/usr/bin/env python3
"""Time of one step per tetrahedron: MuJoCo, PyBullet and Septet on the same beam, in one run.

The beam is that of elastic_bend in tests/benchmarks/elastic_benchmark.cpp: cubes of 0.1 m cut into
five tetrahedra, clamped at one end, let go straight and bent by its own weight for 200 steps of
15 ms; 100 MPa, Poisson's ratio 0.25, 1000 kg/m3, one thread, CPU time. Beside the time stands how far
the end has come down in the mean of the last hundred steps, so that it shows who solved the task.
MuJoCo is run twice: as it comes, when its solver stops after 100 iterations and warns at every step
that it has not converged, and with as many iterations as it needs for 1e-6 (no warning). Needs
`pip install mujoco pybullet numpy` (docs/elastic.md names the versions measured) and septet-bench.

    tests/benchmarks/peers/elastic_beam.py build/release/septet-bench
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time

os.environ["OMP_NUM_THREADS"] = "1"

STEP_S = 0.015
YOUNG_PA, POISSON, DENSITY_KGPM3 = 1e8, 0.25, 1000.0
BEAMS = {"105": (1, 1, 21), "990": (3, 3, 22), "5000": (6, 6, 28)}


def lattice(cells, side=0.1):
    """Nodes and tetrahedra; neighbouring cubes are mirror images, so that their faces agree."""
    nx, ny, nz = (c + 1 for c in cells)
    nodes = [(x * side, y * side, z * side) for z in range(nz) for y in range(ny) for x in range(nx)]
    even = ((0, 1, 2, 4), (3, 1, 2, 7), (5, 1, 4, 7), (6, 2, 4, 7), (1, 2, 4, 7))
    tetrahedra = []
    for z in range(cells[2]):
        for y in range(cells[1]):
            for x in range(cells[0]):
                flip = (x + y + z) % 2
                corner = []
                for c in range(8):
                    dx, dy, dz = c & 1, (c >> 1) & 1, (c >> 2) & 1
                    if flip:
                        dx = 1 - dx
                    corner.append((x + dx) + nx * ((y + dy) + ny * (z + dz)))
                for t in even:
                    tetrahedra.append(oriented(nodes, [corner[i] for i in t]))
    return nodes, tetrahedra


def oriented(nodes, t):
    a, b, c, d = (nodes[i] for i in t)
    u, v, w = ([q[k] - a[k] for k in range(3)] for q in (b, c, d))
    volume = sum(
        w[k] * (u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3]) for k in range(3)
    )
    return t if volume > 0 else [t[0], t[2], t[1], t[3]]


def bend(step, end_y, steps=200):
    """Median CPU seconds of a step, and the mean deflection of the end in the second half."""
    start, samples, ends = end_y(), [], []
    for _ in range(steps):
        before = time.process_time()
        step()
        samples.append(time.process_time() - before)
        ends.append(end_y() - start)
    return sorted(samples)[steps // 2], sum(ends[steps // 2:]) / (steps - steps // 2)


def end_nodes(nodes):
    far = max(p[2] for p in nodes)
    return [i for i, p in enumerate(nodes) if p[2] > far - 1e-9]


def mujoco_beam(nodes, tetrahedra, solver=""):
    import mujoco

    pinned = " ".join(str(i) for i, p in enumerate(nodes) if p[2] < 1e-9)
    mass = DENSITY_KGPM3 * 0.1**3 * len(tetrahedra) / 5
    xml = f"""
<mujoco>
  <option timestep="{STEP_S}" integrator="discrete" gravity="0 -9.81 0" {solver}/>
  <worldbody>
    <body name="root">
      <flexcomp name="beam" type="direct" dim="3" mass="{mass}" radius="0.001"
                point="{' '.join(f'{c:g}' for p in nodes for c in p)}"
                element="{' '.join(str(i) for t in tetrahedra for i in t)}">
        <contact selfcollide="none"/>
        <elasticity young="{YOUNG_PA:g}" poisson="{POISSON}" damping="0.003"/>
        <pin id="{pinned}"/>
      </flexcomp>
    </body>
  </worldbody>
</mujoco>"""
    # Euler and the implicit integrators blow up or refuse the flex at this stiffness and step.
    model = mujoco.MjModel.from_xml_string(xml)
    data = mujoco.MjData(model)

    mujoco.mj_forward(model, data)
    end = end_nodes(nodes)
    result = bend(lambda: mujoco.mj_step(model, data), lambda: float(data.flexvert_xpos[end, 1].mean()))
    unconverged = int(data.warning[mujoco.mjtWarning.mjWARN_INERTIA].number)
    print(f"MuJoCo {len(tetrahedra)} {solver or 'as it comes'}: {unconverged} warnings", file=sys.stderr)
    return result


def mujoco_converged_beam(nodes, tetrahedra):
    return mujoco_beam(nodes, tetrahedra, 'iterations="2000" tolerance="1e-6"')


def pybullet_beam(nodes, tetrahedra):
    import pybullet as p

    client = p.connect(p.DIRECT)
    p.resetSimulation(p.RESET_USE_DEFORMABLE_WORLD, physicsClientId=client)
    p.setGravity(0, -9.81, 0, physicsClientId=client)
    p.setTimeStep(STEP_S, physicsClientId=client)
    mass = DENSITY_KGPM3 * 0.1**3 * len(tetrahedra) / 5
    mu = YOUNG_PA / (2 * (1 + POISSON))
    lam = YOUNG_PA * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))
    with tempfile.NamedTemporaryFile("w", suffix=".vtk", delete=False) as f:
        f.write("# vtk DataFile Version 2.0\nbeam\nASCII\nDATASET UNSTRUCTURED_GRID\n")
        f.write(f"POINTS {len(nodes)} double\n")
        f.writelines(f"{x:g} {y:g} {z:g}\n" for x, y, z in nodes)
        f.write(f"CELLS {len(tetrahedra)} {5 * len(tetrahedra)}\n")
        f.writelines("4 " + " ".join(map(str, t)) + "\n" for t in tetrahedra)
        f.write(f"CELL_TYPES {len(tetrahedra)}\n" + "10\n" * len(tetrahedra))
    body = p.loadSoftBody(
        f.name, simFileName=f.name, mass=mass, useNeoHookean=1, NeoHookeanMu=mu,
        NeoHookeanLambda=lam, NeoHookeanDamping=0.01, useSelfCollision=0, collisionMargin=0.001,
        physicsClientId=client)
    os.unlink(f.name)
    for i, node in enumerate(nodes):
        if node[2] < 1e-9:
            p.createSoftBodyAnchor(body, i, -1, -1, physicsClientId=client)

    end = end_nodes(nodes)

    def end_y():
        at = p.getMeshData(body, -1, flags=p.MESH_DATA_SIMULATION_MESH, physicsClientId=client)[1]
        return sum(at[i][1] for i in end) / len(end)

    return bend(lambda: p.stepSimulation(physicsClientId=client), end_y)


def septet_beams(program):
    """Name of the beam to CPU seconds of a step (median of five runs) and deflection."""
    out = subprocess.run(
        [program, "--benchmark_filter=^elastic_bend/", "--benchmark_repetitions=5",
         "--benchmark_report_aggregates_only=true", "--benchmark_format=json"],
        check=True, capture_output=True, text=True).stdout
    return {entry["run_name"].split("/")[1]: (entry["cpu_time"] * 1e-3, entry["deflection_m"])
            for entry in json.loads(out)["benchmarks"] if entry.get("aggregate_name") == "median"}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("septet_bench")
    ours = septet_beams(os.path.abspath(parser.parse_args().septet_bench))
    os.chdir(tempfile.gettempdir())  # MuJoCo writes its warnings into a file where it runs.
    peers = (mujoco_beam, mujoco_converged_beam, pybullet_beam)
    print("| tetrahedra | Septet | MuJoCo | MuJoCo, converged | PyBullet | times Septet's |")
    print("|---|---|---|---|---|---|")
    for name, cells in BEAMS.items():
        nodes, tetrahedra = lattice(cells)
        count = len(tetrahedra)
        row = [ours[name]]
        for peer in peers:
            try:
                row.append(peer(nodes, tetrahedra))
            except Exception as error:  # One peer that refuses must not hide the other.
                print(f"{peer.__name__} {name}: {error}", file=sys.stderr)
                row.append((float("nan"), float("nan")))
        print(f"| {count} | " + " | ".join(f"{s / count * 1e6:.2f} µs, {y:.4f} m" for s, y in row) +
              " | " + ", ".join(f"{s / row[0][0]:.1f}" for s, _ in row[1:]) + " |", flush=True)


if __name__ == "__main__":
    main()
