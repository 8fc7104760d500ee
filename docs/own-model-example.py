#!/usr/bin/env python3
"""Writes a small glTF 2.0 file that Septet can draw in the place of a hatchback: a delivery robot with wheels that turn and lamps that shine.

    python3 docs/own-model-example.py my-models/hatchback.glb
"""
import json
import math
import pathlib
import struct
import sys

LENGTH, WIDTH, HEIGHT, WHEELBASE, TRACK, RADIUS = 4.05, 1.74, 1.46, 2.55, 1.58, 0.305


class Gltf:
    def __init__(self):
        self.binary = b""
        self.json = {"asset": {"version": "2.0", "generator": "own-model-example.py"}, "scene": 0,
                     "scenes": [{"nodes": []}], "nodes": [], "meshes": [], "materials": [], "accessors": [],
                     "bufferViews": []}

    def material(self, name, color, metallic=0.0, roughness=0.6, emission=(0, 0, 0)):
        self.json["materials"].append({"name": name, "emissiveFactor": list(emission), "pbrMetallicRoughness": {
            "baseColorFactor": [*color, 1.0], "metallicFactor": metallic, "roughnessFactor": roughness}})
        return len(self.json["materials"]) - 1

    def accessor(self, rows, kind, component, code):
        start = len(self.binary)
        for row in rows:
            self.binary += struct.pack("<" + code * len(row), *row)
        self.binary += b"\0" * (-len(self.binary) % 4)
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": start, "byteLength": len(self.binary) - start})
        accessor = {"bufferView": len(self.json["bufferViews"]) - 1, "componentType": component, "count": len(rows), "type": kind}
        if kind == "VEC3":
            accessor["min"] = [min(row[i] for row in rows) for i in range(3)]
            accessor["max"] = [max(row[i] for row in rows) for i in range(3)]
        self.json["accessors"].append(accessor)
        return len(self.json["accessors"]) - 1

    def node(self, name, quads, material, at=(0.0, 0.0, 0.0)):
        """`quads`: four corners each, counter-clockwise from outside."""
        points, normals, indices = [], [], []
        for quad in quads:
            a, b, c = quad[0], quad[1], quad[2]
            u, v = [b[i] - a[i] for i in range(3)], [c[i] - a[i] for i in range(3)]
            n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
            length = math.sqrt(sum(x * x for x in n)) or 1.0
            first = len(points)
            points += [tuple(p) for p in quad]
            normals += [tuple(x / length for x in n)] * 4
            indices += [(first + i,) for i in (0, 1, 2, 0, 2, 3)]
        self.json["meshes"].append({"primitives": [{
            "attributes": {"POSITION": self.accessor(points, "VEC3", 5126, "f"), "NORMAL": self.accessor(normals, "VEC3", 5126, "f")},
            "indices": self.accessor(indices, "SCALAR", 5123, "H"), "material": material}]})
        self.json["nodes"].append({"name": name, "mesh": len(self.json["meshes"]) - 1, "translation": list(at)})
        self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]) - 1)

    def bytes(self):
        self.json["buffers"] = [{"byteLength": len(self.binary)}]
        text = json.dumps(self.json, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(self.binary), 0x004E4942) + self.binary
        return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def box(low, high, taper=0.0):
    """x left, y up, z forward; the upper face is drawn in by `taper`."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    p = [(x, y, z) for x, y, z in ((x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1),
                                   (x0 + taper, y1, z0 + taper), (x1 - taper, y1, z0 + taper),
                                   (x1 - taper, y1, z1 - taper), (x0 + taper, y1, z1 - taper))]
    return [[p[i] for i in face] for face in ((0, 1, 2, 3), (7, 6, 5, 4), (3, 2, 6, 7), (1, 0, 4, 5), (2, 1, 5, 6), (0, 3, 7, 4))]


def wheel(width, sides=20):
    ring = [(RADIUS * math.sin(2 * math.pi * i / sides), RADIUS * math.cos(2 * math.pi * i / sides)) for i in range(sides + 1)]
    quads = []
    for (y0, z0), (y1, z1) in zip(ring, ring[1:]):
        quads.append([(-width, y0, z0), (width, y0, z0), (width, y1, z1), (-width, y1, z1)])
        quads.append([(width, 0, 0), (width, y1, z1), (width, y0, z0), (width, 0, 0)])
        quads.append([(-width, 0, 0), (-width, y0, z0), (-width, y1, z1), (-width, 0, 0)])
    return quads


def robot():
    gltf = Gltf()
    paint = gltf.material("paint", (1, 1, 1), roughness=0.35)
    dark = gltf.material("dark", (0.03, 0.03, 0.035), roughness=0.5)
    rubber = gltf.material("rubber", (0.02, 0.02, 0.02), roughness=0.9)
    white = gltf.material("head", (0.35, 0.36, 0.38), emission=(1, 1, 0.95))
    red = gltf.material("brake", (0.5, 0.02, 0.02), emission=(1, 0.04, 0.03))
    x, z = WIDTH / 2, LENGTH / 2
    gltf.node("body", box((-x, 0.25, -z), (x, 0.95, z), 0.08), paint)
    gltf.node("box", box((-x + 0.1, 0.95, -z + 0.15), (x - 0.1, HEIGHT, z - 0.9), 0.06), paint)
    gltf.node("eyes", box((-x + 0.25, 0.97, z - 0.92), (x - 0.25, 1.25, z - 0.8)), dark)
    for side, left in (("left", 1), ("right", -1)):
        for end, at in (("front", WHEELBASE / 2), ("rear", -WHEELBASE / 2)):
            gltf.node(f"wheel_{end}_{side}", wheel(0.1), rubber, (left * TRACK / 2, RADIUS, at))
        gltf.node("lamp_head", box((-0.15, -0.06, -0.02), (0.15, 0.06, 0.02)), white, (left * 0.55, 0.6, z - 0.01))
        gltf.node("lamp_brake", box((-0.15, -0.06, -0.02), (0.15, 0.06, 0.02)), red, (left * 0.55, 0.6, -z + 0.01))
    return gltf.bytes()


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    target = pathlib.Path(sys.argv[1])
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_bytes(robot())
