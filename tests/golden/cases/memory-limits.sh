# Too little memory, and a full disk: one line names what would do, the status is 4, and nothing is left behind.
write_cube cube.obj 3
bp-plant --triangles 20000 -o plant.ply > said && rm said
bpvox plant.ply --resolution 800 -o cube.bp -j 1
bpclose cube.bp --scale 2vx -o closed.bp -j 1
files
try bpvox cube.obj -o x.bp -j 1 --memory 63M
try bpclose cube.bp --scale 2vx -o x.bp -j 1 --memory 63M
try bpmesh closed.bp -o x.glb -j 1 --memory 63M | sed 's/[0-9.]* MiB/N MiB/g; s/[0-9]* triangles/N triangles/'
try bplod cube.obj -o x -j 1 --memory 63M
try bplod cube.obj -o x -j 1 --memory 63M --profile 3dtiles
try bpvox cube.obj -o x.bp -j 100 --memory 1G
# Of what a pass needs: the minimum that is named will do.
enough() {
  echo "\$ $*"
  "$@" -j 1 --memory 64M 2> said > /dev/null
  echo "= $?"
  sed 's/[0-9.]* MiB/N MiB/g; s/[0-9]* triangles/N triangles/; s/^/| /' said
  least=$(grep -o 'to at least [0-9]*' said | grep -o '[0-9]*')
  "$@" -j 1 --memory "${least}M" 2> said > /dev/null && echo "done with what was named" && return
  cat said
}
enough bpclose cube.bp --scale 40vx -o x.bp
rm x.bp
enough bpmesh closed.bp --faces 30000 -o x.glb
enough bplod plant.ply --resolution 600 --faces 30000 --levels 1 -o x
rm -r x x.glb
# The scene's triangles are counted before there is a surface, which takes its share, too; and cells of a surface grow.
bp-plant --triangles 90000 -o plant2.ply > /dev/null
bpvox plant2.ply --resolution 500 -j 1 -q | bpclose --scale 1% -o closed2.bp -j 1 -q
enough bpmesh closed2.bp --faces 2000 -o x.glb
rm x.glb
enough bpmesh closed2.bp --enclose input --faces 10000 -o x.glb
rm x.glb plant2.ply closed2.bp
enough bplod plant.ply --resolution 600 --tile 384 --levels 1 --profile 3dtiles -o x
rm -r x said
full() { (ulimit -f 1; "$@"); }
for profile in gltf collision 3dtiles; do
  try full bplod cube.obj --resolution 60 --levels 1 --faces 4000 --profile $profile -q -o x | sed 's/x.*glb/FILE/'
done
try full bpvox cube.obj --fill none --resolution 300 -o x.bp
files
