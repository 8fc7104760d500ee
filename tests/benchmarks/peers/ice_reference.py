"""Draws the references that ice is compared with, by Mitsuba 3.5.2 (PyPI): a path tracer sees the same object in the same panorama.

    python3 -m venv V && V/bin/pip install mitsuba==3.5.2 numpy pillow
    V/bin/python ice_reference.py SEPTET_ICE OUT_FOLDER [SAMPLES [NAME...]]

SEPTET_ICE writes object, panorama and camera (`--reference`). A smooth dielectric of 1.3091 in air of 1.0003, paths of up to
64 bounces, box filter; then Septet's exposure and tone curve. Alpha marks the object.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

import mitsuba
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "images"))
import flip

mitsuba.set_variant("scalar_rgb")
OBJECTS = {"sphere": ["--object", "sphere"], "peanut": ["--object", "peanut"], "cube": ["--object", "cube"],
           "pair": ["--object", "sphere", "--pair"]}
# Of a roofed place, as the room is: engine/instant/instant.cpp.
EXPOSURE = 2.6


def display_code(exposed):
    x = numpy.maximum(0, exposed - 0.004)
    return x * (6.2 * x + 0.5) / (x * (6.2 * x + 1.7) + 0.06)


def scene(folder, camera, hidden):
    transform = mitsuba.ScalarTransform4f
    return mitsuba.load_dict({
        "type": "scene",
        "integrator": {"type": "path", "max_depth": 64, "rr_depth": 65, "hide_emitters": hidden},
        "sensor": {"type": "perspective", "fov": camera["horizontal_deg"], "fov_axis": "x", "near_clip": 0.01, "far_clip": 100.0,
                   "to_world": transform.look_at(origin=camera["eye_m"], target=[0, 0, 0], up=[0, 0, 1]),
                   "film": {"type": "hdrfilm", "width": camera["width_px"], "height": camera["height_px"],
                            "pixel_format": "rgba", "rfilter": {"type": "box"}},
                   "sampler": {"type": "independent", "sample_count": 16}},
        # Mitsuba's panoramas have y up; ours have z up.
        "around": {"type": "envmap", "filename": str(folder / "panorama.pfm"), "to_world": transform.rotate([1, 0, 0], 90)},
        "ice": {"type": "obj", "filename": str(folder / "object.obj"),
                "bsdf": {"type": "dielectric", "int_ior": 1.3091, "ext_ior": 1.0003}},
    })


def main():
    program, out = sys.argv[1], pathlib.Path(sys.argv[2])
    samples = int(sys.argv[3]) if len(sys.argv) > 3 else 256
    names = sys.argv[4:] or list(OBJECTS)
    out.mkdir(parents=True, exist_ok=True)
    for name in names:
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            subprocess.run([program, *OBJECTS[name], "--surroundings", "room", "--width", "400", "--height", "300", "--share", "0.4",
                            "--pictures", "1", "--software", "--reference", folder, "--out", folder], check=True)
            camera = json.loads((folder / "camera.json").read_text())
            light = numpy.array(mitsuba.render(scene(folder, camera, False), spp=samples))
            cover = numpy.array(mitsuba.render(scene(folder, camera, True), spp=16))[..., 3:]
            code = display_code(light[..., :3] * camera["radiance"] * EXPOSURE)
            flip.write_png(out / f"{name}.png", numpy.concatenate([code, cover], axis=2))
            print(name, flush=True)


if __name__ == "__main__":
    main()
