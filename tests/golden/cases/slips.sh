# Slips of a person: what is out of proportion is questioned before any work, and the message says what is likely meant.
write_cube cube.obj 0.75  # diagonal 1.299
bpvox cube.obj --resolution 64 -o cube.bpv
try bpclose cube.bpv --scale 2 -o out.bpv
try bpclose cube.bpv --scale 40 -o out.bpv
try bpclose cube.bpv --scale 1e100 -o out.bpv
try bpclose cube.bpv --scale 50% -o insisted.bpv
try bpclose cube.bpv --scale 10cm -o out.bpv
try bpcheck cube.obj cube.obj --margin 10cm
try bpcheck cube.obj cube.obj --margin 2vx
try bpvox cube.obj --voxel 0.00001 -o out.bpv
try bpvox cube.obj --voxel 10 -o out.bpv
try bpvox cube.obj --voxel 64 -o out.bpv
try bpvox cube.obj --voxel 1e100 -o out.bpv
try bpvox cube.obj --voxel 50% -o insisted2.bpv
try bpvox cube.obj --resolution 2 -o insisted3.bpv
try bpmesh cube.bpv --error 1 -o out.glb
try bplod cube.obj --scale 2 -o out
try bplod cube.obj --voxel 2 -o out
try bplod cube.obj --error 1 -o out
try bplod cube.obj --error 1e-6 -o out
try bplod cube.obj --error 100000px -o out
try bplod cube.obj --screen 100000 -o out
try bplod cube.obj --scale 2 --explain
# A header is enough for bpclose: it does not wait for the voxels.
mkfifo in
bpclose in --scale 2 -o out.bpv 2> said &
exec 3> in
head -c 400 cube.bpv >&3
wait $!
echo "= $?"
exec 3>&-
cat said

# Options and words.
try bpvox cube.obj --resolutoin 64 -o out.bpv
try bpmesh cube.bpv --face 100 -o out.glb
try bpmesh cube.bpv -faces 100 -o out.glb
try bpclose cube.bpv -scale 2% -o out.bpv
try bplod cube.obj --profile collison -o out
try bpmesh cube.bpv --faces 2k,1.5K -o chain.glb -q
try bpmesh cube.bpv --faces 2x -o out.glb
try bpvox cube.obj --resolution 0.064k -q -o counted.bpv
cmp cube.bpv counted.bpv
try bplod cube.obj -o proxy.glb
try bplod cube.obj -o levels/.glb

try bplod cube.obj -o out --profile tiles
for word in unreal Unity godot physics lod hlod nanite cesium; do try bplod cube.obj -o out --profile $word; done
try bplod cube.obj --output-folder out
try bpvox cube.obj out.bpv
try bplod cube.obj out
try bpmesh cube.bpv out.glb
try bplod cube.obj -o tiles.json --profile 3dtiles
try bpvox cube.obj --memory 4 -j 1 -o out.bpv

# Names that begin as options do, and options where names are.
cp cube.obj ./-dash.obj
try bpvox -dash.obj -o out.bpv
try bpvox -- -dash.obj -o out.bpv
try bpvox -- cube.obj --resolution=10
try bpvox -q --resolution 10 -o dash.bpv -- -dash.obj && rm dash.bpv ./-dash.obj
try bpvox -dash.obj -o out.bpv

# Outputs whose folders are not there.
try bpvox cube.obj -o nosuch/out.bpv
try bplod cube.obj -o nosuch/out

# The first bytes of most formats tell them.
stdin=cube.obj try bpvox - --resolution 10 -q -o piped.bpv && rm piped.bpv
echo nothing > nothing && stdin=nothing try bpvox - --resolution 10 -q -o piped.bpv; rm nothing

# Files that are no scenes.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\n' > points.obj
printf 'ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n1 1 1\n' > points.ply
printf 'OFF\n2 0 0\n0 0 0\n1 1 1\n' > points.off
for scene in points.obj points.ply points.off; do try bpvox $scene -o out.bpv; done
try bplod points.ply -o out
try bpcheck points.ply cube.obj
for ending in las laz usd usda usdz gml city.json ifc dwg step skp b3dm; do
  echo nothing > scene.$ending
  try bpvox scene.$ending -o out.bpv
done
printf 'LASF' > unnamed
try bpvox unnamed -o out.bpv
try bpvox cube.obj scene.las -o out.bpv
try bpvox - --format las -o out.bpv

# A report is a log: the next one replaces it. Another file stays.
try bpvox cube.obj --resolution 10 -q -o r.bpv --report report.json
try bpvox cube.obj --resolution 12 -q -o r2.bpv --report report.json
grep -o 'resolution=[0-9]*' report.json
echo '{}' > other.json && try bpvox cube.obj --resolution 10 -o r3.bpv --report other.json
rm report.json other.json
said 'bpvox cube.obj --resolution 10 --report report.json | bpclose --scale 1vx --report report.json -o r4.bpv'
ls
