"""Distance of the rasteriser from the ray tracer, which draws the same description of an instant: mean FLIP a weather.

    renderers_flip_test.py BOTH_RENDERERS [--samples N] [--keep FOLDER]

The bounds are what was measured with 32 samples a pixel, rounded up; a change that brings the two nearer lowers them. Noise is a part of
each figure, most in the tunnel; so are the glare around lamps and the stars that only the rasteriser draws.
FLIP is of pictures as they are shown: dusk has grown by a tenth since the eye adapts to it wholly and the same difference of light is more codes.
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import flip

MOST = {"noon": 0.048, "dusk": 0.092, "night": 0.061, "rain": 0.061, "snow": 0.053, "tunnel": 0.176, "frost": 0.074, "fire": 0.070}
WELL_BELOW = 0.95  # Of its bound: it is time to lower that.


def main():
    options = argparse.ArgumentParser()
    options.add_argument("program")
    options.add_argument("--samples", default="32")
    options.add_argument("--keep", type=pathlib.Path)
    options = options.parse_args()
    failed = False
    for weather, most in MOST.items():
        with tempfile.TemporaryDirectory() as made:
            folder = options.keep / weather if options.keep else pathlib.Path(made)
            folder.mkdir(parents=True, exist_ok=True)
            subprocess.run([options.program, weather, str(folder), options.samples], check=True)
            figure = flip.mean_flip(flip.read_png(folder / "traced.png"), flip.read_png(folder / "raster.png"))
        lower = "; lower its bound" if figure < WELL_BELOW * most else ""
        print(f"{weather} {figure:.4f}, at most {most}{lower}")
        failed = failed or not figure <= most
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
