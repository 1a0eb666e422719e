# The main job on a cube: three processes, one stream, one proof. The same bytes whatever the threads, tiles and memory.
write_cube cube.obj 3
said 'bpvox cube.obj --resolution 40 | bpclose --scale 2vx --element ball | bpmesh --faces 12 -o proxy.glb'
try bpcheck cube.obj proxy.glb
said 'bpvox cube.obj --resolution 40 -j 1 --memory 200M | bpclose --scale 2vx --element ball -j 1 | bpmesh --faces 12 -j 1 -o again.glb'
cmp proxy.glb again.glb
for format in ply obj stl gltf; do
  bpvox cube.obj --resolution 40 | bpclose --scale 2vx | bpmesh --faces 12 -o proxy.$format
  bpcheck cube.obj proxy.$format | tail -1
done
write_cube large.obj 5
bpvox cube.obj --resolution 40 -o cube.bp
try bpmesh cube.bp --faces 12 --enclose large.obj -o wrong.glb
try bpmesh cube.bp --faces 12 --enclose cube.obj -o tight.glb
bpcheck cube.obj tight.glb | tail -1
try bpcheck large.obj proxy.glb
files
