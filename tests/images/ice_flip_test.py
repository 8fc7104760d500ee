"""Distance of ice from the truth: pictures of septet-ice against references of a path tracer (ice/, made by
tests/benchmarks/peers/ice_reference.py), by mean FLIP over the object's pixels.

    ice_flip_test.py SEPTET_ICE

Bounds: what rasterised models of refraction reach by exact ray casts. The paper's equation as printed is no nearer than the front
face alone; with the back normal's other sign it is, but for the peanut, where both are as far; light followed from face to face is nearer still. The quality mode's
bounds are below what exact rays reach that end at a total reflection (.354 for the cube). Of the pair, one sphere stands behind
the other: it is near to the truth only where light goes on through the second one.
"""

import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import flip

REFERENCES = pathlib.Path(__file__).resolve().parent / "ice"
OBJECTS = {"sphere": ["--object", "sphere"], "peanut": ["--object", "peanut"], "cube": ["--object", "cube"],
           "pair": ["--object", "sphere", "--pair"]}
MODES = {"front face": ["--one-sided"], "paper": [], "as a lens": ["--as-a-lens"], "quality": ["--mode", "quality"],
         "quality alone": ["--mode", "quality", "--nothing-beyond"]}
MOST = {"sphere": {"paper": 0.55, "quality": 0.15}, "peanut": {"paper": 0.55, "quality": 0.18}, "cube": {"paper": 0.60, "quality": 0.15},
        "pair": {"quality": 0.15, "quality alone": 1.0}}
CLEAR = ["--bump", "0", "--cracks", "0", "--air", "0", "--absorption", "0"]


def main():
    failed = False
    for name, most in MOST.items():
        reference = flip.read_png(REFERENCES / f"{name}.png")
        figures = {}
        for mode, options in MODES.items():
            if mode not in most and (name == "pair" or mode == "quality alone"):
                continue
            with tempfile.TemporaryDirectory() as folder:
                subprocess.run([sys.argv[1], *OBJECTS[name], "--surroundings", "room", "--surroundings-size", "1024",
                                "--width", "400", "--height", "300", "--share", "0.4", "--pictures", "1", "--software",
                                *CLEAR, *options, "--out", folder], check=True, stdout=subprocess.DEVNULL)
                figures[mode] = flip.mean_flip(reference, flip.read_png(pathlib.Path(folder) / "000.png"))
        print(name, ", ".join(f"{mode} {figure:.3f}" for mode, figure in figures.items()))
        for mode, bound in most.items():
            failed = failed or figures[mode] > bound
        if name == "pair":
            failed = failed or figures["quality"] > 0.5 * figures["quality alone"]
        else:
            failed = failed or figures["quality"] > 0.75 * figures["front face"] or figures["as a lens"] > 1.01 * figures["front face"]
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
