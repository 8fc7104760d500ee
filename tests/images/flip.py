"""Perceived difference of two pictures for a viewer who flips between them: LDR-FLIP.

Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild, "FLIP: A Difference Evaluator for Alternating Images"
(2020), with its constants: 0.7 m from a screen 0.7 m wide with 3840 pixels. Pictures are arrays of sRGB codes from 0 to 1.

    flip.py REFERENCE.png PICTURE.png [--most X]     mean over the pixels that the reference's alpha marks

Also PNG files of 8 bits in and out.
"""

import math
import sys

import numpy
from PIL import Image

PIXELS_PER_DEGREE = 0.7 * 3840 / 0.7 * math.pi / 180
XYZ_OF_RGB = numpy.array([[10135552 / 24577794, 8788810 / 24577794, 4435075 / 24577794],
                          [2613072 / 12288897, 8788810 / 12288897, 887015 / 12288897],
                          [1425312 / 73733382, 8788810 / 73733382, 70074185 / 73733382]])
WHITE = XYZ_OF_RGB.sum(axis=1)


def read_png(path):
    """Rows of pixels of 3 or 4 numbers from 0 to 1."""
    with Image.open(path) as image:
        if image.tile[0][3] not in ("RGB", "RGBA"):  # How its pixels lie in the file; another depth has another name.
            raise ValueError(f"{path}: neither RGB nor RGBA of 8 bits")
        return numpy.asarray(image) / 255.0


def write_png(path, pixels):
    Image.fromarray(numpy.clip(numpy.rint(pixels * 255), 0, 255).astype(numpy.uint8)).save(path)


def linear(codes):
    return numpy.where(codes > 0.04045, ((numpy.maximum(codes, 0) + 0.055) / 1.055) ** 2.4, codes / 12.92)


def opponent(rgb):
    """YCxCz of linear light."""
    x, y, z = numpy.moveaxis(rgb @ XYZ_OF_RGB.T / WHITE, -1, 0)
    return numpy.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], axis=-1)


def rgb_of_opponent(planes):
    y = (planes[..., 0] + 16) / 116
    xyz = numpy.stack([y + planes[..., 1] / 500, y, y - planes[..., 2] / 200], axis=-1) * WHITE
    return xyz @ numpy.linalg.inv(XYZ_OF_RGB).T


def hunt_lab(rgb):
    ratio = rgb @ XYZ_OF_RGB.T / WHITE
    limit = 6 / 29
    f = numpy.where(ratio > limit ** 3, numpy.cbrt(ratio), ratio / (3 * limit ** 2) + 4 / 29)
    lightness = 116 * f[..., 1] - 16
    return numpy.stack([lightness, 0.01 * lightness * 500 * (f[..., 0] - f[..., 1]),
                        0.01 * lightness * 200 * (f[..., 1] - f[..., 2])], axis=-1)


def colour_distance(a, b):
    d = a - b
    return (abs(d[..., 0]) + numpy.hypot(d[..., 1], d[..., 2])) ** 0.7


def filtered(plane, down, across):
    """By the kernel that is the product of a column and a row, the edges' pixels repeated."""
    height, width = plane.shape
    wide = numpy.pad(plane, len(down) // 2, mode="edge")
    columns = sum(weight * wide[j:j + height] for j, weight in enumerate(down))
    return sum(weight * columns[:, i:i + width] for i, weight in enumerate(across))


def as_seen(codes):
    """A picture filtered for that distance, as linear light."""
    radius = math.ceil(3 * math.sqrt(0.04 / (2 * math.pi ** 2)) * PIXELS_PER_DEGREE)
    steps = numpy.arange(-radius, radius + 1) / PIXELS_PER_DEGREE
    planes = opponent(linear(codes))
    for c, terms in enumerate([[(1, 0.0047)], [(1, 0.0053)], [(34.1, 0.04), (13.5, 0.025)]]):
        bells = [(a * math.sqrt(math.pi / b), numpy.exp(-math.pi ** 2 * steps ** 2 / b)) for a, b in terms]
        whole = sum(weight * bell.sum() ** 2 for weight, bell in bells)
        planes[..., c] = sum(weight / whole * filtered(planes[..., c], bell, bell) for weight, bell in bells)
    return numpy.clip(rgb_of_opponent(planes), 0, 1)


def features(codes):
    """Strength of edges and of points."""
    lightness = (opponent(linear(codes))[..., 0] + 16) / 116
    deviation = 0.5 * 0.082 * PIXELS_PER_DEGREE
    radius = math.ceil(3 * deviation)
    steps = numpy.arange(-radius, radius + 1)
    bell = numpy.exp(-steps ** 2 / (2 * deviation ** 2))
    bell /= bell.sum()
    result = []
    for weight in (-steps, steps ** 2 / deviation ** 2 - 1):
        derived = weight * bell
        positive, negative = derived[derived > 0].sum(), -derived[derived < 0].sum()
        derived = numpy.where(derived > 0, derived / positive, derived / negative)
        result.append(numpy.hypot(filtered(lightness, bell, derived), filtered(lightness, derived, bell)))
    return result


def flip(reference, picture):
    """One number a pixel, 0 alike to 1."""
    distance = colour_distance(hunt_lab(as_seen(reference)), hunt_lab(as_seen(picture)))
    most = colour_distance(hunt_lab(linear(numpy.array([0.0, 1.0, 0.0]))), hunt_lab(linear(numpy.array([0.0, 0.0, 1.0]))))
    knee = 0.4 * most
    colour = numpy.where(distance < knee, 0.95 / knee * distance, 0.95 + 0.05 * (distance - knee) / (most - knee))
    differences = [abs(a - b) for a, b in zip(features(reference), features(picture))]
    feature = (numpy.maximum(*differences) / math.sqrt(2)) ** 0.5
    return colour ** (1 - feature)


def mean_flip(reference, picture):
    """Over the pixels that the reference's alpha marks, or all."""
    differences = flip(reference[..., :3], picture[..., :3])
    return float(differences[reference[..., 3] > 0.5].mean() if reference.shape[2] == 4 else differences.mean())


def main():
    figure = mean_flip(read_png(sys.argv[1]), read_png(sys.argv[2]))
    most = float(sys.argv[4]) if len(sys.argv) == 5 and sys.argv[3] == "--most" else 1.0
    print(f"{figure:.4f}")
    return 0 if figure <= most else 1


if __name__ == "__main__":
    sys.exit(main())
