# Files of TORCS have four images for each object. The first one, "base", is drawn as colours. A name without quotes is no image.
chequer red
write_octahedron part.obj 4
{
  printf 'AC3Db\r\nMATERIAL "m" rgb 1 1 1 amb 0 0 0 emis 0 0 0 spec 0 0 0 shi 0 trans 0\r\nOBJECT world\r\nkids 1\r\nOBJECT poly\r\nname "a"\r\n'
  printf 'texture "chequered.png" base\r\ntexture "shadow.rgb" tiled\r\ntexture "road.rgb" skids\r\n'
  printf 'texture empty_texture_no_mapping shad\r\n'
  printf 'numvert 6\r\n2 1 1\r\n0 1 1\r\n1 2 1\r\n1 0 1\r\n1 1 2\r\n1 1 0\r\nnumsurf 8\r\n'
  sed -n 's/^f //p' part.obj | while read -r a b c; do
    printf 'SURF 0x10\r\nmat 0\r\nrefs 3\r\n%d 0 0\r\n%d 1 0\r\n%d 1 1\r\n' $((a - 1)) $((b - 1)) $((c - 1))
  done
  printf 'kids 0\r\n'
} > car.acc
try bplod car.acc --resolution 16 --faces 8 --levels 1 -q -o lod --report r.json | cut -f 1,2
grep -c '"appearance=texture\|appearance=texture' lod/car_LOD0.glb
sed '/"chequered.png" base/d' car.acc > plain.acc
try bplod plain.acc --resolution 16 --faces 8 --levels 1 -o lod2 2>&1 | grep -v "^|.*the files are in" | cut -f 1,2
# A missing image is called by its name.
rm chequered.png
try bplod car.acc --resolution 16 --faces 8 --levels 1 -o lod3 2>&1 | grep -v "^|.*the files are in" | cut -f 1,2
