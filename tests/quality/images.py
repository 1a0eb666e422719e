#!/usr/bin/env python3
"""Compares pictures of a scene with those of its levels:  images.py BPINFO SIDE SCENE LEVEL...
One line for each LEVEL: its triangles, and PSNR (dB), SSIM and FLIP, as means of eight views of SIDE pixels. Pictures are those of
`bpinfo --image`, with images and flat light. Needs numpy.
  SSIM  Wang, Bovik, Sheikh, Simoncelli 2004, of luma, Gaussian of 1.5 pixels
  FLIP  Andersson, Nilsson, Akenine-Moller et al. 2020, at 67 pixels per degree; 0 is the same"""
import re
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

import numpy as np

VIEWS = ["35,22", "125,22", "215,22", "305,22", "0,5", "80,60", "170,40", "260,5"]


def read_png(path):
    """8-bit RGB without interlacing, as bpinfo writes it."""
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height = struct.unpack(">II", body[:8])
        if kind == b"IDAT":
            packed += body
        at += size + 12
    rows = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + 3 * width)
    out = np.zeros((height, 3 * width), np.uint8)
    above = np.zeros(3 * width, np.int32)
    for y, row in enumerate(rows):
        kind, line = row[0], row[1:].astype(np.int32)
        if kind == 1:
            line = np.cumsum(line.reshape(-1, 3), 0).reshape(-1)
        elif kind == 2:
            line = line + above
        elif kind in (3, 4):
            for i in range(3 * width):
                a, b, c = (line[i - 3] if i > 2 else 0), above[i], (above[i - 3] if i > 2 else 0)
                if kind == 3:
                    line[i] = (line[i] + (a + b) // 2) & 255
                else:
                    p = a + b - c
                    near = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
                    line[i] = (line[i] + near) & 255
        above = line & 255
        out[y] = above
    return out.reshape(height, width, 3).astype(np.float64) / 255


def filtered(image, kernel_x, kernel_y):
    """Separable convolution with repeated borders; image of two dimensions."""
    rx, ry = len(kernel_x) // 2, len(kernel_y) // 2
    wide = np.pad(image, ((0, 0), (rx, rx)), "edge")
    image = sum(k * wide[:, i:i + image.shape[1]] for i, k in enumerate(kernel_x))
    tall = np.pad(image, ((ry, ry), (0, 0)), "edge")
    return sum(k * tall[i:i + image.shape[0]] for i, k in enumerate(kernel_y))


def gauss(sigma, radius):
    x = np.arange(-radius, radius + 1)
    k = np.exp(-x * x / (2 * sigma * sigma))
    return k / k.sum()


def psnr(a, b):
    mse = ((a - b) ** 2).mean()
    return 99 if mse == 0 else min(99, -10 * np.log10(mse))


def ssim(a, b):
    a, b = (x @ [.299, .587, .114] for x in (a, b))
    k = gauss(1.5, 5)
    mean = lambda x: filtered(x, k, k)
    ma, mb = mean(a), mean(b)
    va, vb, vab = mean(a * a) - ma * ma, mean(b * b) - mb * mb, mean(a * b) - ma * mb
    c1, c2 = .01 ** 2, .03 ** 2
    return (((2 * ma * mb + c1) * (2 * vab + c2)) / ((ma * ma + mb * mb + c1) * (va + vb + c2))).mean()


RGB_TO_XYZ = np.array([[.4123907993, .3575843394, .1804807884], [.2126390059, .7151686788, .0721923154], [.0193308187, .1191947798, .9505321522]])
WHITE = RGB_TO_XYZ.sum(1)


def linear(rgb):
    return np.where(rgb <= .04045, rgb / 12.92, ((rgb + .055) / 1.055) ** 2.4)


def opponent(rgb):
    """sRGB to the linear space YCxCz."""
    x, y, z = np.moveaxis(linear(rgb) @ RGB_TO_XYZ.T / WHITE, -1, 0)
    return np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], -1)


def hunt(ycc):
    """YCxCz to L*a*b*, with colours that count by lightness."""
    y = (ycc[..., 0] + 16) / 116
    xyz = np.stack([y + ycc[..., 1] / 500, y, y - ycc[..., 2] / 200], -1)
    rgb = np.clip(xyz * WHITE @ np.linalg.inv(RGB_TO_XYZ).T, 0, 1)
    xyz = rgb @ RGB_TO_XYZ.T / WHITE
    d = 6 / 29
    f = np.where(xyz > d ** 3, np.cbrt(xyz), xyz / (3 * d * d) + 4 / 29)
    light = 116 * f[..., 1] - 16
    return np.stack([light, .01 * light * 500 * (f[..., 0] - f[..., 1]), .01 * light * 200 * (f[..., 1] - f[..., 2])], -1)


def hyab(a, b):
    d = a - b
    return np.abs(d[..., 0]) + np.sqrt(d[..., 1] ** 2 + d[..., 2] ** 2)


def flip(a, b, ppd=67):
    contrast = [((1, .0047), (0, 1e-5)), ((1, .0053), (0, 1e-5)), ((34.1, .04), (13.5, .025))]
    radius = int(np.ceil(3 * np.sqrt(.04 / (2 * np.pi ** 2)) * ppd))
    x = np.arange(-radius, radius + 1) / ppd

    def seen(image):
        ycc, out = opponent(image), []
        for c, terms in enumerate(contrast):
            parts, total = [], 0
            for weight, width in terms:
                if weight == 0:
                    continue
                k = np.exp(-np.pi ** 2 * x * x / width)
                factor = weight * np.pi / width
                parts.append((factor, k))
                total += factor * k.sum() ** 2
            out.append(sum(f * filtered(ycc[..., c], k, k) for f, k in parts) / total)
        return hunt(np.stack(out, -1))

    green, blue = (hunt(opponent(np.array([[p]], float))) for p in ([0, 1, 0], [0, 0, 1]))
    most = hyab(green, blue)[0, 0] ** .7
    error = hyab(seen(a), seen(b)) ** .7
    cut = .4 * most
    color = np.where(error < cut, .95 / cut * error, .95 + (error - cut) / (most - cut) * .05)
    width = .5 * .082 * ppd
    r = int(np.ceil(3 * width))
    t = np.arange(-r, r + 1)
    g = np.exp(-t * t / (2 * width * width))
    first, second = -t * g, (t * t / (width * width) - 1) * g
    norm = lambda k: np.where(k > 0, k / k[k > 0].sum(), k / -k[k < 0].sum())
    first, second, g = norm(first), norm(second), g / g.sum()

    def features(image):
        y = (opponent(image)[..., 0] + 16) / 116
        size = lambda k: np.hypot(filtered(y, k, g), filtered(y, g, k))
        return size(first), size(second)

    (ea, pa), (eb, pb) = features(a), features(b)
    feature = np.clip(np.maximum(np.abs(ea - eb), np.abs(pa - pb)) / np.sqrt(2), 0, 1) ** .5
    return (color ** (1 - feature)).mean()


def compare(bpinfo, side, scene, levels):
    rows, triangles = [np.zeros(3) for _ in levels], []
    for view in VIEWS:
        with tempfile.TemporaryDirectory() as folder:
            image = Path(folder) / "views.png"
            told = subprocess.run([bpinfo, scene, *levels, "--image", image, "--image-size", str(side), "--view", view, "--up", "y", "-q"],
                                  check=True, capture_output=True, text=True).stdout
            whole = read_png(image)[:side]
        triangles = [int(n.replace(",", "")) for n in re.findall(r"^triangles +([\d,]+)", told, re.M)]
        panels = [whole[:, i * side + 2:(i + 1) * side - 2] for i in range(len(levels) + 1)]
        for row, panel in zip(rows, panels[1:]):
            row += np.array([f(panels[0], panel) for f in (psnr, ssim, flip)]) / len(VIEWS)
    return list(zip(levels, triangles[1:], rows))


if __name__ == "__main__":
    for level, count, row in compare(sys.argv[1], int(sys.argv[2]), sys.argv[3], sys.argv[4:]):
        print("{}\t{}\t{:.2f}\t{:.4f}\t{:.4f}".format(level, count, *row))
