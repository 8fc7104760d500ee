#!/usr/bin/env python3
"""Figures 1, 3, 4, 5 and 7 of Johansson et al., "Distributed Ray Tracing in an Open Source Environment", measured with Septet.

    distributed_figures.py FOLDER [--build FOLDER] [--size WIDTHxHEIGHT] [--samples N] [--processors SHARE]

A moment of a drive is traced by programs of one thread whose speeds are made (tests/benchmarks/machines.py): equal ones for figure 3, mixed ones from 1 to 9 for
the others. The paper's scheme, 81 equal buckets to whoever is free, beside Septet's. Figure 2 is a drawing; the fountain of
figure 6 is drawn by septet-fountain (fountain_main.cpp beside this). The paper traces 900 x 900 pixels with 16 samples; the default here is smaller, which is said in each figure.
"""
import argparse
import base64
import math
import pathlib
import random
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import machines

COLOURS = ["#2b6cb0", "#c05621", "#2f855a", "#805ad5", "#b83280", "#4a5568"]
TEXT = 'font-family="sans-serif" font-size="13" fill="#222"'


def svg(width, height, title, lines, body):
    head = f'<text x="16" y="24" {TEXT} font-weight="bold">{title}</text>'
    head += "".join(f'<text x="16" y="{44 + 17 * n}" {TEXT}>{line}</text>' for n, line in enumerate(lines))
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}">'
            f'<rect width="{width}" height="{height}" fill="#fff"/>{head}{body}</svg>\n')


def step(high):
    """A round distance of ticks, about five of them."""
    raw = high / 5 or 1.0
    power = 10 ** math.floor(math.log10(raw))
    return power * min((1, 2, 5, 10), key=lambda factor: abs(math.log(factor * power / raw)))


def axes(place, x_high, y_high, x_label, y_label, x_ticks=True):
    x, y, width, height = place
    body = f'<rect x="{x}" y="{y}" width="{width}" height="{height}" fill="none" stroke="#888"/>'
    for value in range(int(y_high / step(y_high)) + 1):
        value *= step(y_high)
        at = y + height - height * value / y_high
        body += f'<line x1="{x}" x2="{x + width}" y1="{at:.1f}" y2="{at:.1f}" stroke="#ddd"/><text x="{x - 6}" y="{at + 4:.1f}" {TEXT} text-anchor="end">{value:g}</text>'
    if x_ticks:
        for value in range(int(x_high / step(x_high)) + 1):
            value *= step(x_high)
            body += f'<text x="{x + width * value / x_high:.1f}" y="{y + height + 17}" {TEXT} text-anchor="middle">{value:g}</text>'
    body += f'<text x="{x + width / 2}" y="{y + height + 36}" {TEXT} text-anchor="middle">{x_label}</text>'
    return body + f'<text transform="translate({x - 44} {y + height / 2}) rotate(-90)" {TEXT} text-anchor="middle">{y_label}</text>'


def lines_chart(place, series, x_high, y_high, x_label, y_label):
    """series: (name, points, dashed)."""
    x, y, width, height = place
    body = axes(place, x_high, y_high, x_label, y_label)
    for n, (name, points, dashed) in enumerate(series):
        colour = "#999" if dashed else COLOURS[n % len(COLOURS)]
        at = [(x + width * px / x_high, y + height - height * py / y_high) for px, py in points]
        body += (f'<polyline points="{" ".join(f"{a:.1f},{b:.1f}" for a, b in at)}" fill="none" stroke="{colour}" stroke-width="2" '
                 f'stroke-dasharray="{"5 4" if dashed else "none"}"/>')
        if not dashed:
            body += "".join(f'<circle cx="{a:.1f}" cy="{b:.1f}" r="3.5" fill="{colour}"/>' for a, b in at)
        body += f'<line x1="{x + 14}" x2="{x + 38}" y1="{y + 18 + 18 * n}" y2="{y + 18 + 18 * n}" stroke="{colour}" stroke-width="2"/><text x="{x + 44}" y="{y + 22 + 18 * n}" {TEXT}>{name}</text>'
    return body


def bars_chart(place, groups, labels, y_high, y_label):
    """groups: (name, one value for each label)."""
    x, y, width, height = place
    body = axes(place, 1.0, y_high, "program", y_label, x_ticks=False)
    room = width / len(labels)
    for g, (name, values) in enumerate(groups):
        for n, value in enumerate(values):
            tall = height * value / y_high
            wide = 0.8 * room / len(groups)
            body += f'<rect x="{x + room * (n + 0.1) + g * wide:.1f}" y="{y + height - tall:.1f}" width="{wide:.1f}" height="{tall:.1f}" fill="{COLOURS[g]}"/>'
        body += f'<rect x="{x + width - 190}" y="{y + 8 + 18 * g}" width="12" height="12" fill="{COLOURS[g]}"/><text x="{x + width - 172}" y="{y + 19 + 18 * g}" {TEXT}>{name}</text>'
    return body + "".join(f'<text x="{x + room * (n + 0.5):.1f}" y="{y + height + 17}" {TEXT} text-anchor="middle">{label}</text>' for n, label in enumerate(labels))


def tile_map(place, rows, colour_of, width_px, height_px):
    x, y, width, height = place
    sx, sy = width / width_px, height / height_px
    return "".join(f'<rect x="{x + sx * row["left_px"]:.2f}" y="{y + sy * row["top_px"]:.2f}" width="{sx * row["width_px"] + 0.3:.2f}" '
                   f'height="{sy * row["height_px"] + 0.3:.2f}" fill="{colour_of(row)}"/>' for row in rows if row["counts"])


def cost_grey(rows):
    costs = sorted(row["cpu_s"] / (row["width_px"] * row["height_px"]) for row in rows if row["counts"])
    low, high = costs[0], costs[int(0.98 * (len(costs) - 1))]

    def colour(row):
        share = min(1.0, max(0.0, (row["cpu_s"] / (row["width_px"] * row["height_px"]) - low) / max(high - low, 1e-12)))
        return f"#{int(255 * share):02x}" + f"{int(255 * share):02x}" * 2
    return colour, low, high


def tiles_of(made):
    counts = [0] * len(made["shares"])
    for row in made["rows"]:
        counts[row["program"]] += row["counts"]
    return counts


def busy_of(made):
    """Share of the time that each program traced something that counts."""
    busy = [0.0] * len(made["shares"])
    for row in made["rows"]:
        if row["counts"]:
            busy[row["program"]] += row["cpu_s"]
    return [100.0 * work / share / made["time_s"] for work, share in zip(busy, made["shares"])]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--build", type=pathlib.Path, default=pathlib.Path("build/release"))
    parser.add_argument("--size", default="450x450")
    parser.add_argument("--samples", default="4")
    parser.add_argument("--processors", type=float, default=machines.ALL_PACES)
    given = parser.parse_args()
    build, width, height = given.build.resolve(), *map(int, given.size.split("x"))
    given.folder.mkdir(parents=True, exist_ok=True)
    said = f"{width} x {height} pixels, {given.samples} samples each, programs slowed down to their speeds on one machine"

    def write(name, text):
        (given.folder / f"{name}.svg").write_text(text)
        print(given.folder / f"{name}.svg", flush=True)

    with tempfile.TemporaryDirectory(prefix="septet-figures-") as temporary:
        folder = pathlib.Path(temporary)
        session = machines.drive(build, folder)
        (folder / "shots.toml").write_text("[[shot]]\nfrom_s = 1.0\nto_s = 1.02\n")
        arguments = ["--shots", str(folder / "shots.toml"), "--fps", "60", "--size", given.size, "--samples", given.samples]

        def trace(schedule, shares, buckets=81):
            """`samples`: the paper's scheme with buckets of samples: whole pictures of one sample a pixel, cut into equal buckets."""
            sets = ["--sample-sets", given.samples] if schedule == "samples" else []
            made = machines.run(build, session, folder, "paper" if sets else schedule, shares, arguments + sets, buckets)
            print(machines.report(f"{len(shares)} programs, {schedule} {buckets}", made, 1), flush=True)
            return made

        nine = machines.paces(9, given.processors)
        paper = trace("paper", nine)
        colour, low, high = cost_grey(paper["rows"])
        picture = base64.b64encode(next(iter(paper["pictures"].values()))).decode()
        palette = [f"hsl({40 * n} 60% {45 + 12 * (n % 2)}%)" for n in range(9)]
        tall = 300 * height / width
        body = tile_map((16, 74, 300, tall), paper["rows"], colour, width, height)
        body += tile_map((332, 74, 300, tall), paper["rows"], lambda row: palette[row["program"]], width, height)
        body += f'<image x="648" y="74" width="300" height="{tall}" href="data:image/png;base64,{picture}"/>'
        body += bars_chart((72, 104 + tall, 876, 170), [("tiles traced", tiles_of(paper))], [f"{chr(65 + n)} ({share / min(nine):.1f})" for n, share in enumerate(nine)],
                           1.15 * max(tiles_of(paper)), "tiles")
        write("distributed-1-cost-map", svg(964, 340 + tall, "Figure 1: cost of a picture, who traced it, and how much each did, by speed in brackets",
                                            [said + "; the paper's 81 buckets", f"Left: black {1e6 * low:.0f}, white {1e6 * high:.0f} microseconds of a processor a pixel"], body))

        equal = {name: [(1, 1.0)] for name in ("ours", "paper", "samples")}
        for count in (2, 4, 8):
            for name, points in equal.items():
                made = trace(name, [given.processors / 8] * count)
                points.append((count, made["work_s"] * 8 / given.processors / made["time_s"]))
        series = [("Septet", equal["ours"], False), ("81 equal buckets of pixels", equal["paper"], False),
                  ("81 equal buckets of samples", equal["samples"], False), ("ideal", [(0, 0), (8, 8)], True)]
        write("distributed-3-equal-programs", svg(640, 460, "Figure 3: speed-up on equal programs", [said], lines_chart((72, 70, 540, 330), series, 8.5, 8.5, "programs", "speed-up")))

        mixed = machines.paces(15, given.processors)
        unit, hosts = given.processors / 15, list(range(15))
        curves, last = [], {}
        for seed in (1, 2):
            random.Random(seed).shuffle(hosts)
            for name in ("ours", "paper"):
                points = []
                for count in (4, 8, 15):
                    shares = [mixed[n] for n in hosts[:count]]
                    made = last[name] = trace(name, shares)
                    points.append((sum(shares) / unit, made["work_s"] / unit / made["time_s"]))
                curves.append((f"{'Septet' if name == 'ours' else '81 equal buckets'}, list {seed}", points, False))
        curves.append(("ideal", [(0, 0), (15, 15)], True))
        write("distributed-4-mixed-programs", svg(640, 460, "Figure 4: speed-up on programs of speeds 1 to 9", [said],
                                                  lines_chart((72, 70, 540, 330), curves, 16, 16, "relative performance of all programs; 1 is their mean", "speed-up")))
        labels = [f"{share / min(mixed):.0f}" for share in last["paper"]["shares"]]
        write("distributed-5-load-balance", svg(964, 330, "Figure 5: how busy each program was with what counts, by its speed",
                                                [said], bars_chart((72, 70, 876, 200), [("Septet", busy_of(last["ours"])), ("81 equal buckets", busy_of(last["paper"]))], labels, 130, "% of the time")))

        times = [(count, trace("paper", mixed, count)["time_s"]) for count in (15, 36, 81, 200, 400)]
        of_samples = [(count, trace("samples", mixed, count)["time_s"]) for count in (15, 36, 81, 200, 400)]
        own_s = last["ours"]["time_s"]
        top = 1.25 * max(time for _, time in times + of_samples)
        series = [("equal buckets of pixels", times, False), ("equal buckets of samples", of_samples, False), (f"Septet: {own_s:.1f} s", [(0, own_s), (400, own_s)], True)]
        write("distributed-7-buckets", svg(640, 460, "Figure 7: time over the number of buckets, 15 programs of speeds 1 to 9",
                                           [said, "Buckets need no padding here: a sample belongs to one pixel"], lines_chart((72, 86, 540, 316), series, 420, top, "buckets", "time, s")))


if __name__ == "__main__":
    main()
