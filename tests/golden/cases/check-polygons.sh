# An L-shaped prism at UTM coordinates, whose roof and floor are polygons of six corners that no fan from their first corner covers: each
# format gives the same triangles, the volume of the prism, and the same proxy, which holds.
prism() {  # FORMAT
  python3 - "$1" <<'PY'
import struct, sys
kind = sys.argv[1]
ring = [(3, 1), (1, 1), (1, 3), (0, 3), (0, 0), (3, 0)]
v = [(448000.5 + x, 5412345.5 + y, z + .25) for z in (0, 2) for x, y in ring]
faces = [tuple(range(5, -1, -1)), tuple(range(6, 12)), *((i, (i + 1) % 6, 6 + (i + 1) % 6, 6 + i) for i in range(6))]
corners = [i for f in faces for i in f]
header = "ply\nformat %s 1.0\nelement vertex 12\nproperty double x\nproperty double y\nproperty double z\n" \
         "element face 8\nproperty list uchar int vertex_indices\nend_header\n"
lines = "".join("%r %r %r\n" % p for p in v), "".join("%d %s\n" % (len(f), " ".join(map(str, f))) for f in faces)
if kind == "obj":
    print("".join("v %r %r %r\n" % p for p in v) + "".join("f %s\n" % " ".join(str(i + 1) for i in f) for f in faces))
if kind == "off":
    print("OFF\n12 8 0\n%s%s" % lines)
if kind == "ascii.ply":
    print(header % "ascii" + "".join(lines))
if kind == "binary.ply":
    sys.stdout.buffer.write((header % "binary_little_endian").encode())
    sys.stdout.buffer.write(b"".join(struct.pack("<3d", *p) for p in v))
    sys.stdout.buffer.write(b"".join(struct.pack("<B%di" % len(f), len(f), *f) for f in faces))
if kind == "ac":
    print('AC3Db\nMATERIAL "m" rgb 1 1 1 amb 0 0 0 emis 0 0 0 spec 0 0 0 shi 0 trans 0\nOBJECT world\nkids 1\n'
          'OBJECT poly\nnumvert 12\n%snumsurf 8' % lines[0])
    for f in faces:
        print("SURF 0x0\nmat 0\nrefs %d\n%s" % (len(f), "\n".join("%d 0 0" % i for i in f)))
    print("kids 0")
if kind == "dae":
    print('<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>'
          '<unit name="meter" meter="1"/><up_axis>Y_UP</up_axis></asset><library_geometries><geometry id="g"><mesh>'
          '<source id="p"><float_array id="a" count="36">%s</float_array><technique_common><accessor source="#a" '
          'count="12" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" '
          'type="float"/></accessor></technique_common></source><vertices id="v"><input semantic="POSITION" '
          'source="#p"/></vertices><polylist count="8"><input semantic="VERTEX" source="#v" offset="0"/><vcount>%s'
          '</vcount><p>%s</p></polylist></mesh></geometry></library_geometries><library_visual_scenes><visual_scene '
          'id="s"><node id="n"><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes><scene>'
          '<instance_visual_scene url="#s"/></scene></COLLADA>'
          % (" ".join(repr(c) for p in v for c in p), " ".join(str(len(f)) for f in faces), " ".join(map(str, corners))))
PY
}
for kind in obj off ascii.ply binary.ply ac dae; do
  prism $kind > l.$kind
  echo "l.$kind:"
  bpinfo l.$kind 2> note | grep -E "^(triangles|area|volume|checksum)"
  bpvox l.$kind --resolution 48 -q | bpclose --scale 0 -q | bpmesh --faces 30 -q -o proxy.obj --overwrite
  bpcheck l.$kind proxy.obj 2>> note | grep -E "volume of the scene|encloses" | sed 's/ (ratio.*//'
  [ -e first.obj ] || cp proxy.obj first.obj
  cmp first.obj proxy.obj
  cat note
done

# A proxy with such polygons is read in the same way: it encloses what lies inside of the L, and not what lies in its notch.
awk '/^v/ { print "v", ($2 - 448000.5) * .25, ($3 - 5412345.5) * .25, ($4 - .25) * .25; next } 1' l.obj > proxy.obj
printf 'v .05 .05 .1\nv .6 .1 .1\nv .1 .2 .1\nf 1 2 3\n' > corner.obj
printf 'v .3 .3 .1\nv .4 .3 .1\nv .3 .4 .1\nf 1 2 3\n' > notch.obj
said 'bpcheck corner.obj proxy.obj | grep -E "closed|encloses"'
said 'bpcheck notch.obj proxy.obj | grep -E "encloses|outside"'
