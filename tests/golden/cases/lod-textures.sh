# Textures of a scene on its levels. Two cubes in a row, one with a chequered image; what is compared is bytes with bytes.
write_painted_cubes
attributes() { for f in "$@"; do echo "$f: $(grep -ao '"attributes":{[^}]*}' "$f" | sort -u | tr '\n' ' ')$(grep -ao 'image/[a-z]*' "$f" | sort -u | tr '\n' ' ')"; done; }
options=(part*.obj --name cubes --resolution 60 --levels 2 -q)

bplod "${options[@]}" -o on | cut -f 1
bplod "${options[@]}" -o on1 -j 1 --memory 300M > list
same on on1
bplod "${options[@]}" --appearance color -o color > list
bplod "${options[@]}" --appearance off -o off > list
attributes on/*.glb color/cubes_LOD0.glb off/cubes_LOD0.glb
for f in cubes_LOD0 cubes_LOD1; do
  [ "$(bpinfo on/$f.glb | checksum)" = "$(bpinfo off/$f.glb | checksum)" ] && echo "$f: the same triangles"
done
bpcheck part*.obj on/cubes_LOD0.glb | tail -1

# Tilesets: the cache knows images.
tiles=(part*.obj --name cubes --voxel 0.1 --tile 128 --profile 3dtiles -q)
bplod "${tiles[@]}" -o first --cache cache > list
bplod "${tiles[@]}" -o again -j 1 --cache cache --report again.json > list
same first again
kept again.json
chequer blue
bplod "${tiles[@]}" -o painted --cache cache --report painted.json > list
bplod "${tiles[@]}" -o from-nothing > list
same painted from-nothing
same painted first
kept painted.json
attributes first/cubes_LOD0/*.glb | cut -d : -f 2- | sort -u
bpcheck part*.obj painted/tileset.json | sed 's/[0-9]* triangles/some triangles/'

# A missing or broken image is a note, and its material's colour is used; if all are, there are only colours.
chequer blue && truncate -s 60 chequered.png
said 'bplod part0.obj --name cubes --resolution 30 --levels 1 -o broken | cut -f 1'
rm chequered.png
said 'bplod part0.obj --name cubes --resolution 30 --levels 1 -o missing | cut -f 1'
attributes broken/*_LOD0.glb missing/*_LOD0.glb
cp cubes.mtl as_named.mtl
printf 'II*\0 and so on' > roof.tif
sed -i 's/chequered.png/"Roof.tif"/' cubes.mtl
said 'bplod part0.obj --name cubes --resolution 30 --levels 1 -o tiff | cut -f 1'

# An image is found by the names that other programs give it.
chequer red
for name in '"chequered.png"' 'C:\\tex\\chequered.png' Chequered.PNG; do
  sed "s/chequered.png/$name/" as_named.mtl > cubes.mtl
  bplod part0.obj --name cubes --resolution 30 --levels 1 -q -o found --overwrite > list
  echo "$(grep map_Kd cubes.mtl) -> $(attributes found/*_LOD0.glb)"
done
cp as_named.mtl cubes.mtl && rm chequered.png
try bplod part0.obj --resolution 30 --levels 1 --memory 1M -o small
try bplod part0.obj --appearance picture -o x
try bplod part0.obj --profile cage --appearance texture -o x

# The disk space that --explain names knows of textures.
chequer red
for profile in gltf 3dtiles; do
  bplod part*.obj --name cubes --resolution 60 --profile $profile --explain -q --report explained.json > list
  about=$(grep -o '"file_bytes_about": [0-9]*' explained.json | grep -o '[0-9]*$')
  bplod part*.obj --name cubes --resolution 60 --profile $profile --appearance off --explain -q --overwrite --report plain.json > list
  plain=$(grep -o '"file_bytes_about": [0-9]*' plain.json | grep -o '[0-9]*$')
  [ $((2 * about)) -gt $((3 * plain)) ] || echo "$profile: about $about bytes with textures, and $plain without"
  rm explained.json plain.json
done
