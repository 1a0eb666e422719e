"""The closing by scipy.ndimage, timed, and compared voxel by voxel with what bpclose wrote.

closing_by_scipy.py DIR SCALE_VOX: DIR holds solid.raw, closing.raw and box.json of stream_to_raw, and `seconds`, the
seconds of each run of bpclose. Exits with 1 if a voxel differs.
"""
import json
import statistics
import sys
import time

import numpy as np
from scipy import ndimage


def load(folder, name, size):
    bits = np.unpackbits(np.fromfile(f"{folder}/{name}.raw", np.uint8), bitorder="little")
    return bits.reshape(size[2], size[1], size[0]).astype(bool)


def reached(solid, margin):
    """The slices that hold `solid` and all voxels within `margin` of it."""
    out = []
    for axis in range(3):
        used = np.flatnonzero(solid.any(axis=tuple(a for a in range(3) if a != axis)))
        out.append(slice(max(0, used[0] - margin), min(solid.shape[axis], used[-1] + margin + 1)))
    return tuple(out)


def close(solid, scale):
    """Cube of radius floor(S) to dilate, ball of radius S around the outer contour to erode."""
    dilation = ndimage.distance_transform_cdt(~solid, metric="chessboard") <= int(scale)
    contour = ndimage.binary_dilation(dilation) & ~dilation
    return solid | (dilation & (ndimage.distance_transform_edt(~contour) >= scale))


def fill(closing):
    """Empty components that do not reach the border, by labels."""
    labels, _ = ndimage.label(~closing)
    border = np.unique(np.concatenate([np.take(labels, i, axis).ravel() for axis in range(3) for i in (0, -1)]))
    return closing | ~np.isin(labels, border)


def main():
    folder, scale = sys.argv[1], float(sys.argv[2])
    size = json.load(open(f"{folder}/box.json"))["size"]
    solid, ours = load(folder, "solid", size), load(folder, "closing", size)
    box = reached(solid, int(scale) + 2)
    start = time.perf_counter()
    theirs = close(solid[box], scale)
    peer = time.perf_counter() - start
    full = np.zeros_like(solid)
    full[box] = fill(theirs)
    differing = int((full != ours).sum())
    seconds = [float(line) for line in open(f"{folder}/seconds")]
    own = statistics.median(seconds)
    print(json.dumps({
        "bench": "bpclose against scipy.ndimage", "grid": list(full[box].shape[::-1]), "scale_vox": scale,
        "solid": int(solid.sum()), "closing": int(ours.sum()), "differing_voxels": differing,
        "bpclose_seconds": round(own, 3), "bpclose_least": round(min(seconds), 3),
        "scipy_seconds": round(peer, 2), "ratio": round(peer / own, 1)}))
    return 1 if differing else 0


sys.exit(main())
