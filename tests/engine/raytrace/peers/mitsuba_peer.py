"""How near the ray tracer is to Mitsuba 3.9.1 (PyPI) on Septet's scenes: means within 1 %, mean FLIP at most .05.

    python3 -m venv V && V/bin/pip install mitsuba==3.9.1 numpy
    V/bin/python mitsuba_peer.py SEPTET_PEER_SCENE [--samples N] [--scenes noon night tunnel smoke] [--keep FOLDER]

SEPTET_PEER_SCENE (built when asked for) draws a scene and writes it; its head says what is left out on both sides. `--variant` is
llvm_ad_rgb or scalar_rgb; the first needs LLVM's library (Debian's libllvm19; DRJIT_LIBLLVM_PATH names it). Traps: Mitsuba's
panoramas have y up and ours z; its shadow rays stop at holes unless the integrator is `volpath`; its lamps shine to one side, as ours; light is
lost at the edges of a cube that holds a medium, so smoke lies in a sphere.
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import mitsuba
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "images"))
import flip

MOST_FLIP, MOST_OFF = 0.05, 0.01


def read_pfm(path):
    with open(path, "rb") as file:
        file.readline()
        width, height = map(int, file.readline().split())
        file.readline()
        return numpy.frombuffer(file.read(), "<f4").reshape(height, width, 3)[::-1]


def display_code(exposed):
    """engine/instant/tone_curve.hpp"""
    x = numpy.maximum(0, exposed - 0.004)
    return numpy.clip(x * (6.2 * x + 0.5) / (x * (6.2 * x + 1.7) + 0.06), 0, 1)


def texture(values, filtering):
    return {"type": "bitmap", "bitmap": mitsuba.Bitmap(numpy.ascontiguousarray(values, numpy.float32)), "raw": True, "filter_type": filtering}


def read_image(folder, group):
    """Linear colours of the group's surface, and its alpha; none without an image."""
    if group["image"] < 0:
        return None
    image = numpy.array(mitsuba.Bitmap(str(folder / f"image{group['image']}.png"))).astype(numpy.float32) / 255
    rgb = image[..., :3]
    if group["srgb"]:
        rgb = numpy.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    return rgb * numpy.array(group["color"], numpy.float32), image[..., 3]


def surface(image, group, holes):
    color = {"type": "rgb", "value": group["color"]}
    opacity = None
    if image:
        color = texture(image[0], "bilinear")
        if holes and image[1].min() < 0.5:
            # Septet cuts where the image between its texels has less than one half; finer texels have the same edge.
            opacity = texture((upsampled(image[1]) >= 0.5)[..., None], "nearest")
    result = {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": color}}
    return {"type": "mask", "opacity": opacity, "bsdf": result} if opacity else result


def lamp(image, group):
    """What shines behind an image, such as a sign, is coloured by it."""
    if image:
        return {"type": "area", "radiance": texture(image[0] * numpy.array(group["emission"], numpy.float32), "bilinear")}
    return {"type": "area", "radiance": {"type": "rgb", "value": group["emission"]}}


def area_m2(path):
    """Of a mesh's triangles, three vertices of eight numbers each."""
    head, body = path.read_bytes().split(b"end_header\n", 1)
    vertices = int(head.split(b"element vertex ")[1].split()[0])
    corners = numpy.frombuffer(body, "<f4", 8 * vertices).reshape(-1, 3, 8)[..., :3]
    return 0.5 * numpy.linalg.norm(numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum()


def upsampled(plane, times=4):
    """By linear interpolation of an image that repeats."""
    def along(values):
        size = values.shape[0]
        at = (numpy.arange(size * times) + 0.5) / times - 0.5
        low = numpy.floor(at).astype(int)
        share = (at - low)[:, None]
        return values[low % size] * (1 - share) + values[(low + 1) % size] * share
    return along(along(plane).T).T


def mitsuba_scene(folder, scene):
    transform = mitsuba.ScalarTransform4f
    made = {
        "type": "scene",
        "integrator": {"type": "volpath", "max_depth": scene["longest"], "rr_depth": 1000},
        "sensor": {"type": "perspective", "fov": scene["horizontal_deg"], "fov_axis": "x", "near_clip": 0.01, "far_clip": 1e5,
                   "to_world": transform().look_at(origin=[0, 0, 0], target=scene["ahead"], up=scene["up"]),
                   "film": {"type": "hdrfilm", "width": scene["width"], "height": scene["height"], "pixel_format": "rgb",
                            "rfilter": {"type": "box"}},
                   "sampler": {"type": "independent"}},
    }
    if read_pfm(folder / "sky.pfm").max() > 0:
        made["sky"] = {"type": "envmap", "filename": str(folder / "sky.pfm"), "to_world": transform().rotate([1, 0, 0], 90)}
    if max(scene["sun_irradiance"]) > 0:
        made["sun"] = {"type": "directional", "direction": [-x for x in scene["to_sun"]],
                       "irradiance": {"type": "rgb", "value": scene["sun_irradiance"]}}
    # Mitsuba draws each lamp as often as the others, unless it is told what they give; then its pictures have less noise.
    powers = {n: max(group["emission"]) * area_m2(folder / f"mesh{n}.ply") for n, group in enumerate(scene["groups"])}
    mean_power = sum(powers.values()) / max(1, sum(power > 0 for power in powers.values()))
    for n, group in enumerate(scene["groups"]):
        image = read_image(folder, group)
        made[f"mesh{n}"] = {"type": "ply", "filename": str(folder / f"mesh{n}.ply"), "surface": surface(image, group, True)}
        if powers[n] > 0:
            made[f"mesh{n}"]["lamp"] = {**lamp(image, group), "sampling_weight": float(powers[n] / mean_power)}
    if scene["smoke"]:
        low, high = numpy.array(scene["smoke"]["low_m"]), numpy.array(scene["smoke"]["high_m"])
        made["air"] = {"type": "sphere", "center": list((low + high) / 2), "radius": float((high - low)[0] / 2),
                       "surface": {"type": "null"},
                       "interior": {"type": "heterogeneous", "albedo": {"type": "constvolume", "value": {"type": "rgb", "value": scene["smoke"]["albedo"]}},
                                    "sigma_t": {"type": "gridvolume", "filename": str(folder / "smoke.vol"), "filter_type": "nearest",
                                                "to_world": transform().translate(list(low)).scale(list(high - low))}}}
    return mitsuba.load_dict(made)


def main():
    options = argparse.ArgumentParser()
    options.add_argument("program")
    options.add_argument("--samples", type=int, default=256)
    options.add_argument("--scenes", nargs="+", default=["noon", "night", "tunnel", "smoke"])
    options.add_argument("--variant", default="llvm_ad_rgb")
    options.add_argument("--keep", type=pathlib.Path)
    options = options.parse_args()
    mitsuba.set_variant(options.variant)
    held = True
    for name in options.scenes:
        with tempfile.TemporaryDirectory() as made:
            folder = options.keep / name if options.keep else pathlib.Path(made)
            folder.mkdir(parents=True, exist_ok=True)
            subprocess.run([options.program, name, str(folder), str(options.samples)], check=True)
            scene = json.loads((folder / "scene.json").read_text())
            ours = read_pfm(folder / "traced.pfm")
            loaded, rounds = mitsuba_scene(folder, scene), max(1, options.samples // 32)
            theirs = sum(numpy.array(mitsuba.render(loaded, spp=32, seed=n)) for n in range(rounds)) / rounds
            codes = [display_code(picture * scene["exposure"]) for picture in (theirs, ours)]
            for picture, code in zip(("mitsuba", "septet"), codes):
                flip.write_png(folder / f"{picture}.png", code)
        # Of what can be shown: a lamp that is seen is thousands of times as bright as what it lights, and is one pixel's matter.
        shown = [numpy.minimum(picture * scene["exposure"], 4.0).mean(axis=(0, 1)) for picture in (theirs, ours)]
        off, figure = (shown[1] / shown[0] - 1), flip.mean_flip(*codes)
        held = held and max(abs(off)) <= MOST_OFF and figure <= MOST_FLIP
        print(f"{name}: means off by {', '.join(f'{100 * x:+.2f} %' for x in off)}, at most 1 %; FLIP {figure:.4f}, at most {MOST_FLIP}", flush=True)
    return 0 if held else 1


if __name__ == "__main__":
    sys.exit(main())
