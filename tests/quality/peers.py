#!/usr/bin/env python3
"""Levels to look at against those of gltfpack, in pictures:  peers.py BIN GLTFPACK FOLDER SCENE.obj...
BIN: the folder of bplod and bpinfo. For a quarter and a tenth of a scene's triangles, gltfpack makes a level (-si), and `bplod --mode visual` two:
one with as many triangles, and one whose file has as many bytes without images: of gltfpack -c and of bplod --compression meshopt. Pictures are as large as a level is seen
where it is switched to: bplod's error is a pixel, and the picture has 48 to 400. Rows: scene, share, what is equal, pixels, and for both programs
triangles, bytes, PSNR, SSIM and FLIP (images.py)."""
import json
import struct
import subprocess
import sys
from pathlib import Path

import images


def run(*command):
    return subprocess.run([str(c) for c in command], check=True, capture_output=True, text=True).stdout


def geometry_bytes(path):
    """Bytes of a GLB without its images."""
    data = path.read_bytes()
    size = struct.unpack("<I", data[12:16])[0]
    doc = json.loads(data[20:20 + size])
    held = sum(doc["bufferViews"][i["bufferView"]]["byteLength"] for i in doc.get("images", []) if "bufferView" in i)
    return len(data) - held


class Peers:
    def __init__(self, bin_folder, gltfpack, folder, scene):
        self.bin, self.gltfpack, self.folder, self.scene = Path(bin_folder), gltfpack, Path(folder), Path(scene)
        self.triangles = images.compare(self.bin / "bpinfo", 48, scene, [scene])[0][1]

    def packed(self, share, small):
        # Its images are named relative to its file.
        out = self.scene.parent / f"peer_{self.scene.stem}.glb"
        run(self.gltfpack, "-i", self.scene, "-o", out, "-si", share, "-c" if small else "-noq")
        return out

    def ours(self, faces, *options):
        report = self.folder / "report.json"
        run(self.bin / "bplod", self.scene, "--mode", "visual", "--faces", max(4, int(faces)), "--up", "y", "-o", self.folder, "--name", "own",
            "--overwrite", "-q", "--report", report, *options)
        return self.folder / "own_LOD0.glb", json.loads(report.read_text())["counts"]["levels"][0]

    def row(self, share, what, own, level, packed):
        pixels = int(min(400, max(48, self.diagonal() / max(level["error"], 1e-9))))
        rows = images.compare(self.bin / "bpinfo", pixels, str(self.scene), [str(own), str(packed)])
        text = [f"{self.scene.stem}\t{share:.0%}\t{what}\t{pixels}\t{level.get('from', '')}"]
        for path, (_, count, m) in zip((own, packed), rows):
            text.append("{}\t{}\t{:.2f}\t{:.4f}\t{:.4f}".format(count, geometry_bytes(path), *m))
        print("\t".join(text), flush=True)

    def diagonal(self):
        bounds = json.loads(run(self.bin / "bpinfo", self.scene, "--json", "-q"))["bounds"]
        return sum((b - a) ** 2 for a, b in zip(bounds["min"], bounds["max"])) ** .5

    def compare(self, share):
        packed = self.packed(share, False)
        count = images.compare(self.bin / "bpinfo", 48, str(self.scene), [str(packed)])[0][1]
        own, level = self.ours(count)
        self.row(share, "triangles", own, level, packed)
        packed = self.packed(share, True)
        wanted, faces = geometry_bytes(packed), count
        for _ in range(4):
            own, level = self.ours(faces, "--compression", "meshopt")
            have = geometry_bytes(own)
            if .95 * wanted <= have <= wanted:
                break
            faces = max(4, faces * min(4, max(.2, wanted / have)) * .98)
        self.row(share, "bytes", own, level, packed)


if __name__ == "__main__":
    Path(sys.argv[3]).mkdir(parents=True, exist_ok=True)
    for scene in sys.argv[4:]:
        peers = Peers(*sys.argv[1:4], scene)
        for share in (.25, .1):
            try:
                peers.compare(share)
            except (subprocess.CalledProcessError, IndexError) as e:
                print(f"{peers.scene.stem}\t{share:.0%}\tfailed: {getattr(e, 'stderr', e)}", flush=True)
