"""Distance of the ray tracer from Mitsuba 3.9.1 (PyPI) on Septet's scenes: means within 1 %, mean FLIP at most .05, of ice at most .12.

    tests/engine/raytrace/peers/compare [--scenes noon night tunnel smoke gloss ice] [--samples N] [--keep FOLDER]

`compare` installs Mitsuba and calls this file. septet-peer-scene draws a scene and writes it; peer_scenes.hpp says what is left out on both
sides. `--variant` is llvm_ad_rgb or scalar_rgb; the first needs LLVM's library (Debian's libllvm19;
DRJIT_LIBLLVM_PATH names it). Traps: Mitsuba's panoramas have y up and ours z; its shadow rays stop at holes unless the integrator is
`volpath`; its lamps shine to one side, as ours; light is lost at the edges of a cube that holds a medium, so smoke lies in a sphere;
its sun is a point unless it is a disc far away; it looks at all places of a mesh that shines alike, however far they are.

Gloss is Mitsuba's own, not our formula: `roughplastic` and `principled` metal, both GGX. They mask and shadow apart where we do it together,
and have Fresnel's equations for plastic where we have Schlick's.

FLIP as measured in one run, with 256 samples: noon .021, night .003, smoke .025, gloss .030, ice .020 and its bodies .045, the tunnel .042; means
within .3 %. What is left in the tunnel is Mitsuba's noise, of 1536 samples there: .070 with 256, .056 with 512, .047 with 1024.
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import drjit
import mitsuba
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "images"))
import flip

MOST_FLIP, MOST_ICE_FLIP, MOST_OFF = 0.05, 0.12, 0.01
SCENES = ["noon", "night", "tunnel", "smoke", "gloss", "ice"]
MORE_SAMPLES = {"tunnel": 6}  # Mitsuba's: its lamps are drawn without regard to what they light.
SUN_COSINE, SUN_M = 0.99998931, 1e6  # engine/raytrace/sky.hpp; far enough to be the same from everywhere.


def read_pfm(path):
    with open(path, "rb") as file:
        file.readline()
        width, height = map(int, file.readline().split())
        file.readline()
        return numpy.frombuffer(file.read(), "<f4").reshape(height, width, 3)[::-1]


def display_code(exposed):
    """engine/light/tone_curve.hpp"""
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


def shiny(color, alpha, f0, metallic):
    """A coloured base below facets; `color` as an array, of an image or not."""
    def reflectance(values):
        return texture(values, "bilinear") if values.ndim == 3 else {"type": "rgb", "value": [float(x) for x in values]}
    metal = {"type": "principled", "base_color": reflectance(color), "metallic": 1.0, "roughness": float(alpha ** 0.5)}
    if metallic >= 1:
        return metal
    index = (1 + f0 ** 0.5) / (1 - f0 ** 0.5)
    plastic = {"type": "roughplastic", "distribution": "ggx", "alpha": float(alpha), "int_ior": index, "ext_ior": 1.0, "nonlinear": False}
    # Head-on the base of both is as bright: Mitsuba's is also lit by its inner reflections.
    at = drjit.zeros(mitsuba.SurfaceInteraction3f)
    at.wi = mitsuba.Vector3f(0, 0, 1)
    white = mitsuba.load_dict({**plastic, "diffuse_reflectance": 1.0, "specular_reflectance": 0.0})
    given = float(numpy.array(white.eval(mitsuba.BSDFContext(), at, mitsuba.Vector3f(0, 0, 1))).flat[0]) * numpy.pi
    # A rough one cannot be as bright as ours where ours is white; the figures tell.
    plastic["diffuse_reflectance"] = reflectance(numpy.minimum(1.0, color * (1 - f0 * (1 - metallic) - color * metallic) ** 2 / given))
    if metallic <= 0:
        return plastic
    return {"type": "blendbsdf", "weight": float(metallic), "plastic": plastic, "metal": metal}


def surface(image, group, holes):
    color = {"type": "rgb", "value": group["color"]}
    opacity = None
    if image:
        color = texture(image[0], "bilinear")
        if holes and image[1].min() < 0.5:
            # Septet cuts where the image between its texels has less than one half; finer texels have the same edge.
            opacity = texture((upsampled(image[1]) >= 0.5)[..., None], "nearest")
    result = {"type": "diffuse", "reflectance": color}
    if gloss := group.get("gloss"):
        under = shiny(image[0] if image else numpy.array(group["color"]), gloss["alpha"], gloss["f0"], gloss["metallic"])
        result = under if gloss["share"] >= 1 else {"type": "blendbsdf", "weight": gloss["share"], "dry": result, "wet": under}
    result = {"type": "twosided", "bsdf": result}
    return {"type": "mask", "opacity": opacity, "bsdf": result} if opacity else result


def lamp(image, group):
    """Light from behind an image, such as a sign, is coloured by it."""
    if image:
        return {"type": "area", "radiance": texture(image[0] * numpy.array(group["emission"], numpy.float32), "bilinear")}
    return {"type": "area", "radiance": {"type": "rgb", "value": group["emission"]}}


def triangles_of(path):
    """A mesh as arrays of three vertices of eight numbers each; the places come first."""
    head, body = path.read_bytes().split(b"end_header\n", 1)
    vertices = int(head.split(b"element vertex ")[1].split()[0])
    return numpy.frombuffer(body, "<f4", 8 * vertices).reshape(-1, 3, 8)


def write_triangles(path, triangles):
    names = "".join(f"property float {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz", "u", "v"))
    count = len(triangles)
    faces = numpy.zeros(count, [("corners", "u1"), ("indices", "<i4", 3)])
    faces["corners"], faces["indices"] = 3, numpy.arange(3 * count).reshape(-1, 3)
    path.write_bytes(f"ply\nformat binary_little_endian 1.0\nelement vertex {3 * count}\n{names}element face {count}\n"
                     "property list uchar int vertex_index\nend_header\n".encode() + triangles.tobytes() + faces.tobytes())


def bands(path, near_m=16.0):
    """Of a mesh that shines its parts by distance from the eye, below twice `near_m`, then up to twice as far each: file, area in m², distance in m.

    Most of what is seen is near, and is lit by what is near: there Mitsuba looks more often.
    """
    triangles = triangles_of(path)
    corners = triangles[..., :3]
    areas = 0.5 * numpy.linalg.norm(numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    distances = numpy.maximum(numpy.linalg.norm(corners.mean(axis=1), axis=1), near_m)
    band = numpy.floor(numpy.log2(distances / near_m)).astype(int)
    for n in numpy.unique(band):
        part = path.with_name(f"{path.stem}_{n}.ply")
        write_triangles(part, triangles[band == n])
        yield part, areas[band == n].sum(), near_m * 2.0 ** n


def upsampled(plane, times=4):
    """By linear interpolation of an image that repeats."""
    def along(values):
        size = values.shape[0]
        at = (numpy.arange(size * times) + 0.5) / times - 0.5
        low = numpy.floor(at).astype(int)
        share = (at - low)[:, None]
        return values[low % size] * (1 - share) + values[(low + 1) % size] * share
    return along(along(plane).T).T


def ice(path, group):
    most = max(group["absorption_per_m"])
    return {"type": "ply", "filename": str(path),
            "surface": {"type": "dielectric", "int_ior": group["inside_index"], "ext_ior": group["outside_index"]},
            # Colours of Mitsuba reach from 0 to 1.
            "interior": {"type": "homogeneous", "albedo": 0.0, "scale": most,
                         "sigma_t": {"type": "rgb", "value": [x / most for x in group["absorption_per_m"]]}}}


def mitsuba_scene(folder, scene):
    transform = mitsuba.ScalarTransform4f
    made = {
        "type": "scene",
        "integrator": {"type": "volpath", "max_depth": scene["longest"], "rr_depth": 1000},
        "sensor": {"type": "perspective", "fov": scene["horizontal_deg"], "fov_axis": "x", "near_clip": 0.01, "far_clip": 1e7,
                   "to_world": transform().look_at(origin=[0, 0, 0], target=scene["ahead"], up=scene["up"]),
                   "film": {"type": "hdrfilm", "width": scene["width"], "height": scene["height"], "pixel_format": "rgb",
                            "rfilter": {"type": "box"}},
                   "sampler": {"type": "independent"}},
    }
    if read_pfm(folder / "sky.pfm").max() > 0:
        made["sky"] = {"type": "envmap", "filename": str(folder / "sky.pfm"), "to_world": transform().rotate([1, 0, 0], 90)}
    if max(scene["sun_irradiance"]) > 0:
        at = SUN_M * numpy.array(scene["to_sun"])
        radiance = numpy.array(scene["sun_irradiance"]) / (2 * numpy.pi * (1 - SUN_COSINE))
        made["sun"] = {"type": "disk", "to_world": transform().look_at(origin=list(at), target=[0, 0, 0], up=[0, 1, 0])
                       .scale(SUN_M * float((1 - SUN_COSINE ** 2) ** 0.5 / SUN_COSINE)),
                       "light": {"type": "area", "radiance": {"type": "rgb", "value": [float(x) for x in radiance]}}}
    # Mitsuba draws each lamp as often as the others, unless it gets their power; then its pictures have less noise.
    lamps = []
    for n, group in enumerate(scene["groups"]):
        path = folder / f"mesh{n}.ply"
        if "inside_index" in group:
            made[f"mesh{n}"] = ice(path, group)
            continue
        image = read_image(folder, group)
        mesh = {"type": "ply", "filename": str(path), "surface": surface(image, group, True)}
        if max(group["emission"]) <= 0:
            made[f"mesh{n}"] = mesh
            continue
        for part, area_m2, distance_m in bands(path):
            made[part.stem] = {**mesh, "filename": str(part), "lamp": lamp(image, group)}
            lamps.append((made[part.stem]["lamp"], max(group["emission"]) * area_m2 / distance_m ** 2))
    # Beside the sky and the sun, each 1.
    all_lamps = 1.0 + 9.0 * (1.0 - scene["share_of_sky"])
    for each, weight in lamps:
        each["sampling_weight"] = float(all_lamps * weight / sum(weight for _, weight in lamps))
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
    options.add_argument("--scenes", nargs="+", choices=SCENES, default=SCENES)
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
            ours, is_ice = read_pfm(folder / "traced.pfm"), read_pfm(folder / "ice.pfm")[..., 0] > 0
            loaded, rounds = mitsuba_scene(folder, scene), max(1, options.samples * MORE_SAMPLES.get(name, 1) // 32)
            theirs = sum(numpy.array(mitsuba.render(loaded, spp=32, seed=n)) for n in range(rounds)) / rounds
            codes = [display_code(picture * scene["exposure"]) for picture in (theirs, ours)]
            for picture, code in zip(("mitsuba", "septet"), codes):
                flip.write_png(folder / f"{picture}.png", code)
        # Of displayable light: a visible lamp is thousands of times as bright as the surfaces that it lights, and
        # affects one pixel.
        shown = [numpy.minimum(picture * scene["exposure"], 4.0).mean(axis=(0, 1)) for picture in (theirs, ours)]
        off, figure = (shown[1] / shown[0] - 1), flip.mean_flip(*codes)
        held = held and max(abs(off)) <= MOST_OFF and figure <= MOST_FLIP
        print(f"{name}: means off by {', '.join(f'{100 * x:+.2f} %' for x in off)}, at most 1 %; FLIP {figure:.4f}, at most {MOST_FLIP}", flush=True)
        if is_ice.any():
            figure = flip.mean_flip(numpy.dstack([codes[0], is_ice]), codes[1])
            held = held and figure <= MOST_ICE_FLIP
            print(f"{name}: of its objects alone FLIP {figure:.4f}, at most {MOST_ICE_FLIP}", flush=True)
    return 0 if held else 1


if __name__ == "__main__":
    sys.exit(main())
