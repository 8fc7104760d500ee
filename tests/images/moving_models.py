#!/usr/bin/env python3
"""Writes 41 small models in motion, one feature each, which model_preview draws for people to judge.

    python3 tests/images/moving_models.py FOLDER      FOLDER/NAME.glb; all have a period of 2 s

Every interpolation of every path; every kind of material on a rigid, a skinned and a morphed mesh; a node that moves
on one that moves; a moving node that mirrors.
"""
import json
import math
import pathlib
import struct
import sys
import zlib

TIMES = [0, 1, 2]
STRIPS = 12


def png(side, color):
    rows = b"".join(b"\0" + b"".join(bytes(color(x, y)) for x in range(side)) for y in range(side))
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", side, side, 8, 6, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def checker(alpha):
    return lambda x, y: (*((230, 60, 40) if (x // 8 + y // 8) % 2 else (250, 240, 200)), alpha(x, y))


def about_y(angle):
    return (0, math.sin(angle / 2), 0, math.cos(angle / 2))


def about_z(angle):
    return (0, 0, math.sin(angle / 2), math.cos(angle / 2))


class File:
    def __init__(self):
        self.binary = b""
        self.json = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [], "meshes": [],
                     "materials": [], "accessors": [], "bufferViews": [], "images": [], "textures": []}

    def add(self, name, value):
        self.json[name].append(value)
        return len(self.json[name]) - 1

    def view(self, data):
        self.binary += b"\0" * (-len(self.binary) % 4)
        self.binary += data
        return self.add("bufferViews", {"buffer": 0, "byteOffset": len(self.binary) - len(data), "byteLength": len(data)})

    def rows(self, rows, kind, component=5126, code="f"):
        rows = [row if isinstance(row, (list, tuple)) else (row,) for row in rows]
        accessor = {"bufferView": self.view(b"".join(struct.pack("<" + code * len(row), *row) for row in rows)),
                    "componentType": component, "count": len(rows), "type": kind}
        if component == 5126:
            accessor["min"], accessor["max"] = [list(map(least, zip(*rows))) for least in (min, max)]
        if component == 5121:
            accessor["normalized"] = True
        return self.add("accessors", accessor)

    def texture(self, color, side=64):
        image = self.add("images", {"bufferView": self.view(png(side, color)), "mimeType": "image/png"})
        return {"index": self.add("textures", {"source": image})}

    def animate(self, *channels):
        animation = {"samplers": [], "channels": []}
        for node, path, values, kind, interpolation in channels:
            animation["samplers"].append({"input": self.rows(TIMES, "SCALAR"), "output": self.rows(values, kind),
                                          "interpolation": interpolation})
            animation["channels"].append({"sampler": len(animation["samplers"]) - 1,
                                          "target": {"node": node, "path": path}})
        self.json["animations"] = [animation]

    def write(self, path):
        self.binary += b"\0" * (-len(self.binary) % 4)
        self.json["buffers"] = [{"byteLength": len(self.binary)}]
        text = json.dumps({name: value for name, value in self.json.items() if value != []}).encode()
        text += b" " * (-len(text) % 4)
        path.write_bytes(b"glTF" + struct.pack("<II", 2, 28 + len(text) + len(self.binary)) +
                         struct.pack("<I", len(text)) + b"JSON" + text + struct.pack("<I", len(self.binary)) + b"BIN\0" +
                         self.binary)


def material(file, kind):
    """A material, and what its vertices carry beside place, normal and coordinates."""
    base, made, layers = {"metallicFactor": 0, "roughnessFactor": 0.6}, {"doubleSided": kind != "one-side"}, []
    if kind in ("opaque", "one-side", "unlit", "emission", "normals"):
        base["baseColorTexture"] = file.texture(checker(lambda x, y: 255))
    if kind == "blend":
        base["baseColorFactor"], made["alphaMode"] = [0.9, 0.3, 0.1, 0.4], "BLEND"
    if kind == "blend-picture":
        base["baseColorTexture"], made["alphaMode"] = file.texture(checker(lambda x, y: 4 * x)), "BLEND"
    if kind == "mask":
        base["baseColorTexture"], made["alphaMode"] = file.texture(checker(lambda x, y: 4 * x)), "MASK"
        made["alphaCutoff"] = 0.25
    if kind == "unlit":
        made["extensions"] = {"KHR_materials_unlit": {}}
    if kind == "emission":
        made["emissiveFactor"] = [1, 1, 1]
        made["emissiveTexture"] = {**file.texture(lambda x, y: (0, 4 * y, 255 - 4 * y, 255)), "texCoord": 1}
        layers = ["TEXCOORD_1"]
    if kind == "normals":
        lean = lambda x: 128 + int(90 * math.sin(x * math.pi / 8))
        made["normalTexture"] = file.texture(lambda x, y: (lean(x), 128, 218, 255))
        layers = ["TANGENT"]
    if kind == "colours":
        layers = ["COLOR_0"]
    made["pbrMetallicRoughness"] = base
    return file.add("materials", made), layers


def mesh(file, places, normals, uvs, indices, kind, more=lambda: ({}, {})):
    number, layers = material(file, kind)
    attributes = {"POSITION": file.rows(places, "VEC3"), "NORMAL": file.rows(normals, "VEC3"),
                  "TEXCOORD_0": file.rows(uvs, "VEC2")}
    if "TEXCOORD_1" in layers:
        attributes["TEXCOORD_1"] = file.rows([(v, u) for u, v in uvs], "VEC2")
    if "TANGENT" in layers:
        attributes["TANGENT"] = file.rows([(0, 1, 0, 1) if abs(n[0]) > 0.5 else (1, 0, 0, 1) for n in normals], "VEC4")
    if "COLOR_0" in layers:
        codes = [(37 * i % 256, 91 * i % 256, 153 * i % 256, 255) for i in range(len(places))]
        attributes["COLOR_0"] = file.rows(codes, "VEC4", 5121, "B")
    of_vertices, of_primitive = more()
    primitive = {"attributes": {**attributes, **of_vertices}, "material": number, **of_primitive,
                 "indices": file.rows(indices, "SCALAR", 5125, "I")}
    return file.add("meshes", {"primitives": [primitive]})


def cube(file, kind, half=0.5, targets=False):
    places, normals, uvs, indices = [], [], [], []
    for axis in range(3):
        for side in (-1, 1):
            first = len(places)
            for p, q in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                place = [0, 0, 0]
                place[axis], place[(axis + 1) % 3], place[(axis + 2) % 3] = side, p, side * q
                places.append(tuple(half * x for x in place))
                normals.append(tuple(side if i == axis else 0 for i in range(3)))
                uvs.append(((p + 1) / 2, (q + 1) / 2))
            indices += [first, first + 1, first + 2, first, first + 2, first + 3]
    taller = [(0, 0.9 if y > 0 else 0, 0) for _, y, _ in places]
    wider = [(x * (1 - y), 0, z * (1 - y)) for x, y, z in places]
    more = lambda: ({}, {"targets": [{"POSITION": file.rows(rows, "VEC3")} for rows in (taller, wider)]} if targets else {})
    return mesh(file, places, normals, uvs, indices, kind, more)


def board(file):
    """What is seen behind what moves."""
    file.json["scenes"][0]["nodes"].append(
        file.add("nodes", {"mesh": cube(file, "opaque"), "translation": [0.6, 1, -1.3], "scale": [2.4, 0.3, 0.1]}))


def rigid(kind, channel=None):
    file = File()
    file.add("nodes", {"mesh": cube(file, kind), "translation": [0, 1, 0]})
    board(file)
    file.animate(channel or (0, "rotation", [about_y(0), about_y(1.5), about_y(3)], "VEC4", "LINEAR"))
    return file


def morphed(kind, weights=(0, 0, 1, 0, 0, 1), interpolation="LINEAR"):
    file = File()
    file.add("nodes", {"mesh": cube(file, kind, targets=True), "translation": [0, 1, 0]})
    board(file)
    file.animate((0, "weights", weights, "SCALAR", interpolation))
    return file


def skinned(kind):
    """An upright strip that bends about its middle while it turns."""
    file = File()
    places = [(x, 2 * i / STRIPS, 0) for i in range(STRIPS + 1) for x in (-0.3, 0.3)]
    indices = [k for i in range(0, 2 * STRIPS, 2) for k in (i, i + 1, i + 3, i, i + 3, i + 2)]
    joints = lambda: ({"JOINTS_0": file.rows([(0, 1, 0, 0)] * len(places), "VEC4", 5123, "H"),
                       "WEIGHTS_0": file.rows([(1 - y / 2, y / 2, 0, 0) for _, y, _ in places], "VEC4")}, {})
    file.add("nodes", {"skin": 0, "mesh": mesh(file, places, [(0, 0, 1)] * len(places),
                                               [(x / 0.6 + 0.5, 1 - y / 2) for x, y, _ in places], indices, kind, joints)})
    file.add("nodes", {"children": [2]})
    file.add("nodes", {"translation": [0, 1, 0]})
    file.json["scenes"][0]["nodes"].append(1)
    bound = [(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, y, 0, 1) for y in (0, -1)]
    file.json["skins"] = [{"joints": [1, 2], "inverseBindMatrices": file.rows(bound, "MAT4")}]
    board(file)
    file.animate((2, "rotation", [about_z(-1.4), about_z(0), about_z(1.4)], "VEC4", "LINEAR"),
                 (1, "rotation", [about_y(0), about_y(0.6), about_y(2.6)], "VEC4", "LINEAR"))
    return file


def chain(mirrors):
    file = File()
    shape = cube(file, "opaque", 0.35)
    file.add("nodes", {"mesh": shape, "children": [1], "translation": [0, 1, 0]})
    file.add("nodes", {"mesh": shape, "translation": [1, 0, 0], "scale": [-0.6 if mirrors else 0.6, 0.6, 0.6]})
    board(file)
    file.animate((0, "rotation", [about_y(0), about_y(1.5), about_y(3)], "VEC4", "LINEAR"),
                 (1, "rotation", [about_z(0), about_z(1.5), about_z(3)], "VEC4", "LINEAR"))
    return file


def cubic(values, slope):
    """Each value between its slopes, of which the middle one alone is not level."""
    level = (0,) * len(slope)
    return [row for i, value in enumerate(values) for row in ((slope if i == 1 else level), value, level)]


def models():
    paths = {"translation": ([(-0.8, 1, 0), (0, 1.5, 0), (0.8, 1, 0)], "VEC3", (0, 3, 0)),
             "rotation": ([about_y(0), about_y(1.5), about_y(3)], "VEC4", (0, 1, 0, -1)),
             "scale": ([(1, 1, 1), (0.4, 1.6, 0.4), (1.2, 0.5, 1.2)], "VEC3", (0, 2, 0))}
    for path, (values, kind, slope) in paths.items():
        for interpolation in ("STEP", "LINEAR"):
            yield f"{path}-{interpolation.lower()}", rigid("opaque", (0, path, values, kind, interpolation))
        yield f"{path}-cubic", rigid("opaque", (0, path, cubic(values, slope), kind, "CUBICSPLINE"))
    weights = [(0, 0), (1, 0), (0, 1)]
    for interpolation in ("STEP", "LINEAR"):
        yield f"weights-{interpolation.lower()}", morphed("opaque", sum(weights, ()), interpolation)
    yield "weights-cubic", morphed("opaque", sum(cubic(weights, (1, 1)), ()), "CUBICSPLINE")
    for kind in ("opaque", "one-side", "blend", "blend-picture", "mask", "unlit", "emission", "normals", "colours"):
        for make in (rigid, skinned, morphed):
            yield f"{make.__name__}-{kind}", make(kind)
    yield "chain", chain(False)
    yield "chain-mirrored", chain(True)


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for name, model in models():
        model.write(folder / f"{name}.glb")
