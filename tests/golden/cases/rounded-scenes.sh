# Scenes that are read with rounding: in single precision (DXF), and with a node that turns (glTF). Whatever ends with 0
# has a proof.
source_scene() {  # FORMAT X
  PYTHONPATH=$BP_ROOT/tests/golden PYTHONDONTWRITEBYTECODE=1 python3 - "$@" <<'PY'
from dxf import print_dxf
import json, math, struct, base64, sys
kind, x0 = sys.argv[1], float(sys.argv[2])
box = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
def corners(low, size, slant):
    return [(x0 + low[0] + size[0] * a + slant * c, low[1] + size[1] * b, low[2] + size[2] * c)
            for a in (0, 1) for b in (0, 1) for c in (0, 1)]
v, faces = [], []
for low, size, slant in (((0.1, 0.2, 0.3), (3.3, 1.1, 0.7), 0), ((0.7, 0.4, 1), (0.9, 0.8, 2.3), 0.3),
                         ((2.1, 0.3, 0.9), (0.7, 0.7, 1.3), -0.2)):
    n = len(v)
    v += corners(low, size, slant)
    faces += [tuple(n + i for i in t) for a, b, c, e in box for t in ((a, b, c), (a, c, e))]
if kind == "dxf":
    print_dxf(v, faces)
else:
    flat = struct.pack("<%df" % (3 * len(v)), *(c for p in v for c in p))
    index = struct.pack("<%dH" % (3 * len(faces)), *(i for f in faces for i in f))
    uri = "data:application/octet-stream;base64," + base64.b64encode(flat + index).decode()
    low, high = ([m(p[k] for p in v) for k in range(3)] for m in (min, max))
    json.dump({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
               "nodes": [{"mesh": 0, "rotation": [0, math.sin(0.2), 0, math.cos(0.2)]}],
               "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
               "buffers": [{"byteLength": len(flat + index), "uri": uri}],
               "bufferViews": [{"buffer": 0, "byteLength": len(flat)},
                               {"buffer": 0, "byteOffset": len(flat), "byteLength": len(index)}],
               "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(v), "type": "VEC3", "min": low,
                              "max": high},
                             {"bufferView": 1, "componentType": 5123, "count": 3 * len(faces), "type": "SCALAR"}]},
              sys.stdout)
PY
}
proof() {  # SCENE OPTION... PROXY
  bpcheck "$@" > verdict 2> note
  echo "  ${*:2}: exit $?, $(tail -1 verdict)"
}
source_scene dxf 0 > near.dxf
source_scene dxf 5000 > far.dxf
source_scene gltf 0 > turned.gltf
for scene in near.dxf far.dxf turned.gltf; do
  bpcheck $scene $scene 2> /dev/null | grep "^  coordinates" | sed "s/^  /$scene: /"
  for profile in gltf collision cage occluder 3dtiles; do
    rm -rf out
    bplod $scene --profile $profile --resolution 64 -o out -q > /dev/null 2> note || { cat note; continue; }
    case $profile in
      occluder) proof $scene --inside out/*.glb ;;
      3dtiles) proof $scene out/tileset.json ;;
      collision)
        proof $scene out/*_unity.glb
        proof $scene --convex out/*_unreal.glb ;;
      *) proof $scene $(ls out/*.glb | head -1) ;;
    esac
  done
  rm -f scene.bpv proxy.obj
  bpvox $scene --resolution 64 -o scene.bpv 2> /dev/null
  for enclose in scene input closing; do
    bpclose scene.bpv --scale 0.2 -q | bpmesh --enclose $enclose --faces 60 -q --overwrite -o proxy.obj 2> /dev/null
    proof $scene proxy.obj
  done
  bpvox $scene --resolution 64 --fill inside -q 2> /dev/null | bpmesh --mode inside --faces 60 -q -o inner.obj --overwrite
  proof $scene --inside inner.obj
done
