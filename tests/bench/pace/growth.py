#!/usr/bin/env python3
"""How time and memory grow with triangles, voxels and faces: `bpvox | bpclose | bpmesh` of generated plants.
  growth.py BIN_DIR [--triangles 1e5,1e6] [--voxels 256,512,1024] [--faces 1000,5000,20000] [--memory 1G] [--table FILE] [--svg FILE] [--work FOLDER]
  growth.py --draw TABLE --svg FILE
BIN_DIR is a build, or a folder of programs as pace.py takes it. One of the three varies, the others stay at 10^6 triangles, 1024 voxels along the longest side and
5000 faces; the scale is 5 voxels. Prints a line for each run: seconds from file to file, those of the processor, and the largest peak of
the three in MiB; then the slopes between the first and the last of each row, on logarithmic axes."""
import argparse
import math
import tempfile

from pace import Programs

FIXED = {"triangles": 10**6, "voxels": 1024, "faces": 5000}
COLUMNS = ("varies", *FIXED, "seconds", "processor", "mib")


def run(folder, programs, scene, o, memory):
    more = ("--memory", memory, "--temp", folder, "--overwrite")
    return programs.run(("bpvox", scene, "--resolution", o["voxels"], *more), ("bpclose", "--scale", "5vx", *more),
                        ("bpmesh", "--enclose", "closing", "--faces", o["faces"], "-o", f"{folder}/proxy.ply", *more))


def measure(o):
    rows, known, programs = [], {}, Programs(o.bin_dir)
    with tempfile.TemporaryDirectory(prefix="bp-growth-", dir=o.work) as folder:
        made = None
        for varies in FIXED:
            for value in (int(float(v)) for v in getattr(o, varies).split(",") if v):
                one = {**FIXED, varies: value}
                key = tuple(one.values())
                if made != one["triangles"]:
                    made = one["triangles"]
                    programs.run(("bp-plant", "--triangles", made, "--seed", 7, "-o", f"{folder}/plant.ply", "--overwrite"))
                if key not in known:
                    known[key] = [float(f"{x:.4g}") for x in run(folder, programs, f"{folder}/plant.ply", one, o.memory)]
                rows.append([varies, *key, *known[key]])
                print(*rows[-1], sep="\t", flush=True)
    return rows


def series(rows, varies):
    at = COLUMNS.index(varies)
    return sorted([r[at], r[4], r[6]] for r in rows if r[0] == varies)


def slope(points, k):
    return math.log(points[-1][k] / points[0][k]) / math.log(points[-1][0] / points[0][0])


def svg(rows):
    """Three graphs side by side, logarithmic; the thin line has slope 1."""
    out = ['<svg xmlns="http://www.w3.org/2000/svg" width="960" height="360" font-family="sans-serif" font-size="12">',
           '<rect width="960" height="360" fill="white"/>']
    parts = [(v, series(rows, v)) for v in FIXED if len(series(rows, v)) > 1]
    low, high = 0.1, 10 ** math.ceil(math.log10(max(max(p[1:]) for _, s in parts for p in s)))
    for i, (varies, points) in enumerate(parts):
        left, width, top, height = 60 + 310 * i, 240, 40, 270
        x = lambda v: left + width * math.log(v / points[0][0]) / math.log(points[-1][0] / points[0][0])
        y = lambda v: top + height * (1 - math.log(v / low) / math.log(high / low))
        out.append(f'<text x="{left}" y="24" font-size="14">against {varies}{" along the longest side" * (varies == "voxels")}</text>')
        for e in range(round(math.log10(low)), round(math.log10(high)) + 1):
            out.append(f'<path d="M{left} {y(10**e):.0f}h{width}" stroke="#ddd"/><text x="{left - 6}" y="{y(10**e) + 4:.0f}" text-anchor="end">{10**e:g}</text>')
        for v, *_ in points:
            name = f"10{''.join('⁰¹²³⁴⁵⁶⁷⁸⁹'[int(c)] for c in str(round(math.log10(v))))}" if v >= 10**5 and math.log10(v) % 1 < 1e-9 else f"{v:,}"
            out.append(f'<path d="M{x(v):.0f} {top + height}v5" stroke="#333"/><text x="{x(v):.0f}" y="{top + height + 18}" text-anchor="middle">{name}</text>')
        end = points[0][1] * points[-1][0] / points[0][0]
        stop = points[-1][0] if end <= high else points[0][0] * high / points[0][1]
        out.append(f'<path d="M{x(points[0][0]):.0f} {y(points[0][1]):.0f}L{x(stop):.0f} {y(min(end, high)):.0f}" stroke="#999" stroke-dasharray="3 4"/>')
        for k, color, name in ((1, "#4477aa", "seconds"), (2, "#ee6677", "MiB")):
            line = " ".join(f"{x(p[0]):.1f},{y(p[k]):.1f}" for p in points)
            out.append(f'<polyline points="{line}" fill="none" stroke="{color}" stroke-width="2"/>')
            out += [f'<circle cx="{x(p[0]):.1f}" cy="{y(p[k]):.1f}" r="3" fill="{color}"/>' for p in points]
            out.append(f'<text x="{left + 8}" y="{top + 14 + 16 * (2 - k)}" fill="{color}">{name}, slope {slope(points, k):.2f}</text>')
    out.append('<text x="60" y="350" fill="#555">Logarithmic axes. Dashed: slope 1, from the first seconds on.</text></svg>')
    return "\n".join(out) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin_dir", nargs="?")
    for name, value in (("--triangles", "1e5,1e6"), ("--voxels", "256,512,1024"), ("--faces", "1000,5000,20000"), ("--memory", "1G")):
        parser.add_argument(name, default=value)
    for name in ("--table", "--svg", "--draw", "--work"):
        parser.add_argument(name)
    o = parser.parse_args()
    print(*COLUMNS, sep="\t")
    if o.draw:
        lines = [line.split("\t") for line in open(o.draw).read().splitlines()[1:]]
        rows = [[l[0], *map(int, l[1:4]), *map(float, l[4:])] for l in lines]
    else:
        rows = measure(o)
    for varies in FIXED:
        points = series(rows, varies)
        if len(points) > 1:
            print(f"slope against {varies}: seconds {slope(points, 1):.2f}, memory {slope(points, 2):.2f}")
    if o.table:
        open(o.table, "w").write("\n".join("\t".join(map(str, r)) for r in [COLUMNS, *rows]) + "\n")
    if o.svg:
        open(o.svg, "w").write(svg(rows))


main()
