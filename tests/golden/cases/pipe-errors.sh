# What the rest of the pipe refuses, what it says, and that no output stays behind.
write_cube cube.obj
bpvox cube.obj --resolution 20 -o cube.bp
bpclose cube.bp --scale 2vx -o closed.bp
bpmesh closed.bp --faces 12 -o cube.glb
size=$(stat -c %s closed.bp)
head -c $((size / 2)) closed.bp > short.bp
head -c $((size - 1)) closed.bp > almost.bp
{ head -c $((size / 2)) closed.bp; tail -c +$((size / 2 + 1)) closed.bp | head -c 1 | tr '\000-\377' '\001-\377\000'; tail -c +$((size / 2 + 2)) closed.bp; } > flipped.bp
echo "this is no stream" > text.bp
rm closed.bp cube.bp
bpvox cube.obj --resolution 20 -o cube.bp
files
said 'bpclose cube.bp | bpinfo | grep "made by.*bpclose"'
try bpclose cube.bp --scale -1 -o out.bp
try bpclose cube.bp --scale nan -o out.bp
try bpclose cube.bp --scale 1e9vx -o out.bp
try bpclose cube.bp --field missing.json -o out.bp
echo '{"base": -1}' > field.json
try bpclose cube.bp --field field.json -o out.bp
echo '{"base": 1, "boxen": []}' > field.json
try bpclose cube.bp --field field.json -o out.bp
rm field.json
try bpclose cube.bp --scale 0.5vx -o noted.bp
try bpclose cube.bp --scale 0.5vx --quiet -o noted.bp --overwrite
echo '{"base": 0.3, "boxes": [{"min": [0, 0, 0], "max": [1, 1, 1], "scale": 0.2}, {"min": [5, 5, 5], "max": [6, 6, 6], "scale": 0.1}]}' > field.json
try bpclose cube.bp --field field.json -o noted.bp --overwrite
rm field.json noted.bp
try bpclose missing.bp --scale 1 -o out.bp
try bpclose text.bp --scale 1 -o out.bp
try bpclose cube.glb --scale 1 -o out.bp
try bpmesh text.bp -o out.glb
try bpmesh short.bp -o out.glb
try bpmesh almost.bp -o out.glb
try bpmesh flipped.bp -o out.glb
try bpmesh cube.bp
try bpmesh cube.bp -o out.xyz
said 'bpmesh cube.bp | bpclose -o out.bp'
try bpmesh cube.bp -o out
try bpmesh cube.bp --faces 99999999999999999999 -o out.glb
try bpmesh cube.bp --origin 1,2 -o out.glb
try bpmesh cube.bp -o cube.glb
try bpmesh cube.bp -o out.glb --enclose input --enclose cube.obj
ln -s /dev/full full.glb; try bpmesh cube.bp -o full.glb
try bpclose cube.bp --scale 1vx -o /dev/full
stdin=text.bp try bpclose --scale 1 -o out.bp
said 'bpvox missing.obj | bpclose --scale 1 | bpmesh -o out.glb'
said 'bpvox cube.obj --resolution 64 | bpclose --scale 2vx | head -c 10 | wc -c'
try bpcheck cube.obj missing.glb
try bpcheck cube.obj text.bp
files
# An output must not be an input, nor two outputs one file; what is empty proves nothing.
bpclose cube.bp --scale 1vx -o closed.bp
cp closed.bp again.bp
cp cube.obj cube; try bpvox cube --format obj -o cube --overwrite
try bpvox cube --format obj -o ./../$(basename "$PWD")/cube --overwrite | sed 's|/[^/]*/cube|/HERE/cube|'
try bpvox cube.obj --report one.json -o one.json
try bpvox cube.obj --report - -o -
try bpclose cube.bp --scale 1vx -o again.bp --overwrite
try bpmesh again.bp --enclose cube.obj -o cube.obj --overwrite
try bpinfo cube.obj --image cube.obj --overwrite
mkdir levels
cp cube.glb levels/cube_LOD0.glb
try bplod levels/cube_LOD0.glb --name cube --levels 1 -o levels --overwrite
said 'bpvox cube.obj --resolution 8 --report /dev/null -o /dev/null'
echo '# nothing' > nothing.obj
try bpcheck nothing.obj cube.glb
try bpcheck nothing.obj cube.glb --inside
try bpcheck nothing.obj cube.glb --convex
said 'cat cube.obj | bpcheck - - --format obj'
: > empty.glb
try bpcheck cube.obj empty.glb
echo 'no JSON' > text.gltf
try bpcheck cube.obj text.gltf
try bpinfo cube.obj cube.glb --image x.png --image-size 3
try bpmesh closed.bp --origin 1e30,0,0 -o x.ply
try bpmesh closed.bp -o missing/x.ply
files
