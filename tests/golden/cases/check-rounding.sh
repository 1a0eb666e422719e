# A box of 1 m at UTM coordinates, and the same with a triangle far away. The tools keep the distance by which reading in
# single precision may be off. A proxy of the box as read in double does not, and nothing is proven.
box() {  # FORMAT alone|stray
  PYTHONPATH=$BP_ROOT/tests/golden PYTHONDONTWRITEBYTECODE=1 python3 - "$@" <<'PY'
from dxf import print_dxf
import sys
kind, stray = sys.argv[1], sys.argv[2] == "stray"
v = [(448000.3 + a, 5412345.3 + b, 33.3 + c) for a in (0, 1) for b in (0, 1) for c in (0, 1)]
quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
faces = [t for a, b, c, e in quads for t in ((a, b, c), (a, c, e))]
if stray:
    v += [(9e8, 0, 0), (9e8, 1000, 0), (9e8, 0, 1000)]
    faces += [(8, 9, 10)]
if kind == "obj":
    print("".join("v %r %r %r\n" % p for p in v) + "".join("f %d %d %d\n" % tuple(i + 1 for i in f) for f in faces))
if kind == "ac":
    print('AC3Db\nMATERIAL "m" rgb 1 1 1 amb 0 0 0 emis 0 0 0 spec 0 0 0 shi 0 trans 0\nOBJECT world\nkids 1\n'
          'OBJECT poly\nnumvert %d' % len(v))
    for p in v:
        print("%r %r %r" % p)
    print("numsurf %d" % len(faces))
    for f in faces:
        print("SURF 0x0\nmat 0\nrefs 3\n%d 0 0\n%d 0 0\n%d 0 0" % f)
    print("kids 0")
if kind == "dae":
    print('<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>'
          '<unit name="meter" meter="1"/><up_axis>Y_UP</up_axis></asset><library_geometries><geometry id="g"><mesh>'
          '<source id="p"><float_array id="a" count="%d">%s</float_array><technique_common><accessor source="#a" '
          'count="%d" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" '
          'type="float"/></accessor></technique_common></source><vertices id="v"><input semantic="POSITION" '
          'source="#p"/></vertices><triangles count="%d"><input semantic="VERTEX" source="#v" offset="0"/><p>%s</p>'
          '</triangles></mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="s"><node id="n">'
          '<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes><scene><instance_visual_scene '
          'url="#s"/></scene></COLLADA>' % (3 * len(v), " ".join(repr(c) for p in v for c in p), len(v), len(faces),
                                            " ".join(str(i) for f in faces for i in f)))
if kind == "dxf":
    print_dxf(v, faces)
PY
}
for with in alone stray; do
  for kind in obj dae ac dxf; do
    box $kind $with > $with.$kind
    rm -f proxy.obj
    bpvox $with.$kind --resolution 64 -q | bpclose --scale 0 -q | bpmesh --faces 100 -q -o proxy.obj
    bpcheck $with.$kind proxy.obj > verdict 2> note
    echo "$with.$kind: exit $?, $(tail -1 verdict)"
    grep "^  coordinates" verdict
    cat note
  done
done
python3 - alone.obj > read.obj <<'PY'  # the box as the importer reads it, y up
import struct, sys
single = lambda x: struct.unpack("f", struct.pack("f", float(x)))[0]
for line in filter(str.strip, open(sys.argv[1])):
    kind, a, b, c = line.split()
    print("v %r %r %r" % (single(a), single(c), -single(b)) if kind == "v" else line.strip())
PY
bpvox read.obj --resolution 64 -q | bpclose --scale 0 -q | bpmesh --faces 100 -q -o tight.obj
bpcheck alone.dxf tight.obj > verdict 2> note
echo "a proxy of alone.dxf as read: exit $?, $(tail -1 verdict)"
cat note
try bpvox alone.dxf --resolution 64 -o alone.bpv
bpinfo alone.dxf | grep "^read"
bpinfo alone.dae | grep "^read" || true
bplod read.obj --resolution 64 --profile 3dtiles --up y -q -o tiles > /dev/null
bpcheck alone.dxf tiles/tileset.json > verdict 2> note
echo "a tileset of alone.dxf as read: exit $?"
cut -c1-150 note
rm -r tiles
